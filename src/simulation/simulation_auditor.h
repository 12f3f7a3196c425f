// SPDX-License-Identifier: GPL-3.0-or-later
//
// The audit of a simulation (Simulation_2::audit).
#ifndef KINETRI_SRC_SIMULATION_SIMULATION_AUDITOR_H
#define KINETRI_SRC_SIMULATION_SIMULATION_AUDITOR_H

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/triangulation/audit.h"
#include "simulation/simulation_core.h"

namespace kinetri::detail {

/// One audit of a simulation, by newly computed exact certificates.
template <class Traits>
class Simulation_types<Traits>::Simulation_auditor {
 public:
  explicit Simulation_auditor(const Simulation_core& core) : core_(core) {}

  Audit_report run(Audit_level level) const;

 private:
  const Simulation_core& core_;
};

template <class Traits>
Audit_report Simulation_types<Traits>::Simulation_auditor::run(Audit_level level) const {
  Audit_report report = core_.triangulation.audit(level);
  const Disc_geometry& geometry = core_.geometry;
  const Contact_records& records = core_.records;
  const auto& queue = core_.schedule.queue();
  const auto fail = [&](std::string text) { report.failures.push_back(std::move(text)); };
  const auto pair_name = [](Point_id a, const Disc& b) {
    std::string result = "points " + std::to_string(a) + " and " + std::to_string(id_of(b));
    if constexpr (is_periodic) {
      result += " (image " + std::to_string(b.offset.x) + ", " + std::to_string(b.offset.y) + ")";
    }
    return result;
  };
  if (!queue.is_valid()) fail("the queue of contacts is out of order");
  if (!queue.empty() && queue.time_of(queue.top()) < geometry.current_time())
    fail("a contact has been missed");
  const Contact_record none;
  const auto contacts = [&](Point_id id) -> const Contact_record& {
    const Contact_record* const found = records.find(id);
    return found == nullptr ? none : *found;
  };
  std::size_t entries = 0;
  for (Point_id a = 0; a < geometry.number_of_ids(); ++a) {
    if (!geometry.contains(a)) {
      if (records.find(a) != nullptr) fail("a point that is not there has contacts");
      continue;
    }
    for (const Queue_handle event : {contacts(a).wall_event, contacts(a).vanish_event}) {
      if (event != no_event) ++entries;
    }
    for (const auto& [b, event] : contacts(a).partners) {
      if (!is_first(a, b)) continue;
      ++entries;
      const Contact_entry& contact = queue[event];
      if (contact.is_edge != geometry.is_edge(pair_from(a, b)) &&
          (contact.is_edge || contact.is_event)) {
        fail("the contact of " + pair_name(a, b) + " says wrongly whether there is an edge");
      }
      if (!core_.tracker.is_watched(pair_from(a, b))) {
        fail(pair_name(a, b) +
             " have a contact but neither an edge nor a third disc that overlaps");
      }
    }
  }
  entries += core_.schedule.changes_in_queue();
  if (entries != queue.size()) fail("the queue of contacts holds others than those of the points");
  if (!report.passed() || level < Audit_level::delaunay) return report;

  // Compares the time of a contact in the queue with the expected one.
  const auto compare = [&](const std::string& what, Queue_handle event,
                           const std::optional<Algebraic_number>& expected) {
    if (event == no_event) {
      if (expected) fail(what + " will have a contact that is not scheduled");
    } else if (!queue[event].is_event) {
      if (expected && *expected < queue.time_of(queue[event]))
        fail(what + " have a contact before the next check");
    } else if (!expected || *expected != queue.time_of(queue[event])) {
      fail(what + " have a contact at another time than scheduled, or none");
    }
  };
  // At the start, and after Endless_contacts_error, contacts of the present time may be due.
  const auto is_contact_due = [&](const Pair& pair) {
    const Queue_handle event = records.pair_event(pair);
    return event != no_event && queue[event].is_event &&
           queue.time_of(queue[event]) == geometry.current_time();
  };
  // The failure of an exact certificate; `from_bounds` computes a time that is not yet known.
  const auto failure_of = [](const Certificate& certificate,
                             const auto& from_bounds) -> std::optional<Algebraic_number> {
    if (certificate.kind == Certificate::Kind::never_fails) return std::nullopt;
    return certificate.failure ? *certificate.failure : from_bounds(certificate.bounds);
  };
  const Traits exact = geometry.traits().exact();
  if constexpr (!is_periodic) {
    for (Point_id id = 0; core_.setup.has_box() && id < geometry.number_of_ids(); ++id) {
      if (!geometry.contains(id)) continue;
      std::optional<Algebraic_number> first;
      for (const Wall_2& wall : core_.setup.walls()) {
        if (!exact.is_inside(geometry.point(id), wall, geometry.current_time())) {
          fail("point " + std::to_string(id) + " is outside of the box");
        }
        if (level < Audit_level::certificates) continue;
        const Certificate certificate =
            exact.wall_certificate(geometry.point(id), wall, geometry.current_time());
        const std::optional<Algebraic_number> failure =
            failure_of(certificate, [&](const auto& bounds) {
              return exact.wall_failure(geometry.point(id), wall, bounds);
            });
        if (failure && (!first || *failure < *first)) first = failure;
      }
      if (level < Audit_level::certificates) continue;
      compare("point " + std::to_string(id), contacts(id).wall_event, first);
    }
  }
  if (!core_.setup.has_response()) return report;
  // Every overlap is recorded; and overlapping discs separate, or a response has let them pass.
  geometry.for_each_exact_overlap(exact, [&](Point_id a, const Disc& b) {
    const Pair pair = pair_from(a, b);
    const Disc_overlap* const overlap = records.find_overlap(pair);
    if (overlap == nullptr) {  // its contact will record it
      if (is_contact_due(pair)) return;
      fail(pair_name(a, b) + " overlap, of which the simulation does not know");
    } else if (overlap->is_edge != geometry.is_edge(pair)) {
      fail("the overlap of " + pair_name(a, b) + " says wrongly whether there is an edge");
    } else if (!overlap->passes && !is_contact_due(pair) &&
               exact.do_approach(geometry.point_of(geometry.itself(a)), geometry.point_of(b),
                                 geometry.current_time())) {
      fail(pair_name(a, b) + " overlap and approach each other");
    }
  });
  if (level < Audit_level::certificates) return report;
  std::vector<Pair> watched;
  if constexpr (is_periodic) {
    watched = core_.triangulation.periodic_edges();
  } else {
    watched = core_.triangulation.finite_edge_ids();
  }
  for (const Point_id id : geometry.present_points()) {
    if constexpr (!is_periodic) {
      if (geometry.shown(id) != id) watched.push_back({geometry.shown(id), id});
    }
    for (const Disc& corner : geometry.corners_of(id)) watched.push_back(pair_of(id, corner));
    if (records.find(id) != nullptr && contacts(id).corners != geometry.corners_of(id)) {
      fail("the simulation does not know which triangle hides point " + std::to_string(id));
    }
  }
  // Recorded discs may have separated, or only touch.
  const auto overlap_now = [&](Point_id a, const Disc& b) {
    return geometry.may_touch(a, b, exact, geometry.current_time());
  };
  for (Point_id a = 0; a < geometry.number_of_ids(); ++a) {
    core_.tracker.for_each_pair_of(a, overlap_now,
                                   [&](const Disc& b) { watched.push_back(pair_from(a, b)); });
  }
  std::ranges::sort(watched);
  watched.erase(std::unique(watched.begin(), watched.end()), watched.end());
  for (const Pair& pair : watched) {
    const Point_id a = ids_of(pair)[0];
    const Disc b = second_of(pair);
    const Certificate certificate =
        core_.schedule.pair_certificate(pair, geometry.current_time(), exact);
    compare(pair_name(a, b), records.pair_event(pair),
            failure_of(certificate, [&](const auto& bounds) {
              return exact.contact_failure(geometry.point_of(geometry.itself(a)),
                                           geometry.point_of(b), core_.setup.diameter(), bounds);
            }));
  }
  return report;
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SIMULATION_AUDITOR_H
