// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulation beside the oracle that compares all pairs.
#ifndef KINETRI_TEST_SUPPORT_ALL_PAIRS_COMPARISON_H
#define KINETRI_TEST_SUPPORT_ALL_PAIRS_COMPARISON_H

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/all_pairs_simulator.h"

namespace kinetri::test {

/// Counts of what has been compared.
struct All_pairs_totals {
  std::size_t runs = 0;
  std::size_t contacts = 0;
  std::size_t pressed = 0;  ///< runs that ended with a resting contact
};

/// A scheduled change of a point, which need not exist.
template <class Motion>
struct All_pairs_change {
  double time = 0;
  Point_id id = no_point;        ///< of an insertion the next id
  std::optional<Motion> motion;  ///< empty: erase the point
};

namespace detail {

struct Contact_recorder : Event_observer {
  void after_event(const Event& event) override {
    if (event.kind == Event_kind::wall || event.kind == Event_kind::collision) {
      events.push_back(event);
    }
  }
  std::vector<Event> events;
};

inline std::string contact_text(Event_kind kind, Point_id a, Point_id b,
                                const Algebraic_number& time) {
  std::ostringstream out;
  out << name(kind) << ' ' << a;
  if (b != no_point) out << ' ' << b;
  out << " at " << time.to_double();
  return out.str();
}

/// The difference between an event and the contact that the oracle expects; empty if there is none.
inline std::string contact_problem(const Event& event,
                                   const std::optional<All_pairs_contact>& expected) {
  const Point_id b = event.point_b.value_or(no_point);
  const bool is_wall = event.kind == Event_kind::wall;
  if (expected && event.kind == expected->kind && event.time == expected->time &&
      *event.point_a == expected->a && (is_wall || b == expected->b)) {
    return {};
  }
  const std::string found = contact_text(event.kind, *event.point_a, b, event.time);
  if (!expected) return "one too many: " + found;
  return found + ", expected " +
         contact_text(expected->kind, expected->a, expected->b, expected->time);
}

}  // namespace detail

/// Runs a simulation and the oracle up to `until`, or to a limit of contacts, and audits the
/// simulation at every fourth instant and, with all certificates, at the start, after each change
/// and at the end. Returns the first problem, or an empty string. Precondition: the
/// times of `changes` are strictly increasing.
template <class Traits>
std::string difference_from_all_pairs(
    const std::vector<typename Traits::Motion>& motions, const Simulation_options& options,
    const std::vector<All_pairs_change<typename Traits::Motion>>& changes, double until,
    All_pairs_totals& totals) {
  constexpr std::size_t most_contacts = 120;
  All_pairs_simulator<typename Traits::Motion> oracle(motions, options);
  Simulation_2<Traits> simulation(motions, options);
  detail::Contact_recorder contacts;
  simulation.add_observer(contacts);
  ++totals.runs;
  std::size_t compared = 0;
  std::size_t instants = 0;
  bool is_pressed = false;
  const auto audit_problem = [&](Audit_level level) -> std::string {
    const Audit_report report = simulation.audit(level);
    if (report.passed()) return {};
    std::ostringstream out;
    out << "audit at " << simulation.current_time().to_double() << ": " << report.failures.front();
    return out.str();
  };
  const auto run_to = [&](const Algebraic_number& end) -> std::string {
    for (std::size_t events = 1; events > 0 && !is_pressed && compared < most_contacts;) {
      try {
        events = simulation.step(end);
      } catch (const Endless_contacts_error&) {
        is_pressed = true;
      }
      for (; compared < contacts.events.size(); ++compared) {
        std::string problem = detail::contact_problem(contacts.events[compared], oracle.step(end));
        if (!problem.empty()) return "contact " + std::to_string(compared) + ": " + problem;
      }
      if (is_pressed) break;
      if (++instants % 4 != 0) continue;
      std::string problem = audit_problem(Audit_level::delaunay);
      if (!problem.empty()) return problem;
    }
    if (compared >= most_contacts) return {};
    const auto missed = oracle.step(end);
    if (missed) {
      return "missed: " + detail::contact_text(missed->kind, missed->a, missed->b, missed->time);
    }
    return is_pressed == oracle.is_pressed() ? "" : "only one of the two is pressed";
  };

  std::string problem = audit_problem(Audit_level::certificates);
  for (const auto& change : changes) {
    const double time = change.time;
    const Point_id id = change.id;
    const auto& motion = change.motion;
    if (!problem.empty() || is_pressed || compared >= most_contacts || time > until) break;
    problem = run_to(Algebraic_number(time));
    if (!problem.empty() || is_pressed || compared >= most_contacts) break;
    simulation.advance_to(time);
    oracle.advance_to(Algebraic_number(time));
    const bool is_new = id == simulation.triangulation().next_id();
    if (!is_new && !simulation.triangulation().contains(id)) continue;
    if (is_new && motion) {
      simulation.insert(*motion);
    } else if (motion) {
      simulation.set_motion(id, *motion);
    } else if (!is_new) {
      simulation.erase(id);
    }
    oracle.set_motion(id, motion);
    problem = audit_problem(Audit_level::certificates);
  }
  if (problem.empty()) problem = run_to(Algebraic_number(until));
  totals.contacts += compared;
  totals.pressed += is_pressed ? 1 : 0;
  if (!problem.empty() || is_pressed || compared >= most_contacts) return problem;
  for (const auto& [id, motion] : oracle.motions()) {
    if (!simulation.triangulation().contains(id) ||
        simulation.triangulation().motion(id) != motion) {
      return "point " + std::to_string(id) + " is not there, or has another motion";
    }
  }
  if (simulation.triangulation().number_of_points() != oracle.motions().size()) {
    return "there are points that have been erased";
  }
  return audit_problem(Audit_level::certificates);
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_ALL_PAIRS_COMPARISON_H
