// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Simulation_2: counters and audits.
#ifndef KINETRI_IMPL_SIMULATION_AUDIT_IMPL_H
#define KINETRI_IMPL_SIMULATION_AUDIT_IMPL_H

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/impl/base/check.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

template <ContactKineticTraits_2 Traits>
Contact_counters Simulation_2<Traits>::contact_counters() const {
  Contact_counters result = counters_;
  result.queue = queue_.counters();
  return result;
}

template <ContactKineticTraits_2 Traits>
Certificate_counters Simulation_2<Traits>::certificate_counters() const {
  Certificate_counters result = triangulation_.certificate_counters();
  return result += certificate_counters_;
}

template <ContactKineticTraits_2 Traits>
Audit_report Simulation_2<Traits>::audit(Audit_level level) const {
  Audit_report report = triangulation_.audit(level);
  const auto fail = [&](std::string text) { report.failures.push_back(std::move(text)); };
  const auto pair_name = [](Point_id a, Point_id b) {
    return "points " + std::to_string(a) + " and " + std::to_string(b);
  };
  if (!queue_.is_valid()) fail("the queue of contacts is out of order");
  if (!queue_.empty() && queue_.time_of(queue_.top()) < current_time())
    fail("a contact has been missed");
  const Contacts none;
  const auto contacts = [&](Point_id id) -> const Contacts& {
    const Contacts* const found = find_contacts(id);
    return found == nullptr ? none : *found;
  };
  std::size_t entries = 0;
  for (Point_id a = 0; a < triangulation_.next_id(); ++a) {
    if (!triangulation_.contains(a)) {
      if (find_contacts(a) != nullptr) fail("a point that is not there has contacts");
      continue;
    }
    for (const Queue_handle event : {contacts(a).wall_event, contacts(a).vanish_event}) {
      if (event != no_event) ++entries;
    }
    for (const auto& [b, event] : contacts(a).partners) {
      if (b < a) continue;
      ++entries;
      const Entry& contact = queue_[event];
      if (contact.is_edge != is_edge({a, b}) && (contact.is_edge || contact.is_event)) {
        fail("the contact of " + pair_name(a, b) + " says wrongly whether there is an edge");
      }
      if (!is_watched({a, b})) {
        fail(pair_name(a, b) +
             " have a contact but neither an edge nor a third disc that overlaps");
      }
    }
  }
  entries += scheduled_entries_;
  if (entries != queue_.size()) fail("the queue of contacts holds others than those of the points");
  if (!report.passed() || level < Audit_level::delaunay) return report;

  // The time of the contact that the queue holds, and of the one that is to be found.
  const auto compare = [&](const std::string& what, Queue_handle event,
                           const std::optional<Time>& expected) {
    if (event == no_event) {
      if (expected) fail(what + " will have a contact that is not scheduled");
    } else if (!queue_[event].is_event) {
      if (expected && *expected < queue_.time_of(queue_[event]))
        fail(what + " have a contact before the next check");
    } else if (!expected || *expected != queue_.time_of(queue_[event])) {
      fail(what + " have a contact at another time than scheduled, or none");
    }
  };
  // At the start, and after contacts without end, contacts of the present time may be still to
  // come.
  const auto is_contact_due = [&](const Edge_ids& pair) {
    const Queue_handle event = find_pair(pair);
    return event != no_event && queue_[event].is_event &&
           queue_.time_of(queue_[event]) == current_time();
  };
  // Of an exact certificate; `from_bounds` makes the time where that has not been done yet.
  const auto failure_of = [](const Certificate& certificate,
                             const auto& from_bounds) -> std::optional<Time> {
    if (certificate.kind == Certificate::Kind::never_fails) return std::nullopt;
    return certificate.failure ? *certificate.failure : from_bounds(certificate.bounds);
  };
  const Traits exact = traits_.exact();
  for (Point_id id = 0; options_.box && id < triangulation_.next_id(); ++id) {
    if (!triangulation_.contains(id)) continue;
    std::optional<Time> first;
    for (const Wall_2& wall : walls_) {
      if (!exact.is_inside(point(id), wall, current_time())) {
        fail("point " + std::to_string(id) + " is outside of the box");
      }
      if (level < Audit_level::certificates) continue;
      const Certificate certificate = exact.wall_certificate(point(id), wall, current_time());
      const std::optional<Time> failure = failure_of(certificate, [&](const auto& bounds) {
        return exact.wall_failure(point(id), wall, bounds);
      });
      if (failure && (!first || *failure < *first)) first = failure;
    }
    if (level < Audit_level::certificates) continue;
    compare("point " + std::to_string(id), contacts(id).wall_event, first);
  }
  if (!options_.response) return report;
  // Every overlap is known; and discs that overlap separate, or a response has let them pass.
  for_each_exact_overlap([&](Point_id a, Point_id b) {
    const Overlap* const overlap = find_overlap({a, b});
    if (overlap == nullptr) {  // it is noted with its contact
      if (is_contact_due({a, b})) return;
      fail(pair_name(a, b) + " overlap, of which the simulation does not know");
    } else if (overlap->is_edge != is_edge({a, b})) {
      fail("the overlap of " + pair_name(a, b) + " says wrongly whether there is an edge");
    } else if (!overlap->passes && !is_contact_due({a, b}) &&
               exact.do_approach(point(a), point(b), current_time())) {
      fail(pair_name(a, b) + " overlap and approach each other");
    }
  });
  if (level < Audit_level::certificates) return report;
  std::vector<Edge_ids> watched = triangulation_.finite_edge_ids();
  for (const Point_id id : present_points()) {
    for_each_corner(id, [&](Point_id corner) { watched.push_back(edge_ids(id, corner)); });
    if (find_contacts(id) != nullptr && contacts(id).corners != corners_of(id)) {
      fail("the simulation does not know which triangle hides point " + std::to_string(id));
    }
  }
  // Records may be of discs that have parted, or that only touch.
  const auto overlap_now = [&](Point_id a, Point_id b) { return may_touch(a, b, exact); };
  for (Point_id a = 0; a < triangulation_.next_id(); ++a) {
    for_each_pair_of(a, overlap_now, [&](Point_id b) { watched.push_back({a, b}); });
  }
  std::ranges::sort(watched);
  watched.erase(std::unique(watched.begin(), watched.end()), watched.end());
  for (const auto& [a, b] : watched) {
    const Certificate certificate = pair_certificate({a, b}, current_time(), exact);
    compare(pair_name(a, b), find_pair({a, b}),
            failure_of(certificate, [&, a = a, b = b](const auto& bounds) {
              return exact.contact_failure(point(a), point(b), diameter_, bounds);
            }));
  }
  return report;
}

// Calls `function` with all pairs, the smaller id first, whose discs overlap just after the present
// time: exactly, and without what the simulation knows of overlaps.
template <ContactKineticTraits_2 Traits>
template <class Function>
void Simulation_2<Traits>::for_each_exact_overlap(Function function) const {
  const Traits exact = traits_.exact();
  if constexpr (has_radii) {
    for_each_close_pair(present_points(), [&](Point_id a, Point_id b) {
      if (exact.may_overlap(point(a), point(b), diameter_, current_time())) function(a, b);
    });
  } else {
    for (const Point_id a : present_points()) {
      for (const Point_id b : overlapping_points(a, exact)) {
        if (a < b) function(a, b);
      }
    }
  }
}

}  // namespace kinetri

#endif  // KINETRI_IMPL_SIMULATION_AUDIT_IMPL_H
