// SPDX-License-Identifier: GPL-3.0-or-later
//
// The parts of a simulation, each with only the parts that it uses, for tests of one part.
#ifndef KINETRI_TEST_SUPPORT_SIMULATION_PARTS_H
#define KINETRI_TEST_SUPPORT_SIMULATION_PARTS_H

#include <set>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "simulation/overlap_tracker_impl.h"
#include "support/discs.h"

namespace kinetri::test {

/// Discs and their triangulation.
template <class Traits = Linear_kinetic_traits_2>
struct Geometry_part {
  using Motion = typename Traits::Motion;

  Geometry_part(const std::vector<Motion>& discs, const Simulation_options& options,
                const Algebraic_number& start = 0.0, const Traits& traits = Traits())
      : setup(traits, options), triangulation(discs, start, traits) {}

  /// The pairs of discs that overlap at a rational time, found among all pairs.
  std::set<Edge_ids> overlaps_at(const Rational& t) const {
    std::set<Edge_ids> result;
    const Point_id n = triangulation.next_id();
    for (Point_id a = 0; a < n; ++a) {
      for (Point_id b = a + 1; b < n; ++b) {
        const Rational reach = radius(a, t) + radius(b, t);
        const auto place = [&](Point_id id) {
          return place_at(center(triangulation.motion(id)), t);
        };
        if (CGAL::squared_distance(place(a), place(b)) < reach * reach) result.insert({a, b});
      }
    }
    return result;
  }
  Rational radius(Point_id id, const Rational& t) const {
    if constexpr (HasWeight<Motion>) return radius_at(triangulation.motion(id), t);
    return to_rational(setup.options().radius);
  }

  typename detail::Simulation_types<Traits>::Simulation_setup setup;
  Kinetic_triangulation_2<Traits> triangulation;
  detail::Disc_geometry<Traits> geometry{setup, triangulation};
};

/// The same with an empty schedule.
template <class Traits = Linear_kinetic_traits_2>
struct Contact_schedule_part : Geometry_part<Traits> {
  using Geometry_part<Traits>::Geometry_part;

  detail::Contact_records records;
  detail::Region_division division;
  Contact_counters counters;
  detail::Contact_schedule<Traits> schedule{this->geometry, records, division, counters};
};

/// The same with an empty tracker.
template <class Traits = Linear_kinetic_traits_2>
struct Tracker_part : Contact_schedule_part<Traits> {
  using Contact_schedule_part<Traits>::Contact_schedule_part;

  detail::Overlap_tracker<Traits> tracker{this->geometry, this->records, this->schedule};
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_SIMULATION_PARTS_H
