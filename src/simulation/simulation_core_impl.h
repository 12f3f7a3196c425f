// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_core.
#ifndef KINETRI_SRC_SIMULATION_SIMULATION_CORE_IMPL_H
#define KINETRI_SRC_SIMULATION_SIMULATION_CORE_IMPL_H

#include "simulation/contact_loop_impl.h"
#include "simulation/contact_runs.h"
#include "simulation/simulation_core.h"

namespace kinetri::detail {

template <class Traits>
auto Simulation_core<Traits>::overlapping_discs(Point_id id) const
    -> std::vector<typename Types::Disc> {
  const Traits exact = geometry.traits().exact();
  std::vector<typename Types::Disc> result;
  for (const auto& overlap : records.overlaps(id)) {
    if (geometry.contains(id_of(overlap.disc)) && geometry.may_touch(id, overlap.disc) &&
        exact.may_overlap(geometry.point_of(geometry.itself(id)), geometry.point_of(overlap.disc),
                          setup.diameter(), triangulation.current_time())) {
      result.push_back(overlap.disc);
    }
  }
  std::ranges::sort(result);
  return result;
}

template <class Traits>
void Simulation_core<Traits>::check_own_images() const {
  if constexpr (Types::is_periodic) {
    std::vector<typename Types::Point_2> discs;
    for (const Point_id id : geometry.present_points()) {
      discs.push_back(geometry.point(id));
      if (!Types::has_radii) break;
    }
    geometry.check_own_images(discs);
  }
}

template <class Traits>
void Simulation_core<Traits>::start() {
  records.make_room(geometry.number_of_ids());
  if (setup.has_response()) kinetic().reporter.keep_trail();
  tracker.find_all();
}

template <class Traits>
std::size_t Simulation_core<Traits>::advance_to(const Time& time,
                                                const std::function<bool()>& may_go_on) {
  kinetic().schedule.schedule_deferred();
  if constexpr (has_region_runs<Traits>) {
    if (may_run_by_regions()) return Contact_runs<Traits>::advance_to(*this, time, may_go_on);
  }
  join_contacts();
  std::size_t events = 0;
  while (may_go_on == nullptr || may_go_on()) {
    if (can_run_triangulation()) {
      if (!loop.run_triangulation(time, may_go_on, events)) break;
      if (!loop.may_be_due(time)) {  // a step would merge the shards of the queues
        events += kinetic().advance_to(time, nullptr);
        break;
      }
    }
    const std::size_t more = step(&time);
    if (more == 0) {
      kinetic().advance_to(time, nullptr);
      break;
    }
    events += more;
  }
  return events;
}

// Whether events of the triangulation do not change the queue. With a response, edges have
// contacts; an observer that looks at the triangulation may schedule changes.
template <class Traits>
bool Simulation_core<Traits>::can_run_triangulation() const {
  return !setup.has_response() && !kinetic().reporter.observers().any_of([](const auto& observer) {
    return observer.looks_at_triangulation();
  });
}

// Whether optimistic parallel execution is possible and may be faster.
template <class Traits>
bool Simulation_core<Traits>::may_run_by_regions() const {
  if constexpr (has_region_runs<Traits>) {
    return (setup.has_box() || setup.has_response()) &&
           may_pay_by_regions(triangulation.number_of_points(), threads) &&
           Contact_runs<Traits>::can_run(*this);
  }
  return false;
}

template <class Traits>
void Simulation_core<Traits>::join_parts() {
  join_contacts();
  kinetic().join_parts();
}

// The same for the queue of contacts.
template <class Traits>
void Simulation_core<Traits>::join_contacts() {
  if constexpr (has_region_runs<Traits>) {
    if (schedule.queue().is_divided()) Contact_runs<Traits>::join(*this);
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SIMULATION_CORE_IMPL_H
