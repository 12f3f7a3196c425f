// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first failure over [0, 1] of a polynomial whose values are known up to an error: usually from
// its Bernstein coefficients, else from Sturm counts or by subdivision.
#ifndef KINETRI_SRC_KINETIC_FILTER_FIRST_FAILURE_H
#define KINETRI_SRC_KINETIC_FILTER_FIRST_FAILURE_H

#include <array>
#include <cstddef>
#include <optional>

#include "approximate_sturm_sequence.h"
#include "bernstein.h"
#include "filter_result.h"

namespace kinetri {

// A failure later than this share of the window is not searched for yet: the certificate is
// probably replaced before.
inline constexpr double search_limit = 0.18;

// The depth of subdivision at which Sturm counts are tried, the most bisections by Sturm counts,
// and the greatest depth of subdivision.
inline constexpr int depth_of_counts = 1;
inline constexpr int most_halvings = 24;
inline constexpr int max_depth = 8;

// The first failure in [lower, lower + width] of the polynomial with coefficients `c`, whose
// Bernstein coefficients there are `b`; none if the interval must be subdivided. Values are known
// up to `error`. Preconditions: there is no failure before; the polynomial is not certainly
// positive in the interval.
template <std::size_t M>
std::optional<Filter_result> first_failure_in_piece(const std::array<double, M>& c,
                                                    const std::array<double, M>& b, double lower,
                                                    double width, double error) {
  using Kind = Filter_result::Kind;
  const double share = positive_share(b, error);
  const double until = lower + share * width;
  if (until >= search_limit) return Filter_result{Kind::holds, {until, until}, width < 1};
  if (share == 0) return Filter_result{};
  const std::size_t i = before_only_change(b, error);
  if (i == 0) return std::nullopt;
  double upper = lower + width;
  // Most roots are near zero; a step of Halley's method from there approximates them.
  double second = 0;
  if constexpr (M > 2) second = c[2];
  double start = c[0] * c[1] / (c[0] * second - c[1] * c[1]);
  if (!(start > lower && start < upper)) {
    // Otherwise starts at the root of the control polygon.
    const double crossing =
        (static_cast<double>(i - 1) + b[i - 1] / (b[i - 1] - b[i])) / static_cast<double>(M - 1);
    start = lower + crossing * width;
  }
  if (!bracket_root(c, error, start, lower, upper)) return Filter_result{};
  return Filter_result{Kind::fails, {lower, upper}, true};
}

// The first failure over [0, 1] by Sturm counts; none if a sign is not certain. Precondition: the
// polynomial is certainly positive at zero.
template <std::size_t M>
std::optional<Filter_result> first_failure_by_counts(const std::array<double, M>& c, double error) {
  using Kind = Filter_result::Kind;
  const Approximate_sturm_sequence<M> sequence(c, error);
  if (!sequence.is_certain()) return std::nullopt;
  const std::optional<int> at_start = sequence.changes_at_zero();
  if (!at_start) return std::nullopt;
  if (*at_start == sequence.changes_at_infinity()) return Filter_result{Kind::never_fails, {}};
  double lower = 0;
  double upper = 1;
  std::optional<int> at_upper = sequence.changes_at(upper);
  if (at_upper && *at_upper == *at_start) return Filter_result{Kind::holds, {1, 1}, true};
  // There is no root in (0, lower], and there is one in (lower, upper].
  for (int i = 0; i < most_halvings && at_upper; ++i) {
    if (lower >= search_limit) return Filter_result{Kind::holds, {lower, lower}, true};
    if (*at_start - *at_upper == 1) {
      if (!bracket_root(c, error, 0.5 * (lower + upper), lower, upper)) break;
      return Filter_result{Kind::fails, {lower, upper}, true};
    }
    const double middle = 0.5 * (lower + upper);
    const std::optional<int> at_middle = sequence.changes_at(middle);
    if (at_middle && *at_middle == *at_start) {
      lower = middle;
    } else {
      upper = middle;
      at_upper = at_middle;
    }
  }
  return std::nullopt;
}

// How long a polynomial, with coefficients `c` and Bernstein coefficients `b` over [0, 1] and
// values known up to `error`, is certainly positive; or a bracket of its first root if that is
// near. Precondition: it is not certainly positive throughout.
template <std::size_t M>
Filter_result first_failure(const std::array<double, M>& c, const std::array<double, M>& b,
                            double error) {
  // Usually no subdivision is needed.
  if (const auto result = first_failure_in_piece(c, b, 0, 1, error)) return *result;
  struct Piece {
    std::array<double, M> b;
    double lower;
    double width;
    int depth;
  };
  std::array<Piece, max_depth + 1> stack;
  stack[0] = {b, 0, 1, 0};
  std::size_t size = 1;
  while (size > 0) {
    // It must be subdivided.
    Piece piece = stack[--size];
    if (piece.depth == max_depth) return {};
    if constexpr (M >= 3 && M <= 5) {
      if (piece.depth == depth_of_counts) {
        if (const auto result = first_failure_by_counts(c, error)) return *result;
      }
    }
    const double width = 0.5 * piece.width;
    const std::array<double, M> right = split(piece.b);
    stack[size++] = {right, piece.lower + width, width, piece.depth + 1};
    stack[size++] = {piece.b, piece.lower, width, piece.depth + 1};
    // Pieces, from the left, that need no subdivision.
    for (; size > 0; --size) {
      const Piece& half = stack[size - 1];
      if (least(half.b) > error) continue;
      const auto result = first_failure_in_piece(c, half.b, half.lower, half.width, error);
      if (result) return *result;
      break;
    }
  }
  return {Filter_result::Kind::holds, {1, 1}, true};
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_FIRST_FAILURE_H
