// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of the kinetic triangulation with checks. Each function returns a problem in one line, or an
// empty string, so that both GoogleTest and rapidcheck can use it.
#ifndef KINETRI_TEST_SUPPORT_KINETIC_RUNS_H
#define KINETRI_TEST_SUPPORT_KINETIC_RUNS_H

#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/kinetri.h"
#include "support/motions.h"

namespace kinetri::test {

using Kinetic_delaunay = Kinetic_delaunay_triangulation_2<>;
using Kinetic_event = Event;

template <class Kinetic>
std::set<Edge_ids> edges_of(const Kinetic& kinetic) {
  const auto edges = kinetic.finite_edge_ids();
  return {edges.begin(), edges.end()};
}

/// Records all events, and applies them to the edges.
class Event_recorder : public Kinetic_delaunay::Observer {
 public:
  template <class Kinetic>
  explicit Event_recorder(Kinetic& kinetic) : edges(edges_of(kinetic)) {
    kinetic.add_observer(*this);
  }

  void after_event(const Kinetic_event& event) override {
    if (event.removed) edges.erase(*event.removed);
    if (event.added) edges.insert(*event.added);
    events.push_back(event);
  }

  std::vector<Kinetic_event> events;
  std::set<Edge_ids> edges;
};

inline std::ostream& operator<<(std::ostream& out, const Kinetic_event& event) {
  const auto edge = [&out](const char* what, const std::optional<Edge_ids>& ids) {
    if (ids) out << what << (*ids)[0] << '-' << (*ids)[1];
  };
  out << name(event.kind);
  edge(" removes ", event.removed);
  edge(" adds ", event.added);
  return out << " at " << event.time;
}

/// The first failure of the audit, with the time.
template <class Kinetic>
std::string audit_problem(const Kinetic& kinetic, Audit_level level) {
  const Audit_report report = kinetic.audit(level);
  if (report.passed()) return {};
  std::ostringstream text;
  text << "audit just after " << kinetic.current_time() << ": " << report.failures.front();
  return text.str();
}

/// Runs to `until`, or to the last event, instant by instant, with an audit after each and a full
/// audit at both ends. Each instant must have the announced time, and the events must account for
/// every change of the edges.
template <class Kinetic>
std::string audited_run(Kinetic& kinetic, const std::optional<Algebraic_number>& until,
                        Audit_level level) {
  Event_recorder recorder(kinetic);
  const auto run = [&]() -> std::string {
    std::string problem = audit_problem(kinetic, Audit_level::certificates);
    while (problem.empty()) {
      const auto next = kinetic.next_event_time();
      if (!next || (until && *next > *until)) break;
      if (*next <= kinetic.current_time()) return "an event that is not in the future";
      const std::size_t before = recorder.events.size();
      const std::size_t count = kinetic.step(*next);
      if (kinetic.current_time() != *next) return "a step to another time than announced";
      if (recorder.events.size() != before + count) return "a step that counts its events wrongly";
      for (std::size_t i = before; i < recorder.events.size(); ++i) {
        if (recorder.events[i].time != *next) return "an event at another time than its instant";
      }
      if (recorder.edges != edges_of(kinetic)) return "events that do not account for the edges";
      problem = audit_problem(kinetic, level);
    }
    if (!problem.empty()) return problem;
    if (until && kinetic.advance_to(*until) != 0) return "events after the last announced one";
    return audit_problem(kinetic, Audit_level::certificates);
  };
  const std::string problem = run();
  kinetic.remove_observer(recorder);
  return problem;
}

/// The first difference of two sequences of events: in number, kind, exact time, edges, or points.
inline std::string difference(const std::vector<Kinetic_event>& one,
                              const std::vector<Kinetic_event>& other) {
  std::ostringstream text;
  for (std::size_t i = 0; i < one.size() && i < other.size(); ++i) {
    const Kinetic_event& a = one[i];
    const Kinetic_event& b = other[i];
    if (a.kind != b.kind || a.time != b.time || a.removed != b.removed || a.added != b.added ||
        a.removed_offset != b.removed_offset || a.added_offset != b.added_offset ||
        a.point_a != b.point_a || a.point_b != b.point_b) {
      text << "event " << i << ": " << a << "; the other one: " << b;
      return text.str();
    }
  }
  if (one.size() != other.size()) {
    text << one.size() << " events; the other run has " << other.size();
  }
  return text.str();
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_KINETIC_RUNS_H
