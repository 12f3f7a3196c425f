// SPDX-License-Identifier: GPL-3.0-or-later
//
// Classifies the polynomial of a certificate over a window: a Filter_result or a certain sign
// (docs/MATH.md, section 7). `Differences` is Linear_differences or Polynomial_differences.
// `Certificate` computes the polynomial of scaled differences, the error of its values, and a bound
// for the sum of its coefficients' magnitudes (`norm`).
//
// Templates in the hot path are declared inline, since the compiler inlines only these.
#ifndef KINETRI_SRC_KINETIC_FILTER_CLASSIFY_H
#define KINETRI_SRC_KINETIC_FILTER_CLASSIFY_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "bernstein.h"
#include "error_bounds.h"
#include "filter_result.h"
#include "first_failure.h"
#include "kinetri/impl/algebra/sign.h"

namespace kinetri {

// Converts a result in w to one in time, rounded to the safe side.
inline Filter_result in_time(const Filter_result& v, double window, const Double_interval& after) {
  if (v.kind == Filter_result::Kind::never_fails) return v;
  // The sum and the product in origin + w * window each err by at most one unit in the last place.
  // `down` and `up` move by at least one, in any rounding mode.
  const double origin = after.lower;
  const auto ulp = [](double x) { return std::abs(x) * 0x1p-52 + 0x1p-1074; };
  const auto down = [ulp](double x) { return x - ulp(x); };
  const auto up = [ulp](double x) { return x + ulp(x); };
  const double lower = down(origin + down(v.bounds.lower * window));
  if (!(lower > after.upper)) return {};
  if (v.kind == Filter_result::Kind::holds) return {v.kind, {lower, lower}, v.is_refined};
  const double upper = up(origin + up(v.bounds.upper * window));
  if (v.kind == Filter_result::Kind::unknown || !std::isfinite(upper)) return {};
  return {v.kind, {lower, upper}, v.is_refined};
}

// The result in w for the polynomial with coefficients `c`, whose values are known up to `error`.
template <std::size_t M>
Filter_result classify(const std::array<double, M>& c, double error) {
  const std::array<double, M> b = bernstein(c);
  if (!(least(b) > error)) return first_failure(c, b, error);
  if (least(c) > error) return {Filter_result::Kind::never_fails, {}};
  return {Filter_result::Kind::holds, {1, 1}};
}

// A bound for w at the time in `after`: twice its value, because of rounding.
inline double greatest_root(const Double_interval& after, double window) {
  return 2 * (after.upper - after.lower) / window;
}

// The same for the next root of a polynomial with a known root in [0, root]. `norm` bounds the sum
// of the coefficients' magnitudes.
template <std::size_t M>
Filter_result classify_after_known_root(const std::array<double, M>& c, double error, double norm,
                                        double root) {
  // c(w) = (w - r) g(w): g has the coefficients c_1, c_2, ... up to an error due to r, and the next
  // root of c after r is that of g.
  if (!(root < 0x1p-10)) return {};
  std::array<double, M - 1> g;
  std::copy(c.begin() + 1, c.end(), g.begin());
  Filter_result result = classify(g, error + 2 * norm * root);
  if (result.kind == Filter_result::Kind::fails) {
    // c itself gives a narrower bracket, from which the next certificate starts.
    auto& [lower, upper] = result.bounds;
    bracket_root(c, error, 0.5 * (lower + upper), lower, upper);
  }
  return result;
}

// The result for a certificate after a time in `after`, at which it is zero if `vanishes_at`.
// Scales the differences.
template <class Differences, class Certificate>
inline Filter_result classify_ahead(Differences& d, const Certificate& certificate,
                                    const Double_interval& after, bool vanishes_at) {
  const std::optional<double> window = d.window_ahead(window_share);
  d.scale(window.value_or(0));
  const double error = certificate.error(d);
  if (!std::isfinite(error)) return {};
  const auto c = certificate(d);
  if (!window) {
    if (!(c[0] > error)) return {};
    return {Filter_result::Kind::never_fails, {}};
  }
  if (!vanishes_at) return in_time(classify(c, error), *window, after);
  return in_time(
      classify_after_known_root(c, error, certificate.norm(d), greatest_root(after, *window)),
      *window, after);
}

// The sign of all values over [0, 1] if it is certain, else zero.
template <class Differences, class Certificate>
inline Sign certain_sign(const Differences& d, const Certificate& certificate) {
  const auto b = bernstein(certificate(d));
  const double error = certificate.error(d);
  if (std::ranges::all_of(b, [error](double x) { return x > error; })) return CGAL::POSITIVE;
  if (std::ranges::all_of(b, [error](double x) { return x < -error; })) return CGAL::NEGATIVE;
  return CGAL::ZERO;
}

// The same for all times in an interval, from the origin on. Scales the differences.
template <class Differences, class Certificate>
inline Sign sign_throughout(Differences& d, const Certificate& certificate,
                            const Double_interval& interval) {
  // The length of the interval is rounded.
  d.scale(2 * (interval.upper - interval.lower));
  return certain_sign(d, certificate);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_CLASSIFY_H
