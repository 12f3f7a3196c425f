// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tiny triangulation from bytes whose points come, turn, jump and go, alone or together, with
// full audits; the same without filters; and the brute-force simulator, which looks at all pairs
// and all circles. Points that coincide are hidden or refused.
#include <algorithm>
#include <map>
#include <vector>

#include "fuzz/fuzz.h"
#include "support/brute_force_simulator.h"
#include "support/kinetic_runs.h"
#include "support/same_run.h"

namespace kinetri {
namespace {

using test::Fuzz_input;
using test::require;

constexpr std::size_t most_points = 5;
constexpr int most_operations = 8;

Linear_motion_2 read_motion(Fuzz_input& input, double epoch) {
  Linear_motion_2 result;
  result.position.x = input.integer(-3, 3);
  result.position.y = input.integer(-3, 3);
  result.velocity.x = input.integer(-2, 2);
  result.velocity.y = input.integer(-2, 2);
  result.epoch = epoch;
  return result;
}

using Motions = std::map<Point_id, Linear_motion_2>;

// Of points with the same trajectory the one with the least id.
Motions shown_of(const Motions& motions) {
  Motions result;
  for (const auto& [id, motion] : motions) {
    const auto is_same = [&motion = motion](const auto& other) {
      return same_trajectory(other.second, motion);
    };
    if (std::ranges::none_of(result, is_same)) result.emplace(id, motion);
  }
  return result;
}

// A triangulation with filters, one without, and the oracle, which has no hidden points.
class Run {
 public:
  Run(const std::vector<Linear_motion_2>& motions, const Algebraic_number& start,
      Coincident_points coincident)
      : kinetic_(motions, start, {}, coincident),
        exact_(motions, start, Linear_kinetic_traits_2::exact(), coincident),
        oracle_(start) {
    for (Point_id id = 0; id < motions.size(); ++id) motions_[id] = motions[id];
    check();
  }

  // Goes on by so many halves of a unit of time, and looks between all events.
  void advance(int halves) {
    const Algebraic_number end(kinetic_.current_time().to_double() + halves / 2.0);
    if (end < kinetic_.current_time()) return;
    while (kinetic_.step(end) > 0) {
      exact_.step(end);
      check();
    }
    kinetic_.advance_to(end);
    exact_.advance_to(end);
    check();
  }

  void change(Fuzz_input& input) {
    const int kind = input.integer(0, 3);
    const auto id = static_cast<Point_id>(
        input.integer(0, std::max(0, static_cast<int>(kinetic_.next_id()) - 1)));
    const Linear_motion_2 motion = read_motion(input, input.integer(-1, 1));
    Motions after = motions_;
    if (kind == 0 && motions_.size() < most_points) {
      after[kinetic_.next_id()] = motion;
      make(after, [&](test::Kinetic_delaunay& kinetic) {
        const Point_id inserted = kinetic.insert(motion);
        require(after.contains(inserted), "another id");
      });
    } else if (kind == 1 && kinetic_.contains(id)) {
      after.erase(id);
      make(after, [&](test::Kinetic_delaunay& kinetic) { kinetic.erase(id); });
    } else if (kinetic_.contains(id)) {
      after[id] = motion;
      make(after, [&](test::Kinetic_delaunay& kinetic) { kinetic.set_motion(id, motion); });
    }
  }

  // Several at once: turns of some, or an erasure of some, or insertions.
  void change_several(Fuzz_input& input) {
    const int kind = input.integer(0, 3);
    std::vector<Point_id> ids;
    std::vector<Linear_motion_2> motions;
    Motions after = motions_;
    if (kind == 0) {
      for (std::size_t n = after.size(); n < most_points; ++n) {
        motions.push_back(read_motion(input, input.integer(-1, 1)));
        after[static_cast<Point_id>(kinetic_.next_id() + motions.size() - 1)] = motions.back();
      }
    } else {
      for (const auto& [id, motion] : motions_) {
        if (input.integer(0, 2) == 0) continue;
        ids.push_back(id);
        // Some only turn, and some exchange their motions.
        Linear_motion_2 next = read_motion(input, 0);
        if (input.integer(0, 1) == 0) next = {motion.position, next.velocity, motion.epoch};
        if (input.integer(0, 3) == 0) next = motions_.begin()->second;
        motions.push_back(next);
        after[id] = next;
        if (kind == 1) after.erase(id);
      }
    }
    make(after, [&](test::Kinetic_delaunay& kinetic) {
      if (kind == 0) {
        kinetic.insert(motions);
      } else if (kind == 1) {
        kinetic.erase(ids);
      } else {
        kinetic.set_motions(ids, motions);
      }
    });
  }

