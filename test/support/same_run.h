// SPDX-License-Identifier: GPL-3.0-or-later
//
// Compares the kinetic triangulation with the brute-force simulator over a whole run.
#ifndef KINETRI_TEST_SUPPORT_SAME_RUN_H
#define KINETRI_TEST_SUPPORT_SAME_RUN_H

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "support/brute_force_simulator.h"
#include "support/kinetic_runs.h"

namespace kinetri::test {

/// Runs both side by side.
template <KineticTraits_2 Traits>
class Same_run {
 public:
  using Motion = typename Traits::Motion;

  Same_run(const std::vector<Motion>& motions, const Algebraic_number& start)
      : motions_(motions), kinetic_(motions, start), recorder_(kinetic_), previous_(start) {}

  /// The first difference between `start` and the last critical time; empty if there is none.
  std::string problem() {
    std::vector<Algebraic_number> times = critical_times(motions_, previous_);
    times.emplace_back(Rational((times.empty() ? previous_ : times.back()).upper() + 1));
    std::set<Edge_ids> edges = recorder_.edges;
    for (const Algebraic_number& time : times) {
      // Nothing changes between two critical times, so one time between suffices.
      const Rational between = simplest_between(previous_, time);
      const std::string found = problem_at(between, edges);
      if (!found.empty()) return found + " at " + between.str();
      previous_ = time;
    }
    kinetic_.advance_to(times.back());
    return kinetic_.next_event_time() ? "an event after the last critical time" : "";
  }

 private:
  // Advances to `time`; previous_ is the last critical time before it. `edges` are those just
  // before previous_, and become those at `time`.
  std::string problem_at(const Rational& time, std::set<Edge_ids>& edges) {
    const std::size_t first = recorder_.events.size();
    kinetic_.advance_to(Algebraic_number(time));
    const std::size_t count = recorder_.events.size() - first;
    const std::set<Edge_ids> actual = edges_of(kinetic_);
    if (actual != recorder_.edges) return "the log does not add up";
    if (actual != edges_at(motions_, time)) return "wrong edges";
    for (std::size_t i = first; i < recorder_.events.size(); ++i) {
      if (recorder_.events[i].time != previous_) return "an event at no critical time before";
    }
    if (count == 0 && actual != edges) return "a change without an event";
    // If the edges did not change, no certificate has failed.
    if (count > 0 && actual == edges) return "events that change nothing";
    edges = actual;
    return audit_problem(kinetic_, Audit_level::reference);
  }

  const std::vector<Motion>& motions_;
  Kinetic_delaunay_triangulation_2<Traits> kinetic_;
  Event_recorder recorder_;
  Algebraic_number previous_;
};

/// The first difference, from `start` to the last critical time, in edges or in the times at which
/// they change; empty if there is none.
inline std::string difference_from_brute_force(const std::vector<Linear_motion_2>& motions,
                                               const Algebraic_number& start = Algebraic_number()) {
  return Same_run<Linear_kinetic_traits_2>(motions, start).problem();
}
inline std::string difference_from_brute_force(const std::vector<Polynomial_motion_2>& motions,
                                               const Algebraic_number& start = Algebraic_number()) {
  return Same_run<Polynomial_kinetic_traits_2>(motions, start).problem();
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_SAME_RUN_H
