// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algebraic numbers rounded to binary64.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

#include "kinetri/algebra/algebraic_number.h"
#include "representation.h"

namespace kinetri {
namespace {

// The position of a number among the binary64 numbers: neighbours differ by one, both zeros are 0.
std::int64_t ordinal(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  return bits >= 0 ? bits : std::numeric_limits<std::int64_t>::min() - bits;
}

double from_ordinal(std::int64_t n) {
  return std::bit_cast<double>(n >= 0 ? n : std::numeric_limits<std::int64_t>::min() - n);
}

}  // namespace

Double_interval Root_source::Representation::tight_interval() {
  while (!is_rational()) {
    const Double_interval present = double_interval();
    // The number is strictly between the ends of the isolation, so it can be a binary64 number only
    // if there is one strictly between these two.
    const std::int64_t first = ordinal(present.lower);
    const std::int64_t candidates = ordinal(present.upper) - first - 1;
    if (candidates == 0) return present;
    if (candidates <= 3) {
      compare_with(to_rational(from_ordinal(first + (candidates + 1) / 2)));
    } else {
      quadratic_step(std::numeric_limits<unsigned long>::max());
    }
  }
  return to_interval(lower);
}

// Makes the interval of a number whose polynomial has not been made that of its rounding, where its
// source knows that.
void Algebraic_number::narrow_by_source() const {
  const Double_interval present = interval();  // before the representation, as in representation()
  if (source_->representation_.load(std::memory_order_acquire) != nullptr) return;
  if (ordinal(present.lower) + 1 == ordinal(present.upper)) return;
  if (const std::optional<Rounding> rounding = source_->rounded(present)) {
    source_->narrow(rounding->bounds);
  }
}

// The tight interval of a number whose polynomial has not been made, where the signs that its
// source knows are enough for it. The values there say where to look: within so small an interval
// they are all but on a line.
std::optional<Double_interval> Algebraic_number::tighten_by_source() const {
  narrow_by_source();
  Double_interval present = interval();  // before the representation, as in representation()
  if (source_->representation_.load(std::memory_order_acquire) != nullptr) return std::nullopt;
  std::int64_t below = ordinal(present.lower);
  std::int64_t above = ordinal(present.upper);
  if (below + 1 == above) return present;
  double value_below = source_->certain_value_at(present.lower, 0);
  double value_above = source_->certain_value_at(present.upper, 0);
  if (value_below == 0 || value_above == 0) return std::nullopt;
  for (int i = 0; below + 1 != above; ++i) {
    std::int64_t middle = std::midpoint(below, above);  // their difference may overflow
    if (i < 4) {
      const double share = value_below / (value_below - value_above);
      const double guess =
          from_ordinal(below) + share * (from_ordinal(above) - from_ordinal(below));
      // Beside the guess, on either side in turn, so that both ends come near.
      middle = std::clamp(ordinal(guess) + i % 2, below + 1, above - 1);
    }
    const double value = source_->certain_value_at(from_ordinal(middle), 0);
    if (value == 0) return std::nullopt;
    if ((value > 0) == (value_below > 0)) {
      below = middle;
      value_below = value;
    } else {
      above = middle;
      value_above = value;
    }
    present = {from_ordinal(below), from_ordinal(above)};
    source_->narrow(present);
  }
  return present;
}

Double_interval Algebraic_number::tight_interval() const {
  if (is_binary64()) return bounds_;
  if (const std::optional<Double_interval> tight = tighten_by_source()) return *tight;
  return access()->tight_interval();
}

double Algebraic_number::to_double() const {
  if (is_binary64()) return bounds_.lower;
  const Double_interval present = interval();  // before the representation, as in representation()
  if (source_->representation_.load(std::memory_order_acquire) == nullptr) {
    if (const std::optional<Rounding> rounding = source_->rounded(present)) {
      source_->narrow(rounding->bounds);
      return rounding->nearest;
    }
  }
  const Double_interval tight = tight_interval();
  if (source_->representation_.load(std::memory_order_acquire) == nullptr) {
    const double half = 0.5 * (tight.upper - tight.lower);
    const double value = source_->certain_value_at(tight.lower, half);
    const double value_below = source_->certain_value_at(tight.lower, 0);
    // Halfway between subnormal numbers there is no binary64 number.
    if (value != 0 && value_below != 0 && tight.lower + 2 * half == tight.upper && half > 0) {
      return (value > 0) == (value_below > 0) ? tight.upper : tight.lower;
    }
  }
  // Halfway, also where the upper neighbour is infinite: IEEE 754 rounds as if it were 2^1024.
  const auto end = [](double x) {
    if (std::isfinite(x)) return to_rational(x);
    return scaled_by_power_of_two(x > 0 ? 1 : -1, std::numeric_limits<double>::max_exponent);
  };
  const Rational halfway = (end(tight.lower) + end(tight.upper)) / 2;
  const Comparison_result order = compare(*this, halfway);
  if (order == CGAL::EQUAL) return kinetri::to_double(halfway);
  return order == CGAL::SMALLER ? tight.lower : tight.upper;
}

}  // namespace kinetri
