// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first failure over [0, 1] of a polynomial of which each value is known up to an error: by its
// Bernstein coefficients, mostly, and else by the counts of its Sturm sequence or by halving.
#ifndef KINETRI_SRC_KINETIC_FILTER_FIRST_FAILURE_H
#define KINETRI_SRC_KINETIC_FILTER_FIRST_FAILURE_H

#include <array>
#include <cstddef>
#include <optional>

#include "approximate_sturm_sequence.h"
#include "bernstein.h"
#include "filter_result.h"

namespace kinetri {

// A failure later than this share of the window is not looked for yet: probably the certificate is
// replaced before it comes.
inline constexpr double search_limit = 0.18;

// How often the interval is halved: before the counts of the Sturm sequence are asked, by these
// counts, and in all.
inline constexpr int depth_of_counts = 1;
inline constexpr int most_halvings = 24;
inline constexpr int max_depth = 8;

// What the Bernstein coefficients `b` over [lower, lower + width] say about the first failure of
// the polynomial with coefficients `c` there, of which there is none before; none if they have to
// be divided. Each value is known up to `error`, and the polynomial is not certainly positive.
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
  // Most roots are near zero, and near where a step of Halley's method leads from there.
  double second = 0;
  if constexpr (M > 2) second = c[2];
  double start = c[0] * c[1] / (c[0] * second - c[1] * c[1]);
  if (!(start > lower && start < upper)) {
    // Else near that of the control polygon.
    const double crossing =
        (static_cast<double>(i - 1) + b[i - 1] / (b[i - 1] - b[i])) / static_cast<double>(M - 1);
    start = lower + crossing * width;
  }
  if (!bracket_root(c, error, start, lower, upper)) return Filter_result{};
  return Filter_result{Kind::fails, {lower, upper}, true};
}

// The first failure over [0, 1] by the counts of the Sturm sequence; none if a sign is not certain.
// Precondition: the polynomial is certainly positive at zero.
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

// How long the polynomial with coefficients `c` and Bernstein coefficients `b`, each value of which
// over [0, 1] is known up to `error`, is certainly positive; or a bracket of its first root, where
// that is near. Precondition: it is not certainly positive throughout.
template <std::size_t M>
Filter_result first_failure(const std::array<double, M>& c, const std::array<double, M>& b,
                            double error) {
  // Mostly the whole needs not be divided.
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
    // One that has to be divided.
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
    // Halves, from the left, that need not be divided.
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
