// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/regular_times.h"

#include "kinetri/algebra/number_types.h"

namespace kinetri::app {
namespace {

// Rounding preserves the order, so equal numbers are adjacent.
void add_time(std::vector<double>& times, double time) {
  if (times.empty() || times.back() != time) times.push_back(time);
}

}  // namespace

std::optional<std::vector<double>> regular_times(double from, double until, double per_time,
                                                 std::size_t most) {
  const Rational start = to_rational(from);
  const Rational frequency = to_rational(per_time);
  // What cannot fit is not tried.
  if ((to_rational(until) - start) * frequency >= most) return std::nullopt;
  std::vector<double> times;
  for (std::size_t k = 0;; ++k) {
    const double time = to_double(start + Rational(k) / frequency);
    if (time > until) return times;
    if (k == most) return std::nullopt;
    add_time(times, time);
  }
}

std::optional<std::vector<double>> multiples(double from, double until, double per_time,
                                             std::size_t most) {
  const Rational frequency = to_rational(per_time);
  const Rational start = to_rational(from) * frequency;
  if (to_rational(until) * frequency - start >= most) return std::nullopt;
  // One less than the quotient, since a smaller multiple may be rounded up to `from`.
  Integer k =
      boost::multiprecision::numerator(start) / boost::multiprecision::denominator(start) - 2;
  std::vector<double> times;
  for (std::size_t number = 0;; ++k) {
    const double time = to_double(Rational(k) / frequency);
    if (time < from) continue;
    if (time > until) return times;
    if (number++ == most) return std::nullopt;
    add_time(times, time);
  }
}

std::vector<double> evenly_spaced_times(double from, double until, std::size_t intervals) {
  const Rational start = to_rational(from);
  const Rational length = to_rational(until) - start;
  std::vector<double> times;
  for (std::size_t k = 0; k <= intervals; ++k) {
    add_time(times, to_double(start + length * Rational(k) / Rational(intervals)));
  }
  return times;
}

}  // namespace kinetri::app