 private:
  // Makes a change, after which the points should have these motions.
  template <class Change>
  void make(const Motions& after, const Change& change) {
    const bool is_wrong =
        kinetic_.coincident() == Coincident_points::refuse && shown_of(after).size() < after.size();
    const Point_id next_id = kinetic_.next_id();
    for (test::Kinetic_delaunay* kinetic : {&kinetic_, &exact_}) {
      try {
        change(*kinetic);
        require(!is_wrong, "one trajectory twice, not refused");
      } catch (const Coincident_trajectories_error&) {
        require(is_wrong, "refused, though no trajectory is twice");
        require(kinetic->next_id() == next_id, "refused, but ids are gone");
      }
    }
    if (!is_wrong) motions_ = after;
    check();
  }

  // Brings the oracle up to date.
  void update_oracle(const Motions& shown) {
    const Motions before = oracle_.motions();
    for (const auto& [id, motion] : before) {
      if (!shown.contains(id)) oracle_.erase(id);
    }
    for (const auto& [id, motion] : shown) {
      const auto old = before.find(id);
      if (old == before.end() || old->second != motion) oracle_.set_motion(id, motion);
    }
  }

  void check() {
    const Motions shown = shown_of(motions_);
    require(kinetic_.number_of_points() == motions_.size(), "another number of points");
    for (const auto& [id, motion] : motions_) {
      require(kinetic_.motion(id) == motion, "another motion");
      require(kinetic_.is_hidden(id) != shown.contains(id), "other hidden points");
    }
    require(kinetic_.current_time() == exact_.current_time(), "another time without filters");
    const std::string problem = test::audit_problem(kinetic_, Audit_level::certificates);
    require(problem.empty(), problem);
    const std::vector<Edge_ids> edges = kinetic_.finite_edge_ids();
    require(edges == exact_.finite_edge_ids(), "other edges without filters");
    update_oracle(shown);
    oracle_.advance_to(kinetic_.current_time());
    require(std::ranges::equal(edges, oracle_.edges()), "other edges than those of the oracle");
  }

  Motions motions_;
  test::Kinetic_delaunay kinetic_;
  test::Kinetic_delaunay exact_;
  test::Brute_force_simulator oracle_;
};

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  kinetri::test::Fuzz_input input(data, size);
  const auto coincident = input.integer(0, 3) > 0 ? kinetri::Coincident_points::hide
                                                  : kinetri::Coincident_points::refuse;
  std::vector<kinetri::Linear_motion_2> motions;
  for (int points = input.integer(0, 4); points > 0; --points) {
    const auto motion = kinetri::read_motion(input, 0);
    const auto is_same = [&](const auto& other) { return same_trajectory(other, motion); };
    if (coincident == kinetri::Coincident_points::hide || std::ranges::none_of(motions, is_same)) {
      motions.push_back(motion);
    }
  }
  const kinetri::Algebraic_number start(kinetri::Rational(input.integer(-2, 2), 2));
  kinetri::Run run(motions, start, coincident);
  for (int i = 0; i < kinetri::most_operations && !input.at_end(); ++i) {
    const int kind = input.integer(0, 3);
    if (kind == 0) {
      run.advance(input.integer(1, 4));
    } else if (kind == 1) {
      run.change_several(input);
    } else {
      run.change(input);
    }
  }
  return 0;
}
