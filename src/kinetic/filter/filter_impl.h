// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of filter.h: the certificates of the triangulation, and the predicates.
//
// The instances for points and for discs are in different sources, since together the compiler
// inlines less.
#ifndef KINETRI_SRC_KINETIC_FILTER_FILTER_IMPL_H
#define KINETRI_SRC_KINETIC_FILTER_FILTER_IMPL_H

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "certificates.h"
#include "classify.h"
#include "differences.h"
#include "filter.h"
#include "kinetic/certain_signs.h"

namespace kinetri {
namespace {

// Points in linear motion that coincide at some time move along the line that joins them.
template <LinearMotion Motion>
inline bool are_apart(const Motion& p, const Motion& q, const Double_interval& /*interval*/) {
  const Linear_differences<1, Motion> d({&p}, q, epoch_of(p));
  if (d.speed() == 0) return true;
  if (!is_unscaled_in_range(d)) return false;
  const auto& [place, slope] = d[0];
  return std::abs(place[0] * slope[1] - place[1] * slope[0]) > unscaled_error(d);
}
inline bool are_apart(const Polynomial_motion_2& p, const Polynomial_motion_2& q,
                      const Double_interval& interval) {
  if (is_linear(p) && is_linear(q)) return are_apart(linear(p), linear(q), interval);
  Polynomial_differences<1> d({&p}, q, interval.lower);
  return sign_throughout(d, Coordinate{0}, interval) != CGAL::ZERO ||
         certain_sign(d, Coordinate{1}) != CGAL::ZERO;
}

// The sign of a predicate throughout the interval, from rounded positions, which nearly always
// suffices. Differences of motions decide more if positions are small differences of large numbers.
template <class Predicate, class... Motions>
Sign sign_of_places(const Predicate& predicate, const Double_interval& interval,
                    const Motions&... motions) {
  const double error = (place_error(motions, interval.lower, interval) + ...);
  return predicate(rounded_place(motions, interval.lower)..., error);
}

template <class Motion>
Sign in_circle_of_places(const Double_interval& interval, const Motion& p, const Motion& q,
                         const Motion& r, const Motion& s) {
  const auto side = [](const auto&... arguments) {
    return detail::certain_side_of_oriented_circle(arguments...);
  };
  if constexpr (HasWeight<Motion>) {
    const double t = interval.lower;
    const double error = weight_error(p, t, interval) + weight_error(q, t, interval) +
                         weight_error(r, t, interval) + weight_error(s, t, interval);
    const detail::Weights_of_four weights = {
        {rounded_weight(p, t), rounded_weight(q, t), rounded_weight(r, t), rounded_weight(s, t)},
        error};
    return sign_of_places([&](const auto&... arguments) { return side(arguments..., weights); },
                          interval, p, q, r, s);
  } else {
    return sign_of_places(side, interval, p, q, r, s);
  }
}

}  // namespace

template <class Motion>
Filter_result filter_in_circle(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                               const Double_interval& after, bool vanishes_at) {
  if constexpr (HasWeight<Motion>) {
    if (have_same_weight_numbers(std::array{&p, &q, &r, &s})) {
      return filter_in_circle(center(p), center(q), center(r), center(s), after, vanishes_at);
    }
  }
  return with_differences(std::array{&p, &q, &r}, s, after.lower, [&](auto& d) {
    return classify_ahead(d, In_circle(), after, vanishes_at);
  });
}

template <class Motion>
Filter_result filter_orientation(const Motion& p, const Motion& q, const Motion& r,
                                 const Double_interval& after, bool vanishes_at) {
  return with_differences(std::array{&q, &r}, p, after.lower, [&](auto& d) {
    return classify_ahead(d, Orientation(), after, vanishes_at);
  });
}

template <class Motion>
Sign certain_x_order(const Motion& p, const Motion& q, const Double_interval& interval) {
  return with_differences(std::array{&p}, q, interval.lower,
                          [&](auto& d) { return sign_throughout(d, Coordinate{0}, interval); });
}

template <class Motion>
Sign certain_y_order(const Motion& p, const Motion& q, const Double_interval& interval) {
  return with_differences(std::array{&p}, q, interval.lower,
                          [&](auto& d) { return sign_throughout(d, Coordinate{1}, interval); });
}

template <class Motion>
Sign certain_orientation(const Motion& p, const Motion& q, const Motion& r,
                         const Double_interval& interval) {
  const Sign sign =
      sign_of_places([](auto&&... arguments) { return detail::certain_orientation(arguments...); },
                     interval, p, q, r);
  if (sign != CGAL::ZERO) return sign;
  return with_differences(std::array{&q, &r}, p, interval.lower,
                          [&](auto& d) { return sign_throughout(d, Orientation(), interval); });
}

template <class Motion>
Sign certain_in_circle(const Motion& p, const Motion& q, const Motion& r, const Motion& s,
                       const Double_interval& interval) {
  if constexpr (HasWeight<Motion>) {
    if (have_same_weight_numbers(std::array{&p, &q, &r, &s})) {
      return certain_in_circle(center(p), center(q), center(r), center(s), interval);
    }
  }
  const Sign sign = in_circle_of_places(interval, p, q, r, s);
  if (sign != CGAL::ZERO) return sign;
  return with_differences(std::array{&p, &q, &r}, s, interval.lower,
                          [&](auto& d) { return -sign_throughout(d, In_circle(), interval); });
}

template <class Motion>
Sign certain_scalar_product(const Motion& p, const Motion& q, const Motion& r,
                            const Double_interval& interval) {
  return with_differences(std::array{&p, &r}, q, interval.lower,
                          [&](auto& d) { return sign_throughout(d, Scalar_product(), interval); });
}

template <class Motion>
Sign certain_distance_order(const Motion& p, const Motion& q, const Motion& r,
                            const Double_interval& interval) {
  return with_differences(std::array{&q, &r}, p, interval.lower,
                          [&](auto& d) { return sign_throughout(d, Distance_order(), interval); });
}

// The weight of p is in both powers.
template <class Disc>
Sign certain_power_distance_order(const Disc& p, const Disc& q, const Disc& r,
                                  const Double_interval& interval) {
  if (have_same_weight_numbers(q, r)) {
    return certain_distance_order(center(p), center(q), center(r), interval);
  }
  return certain_distance_order<Disc>(p, q, r, interval);
}

template <class Disc>
Sign certain_weight_order(const Disc& p, const Disc& q, const Double_interval& interval) {
  const double t = interval.lower;
  const double difference = rounded_weight(p, t) - rounded_weight(q, t);
  // The rounding error of the difference is less than the slack of the two errors.
  const double error = weight_error(p, t, interval) + weight_error(q, t, interval);
  if (difference > error) return CGAL::POSITIVE;
  return difference < -error ? CGAL::NEGATIVE : CGAL::ZERO;
}

template <class Motion>
bool certainly_apart(const Motion& p, const Motion& q, const Double_interval& interval) {
  return are_apart(p, q, interval);
}

// One error bound for all triangles suffices, since most are far from flat.
template <class Motion>
bool certainly_surrounded(const Motion& p, std::span<const Motion* const> around,
                          const Double_interval& interval) {
  if (around.size() < 3) return false;
  std::array<Pair, most_around> places;
  Linear_sizes<Motion> sizes;
  for (std::size_t i = 0; i < around.size(); ++i) {
    places[i] = sizes.count(*around[i], p, interval.lower).place;
  }
  const double error = error_throughout(sizes.terms(), sizes.speed(), interval);
  Pair previous = places[around.size() - 1];
  bool result = true;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Pair place = places[i];
    result = result && previous[0] * place[1] - previous[1] * place[0] > error;
    previous = place;
  }
  return result;
}

}  // namespace kinetri

#endif  // KINETRI_SRC_KINETIC_FILTER_FILTER_IMPL_H
