// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_KINETIC_CORE_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_KINETIC_CORE_IMPL_H

#include <chrono>
#include <type_traits>

#include "kinetri/impl/triangulation/kinetic_core.h"
#include "kinetri/impl/triangulation/point_changes_impl.h"

namespace kinetri::detail {

template <class Traits>
void Kinetic_types<Traits>::Kinetic_core::start_with(std::span<const Point_2> points,
                                                     std::size_t ids) {
  const auto started = std::chrono::steady_clock::now();
  if constexpr (is_periodic) {
    static_assert(std::is_same_v<Traits, Periodic_kinetic_traits_2> ||
                      std::is_same_v<Traits, Periodic_disc_kinetic_traits_2>,
                  "triangulations of a periodic box are compiled for Periodic_kinetic_traits_2 and "
                  "Periodic_disc_kinetic_traits_2");
    const Periodic_box_2& box = certification.traits().box();
    box.require_area(schedule.current_time(), schedule.current_time());
    schedule.set_end(box.collapse_after(schedule.current_time()));
  }
  topology.set_weights_equal(Kinetic_types<Traits>::Topology::have_equal_weights(points));
  std::vector<Edge_ids> coincident;
  const auto build = [&](std::span<const Point_2> some) {
    return schedule.with_time_of_errors([&] {
      return Kinetic_types<Traits>::Static_construction::build(
          some, schedule.current_time(),
          certification.traits().instantaneous_traits(topology.clock()), coincident);
    });
  };
  Triangulation made = build(points);
  std::vector<Point_2> distinct(coincident.empty() ? points.end() : points.begin(), points.end());
  while (!coincident.empty()) {
    topology.check_may_coincide(coincident);
    topology.take_twins(distinct, coincident);
    coincident.clear();
    made = build(distinct);
  }
  topology.start(std::move(made), ids);
  const auto built = std::chrono::steady_clock::now();
  schedule.schedule_all();
  const auto initialized = std::chrono::steady_clock::now();
  using Seconds = std::chrono::duration<double>;
  construction_seconds = {Seconds(built - started).count(), Seconds(initialized - built).count()};
}

template <class Traits>
std::size_t Kinetic_types<Traits>::Kinetic_core::advance_to(
    const Time& time, const std::function<bool()>& may_go_on) {
  schedule.schedule_deferred();
  if constexpr (has_region_runs<Traits>) {
    if (may_pay_by_regions(topology.number_of_vertices(), threads)) {
      return Region_runs<Traits>::advance_to(*this, time, may_go_on);
    }
  }
  join_parts();
  return loop.run_to(time, may_go_on);
}

template <class Traits>
void Kinetic_types<Traits>::Kinetic_core::join_parts() {
  if constexpr (has_region_runs<Traits>) {
    if (schedule.queue().is_divided()) Region_runs<Traits>::join(*this);
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_KINETIC_CORE_IMPL_H
