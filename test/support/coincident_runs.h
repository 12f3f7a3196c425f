// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that coincide for a while: changes on a tiny grid, after which most points share their
// trajectory with others. The oracle decides in rationals which points coincide, and which
// triangles the others make.
#ifndef KINETRI_TEST_SUPPORT_COINCIDENT_RUNS_H
#define KINETRI_TEST_SUPPORT_COINCIDENT_RUNS_H

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinetri/kinetri.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/discs.h"
#include "support/kinetic_runs.h"
#include "support/static_regular.h"

namespace kinetri::test {

inline Linear_motion_2 motion_of(const Linear_motion_2& m, double /*weight*/,
                                 const Linear_motion_2*) {
  return m;
}
inline Disc_motion_2 motion_of(const Linear_motion_2& m, double weight, const Disc_motion_2*) {
  return {m, 0, 0, weight};
}
inline Disc_motion_2 disc_of(const Linear_motion_2& m) {
  return {m, 0, 0, 0};
}
inline Disc_motion_2 disc_of(const Disc_motion_2& m) {
  return m;
}

/// Keeps edges and hidden points as the events say.
template <class Kinetic>
class Hidden_follower : public Event_observer {
 public:
  explicit Hidden_follower(Kinetic& kinetic) : kinetic_(kinetic), edges(edges_of(kinetic)) {
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (kinetic.contains(id) && kinetic.is_hidden(id)) hidden.insert(id);
    }
    kinetic.add_observer(*this);
  }

  void after_event(const Event& event) override {
    if (event.removed) edges.erase(*event.removed);
    if (event.added) edges.insert(*event.added);
    if (event.kind == Event_kind::erase) hidden.erase(*event.point_a);
    if (event.kind == Event_kind::hide) {
      if (!hidden.insert(*event.point_a).second) problem = "hides a hidden point";
      if (event.point_b && kinetic_.vertex(*event.point_a) != kinetic_.vertex(*event.point_b)) {
        problem = "is hidden by a point with another vertex";
      }
    }
    if (event.kind == Event_kind::reveal && hidden.erase(*event.point_a) == 0) {
      problem = "reveals a point that is not hidden";
    }
  }

 private:
  Kinetic& kinetic_;

 public:
  std::set<Edge_ids> edges;
  std::set<Point_id> hidden;
  std::string problem;
};

/// Random changes of a kept triangulation; `Choices` has integer(lowest, highest).
template <class Kinetic, class Choices>
class Coincident_run {
 public:
  using Motion = typename Kinetic::Motion;
  using Traits = std::remove_cvref_t<decltype(std::declval<Kinetic>().traits())>;

  explicit Coincident_run(Choices& choices) : choices_(choices) {
    has_weights_ = any(2) == 0;
    std::vector<Motion> motions;
    const std::size_t n = 1 + any(7);
    for (std::size_t i = 0; i < n; ++i) motions.push_back(any_motion());
    kinetic_.emplace(motions, Algebraic_number(0), Traits(), Coincident_points::hide);
  }

  /// The first problem after one of the steps; empty if there is none.
  std::string problem(int steps) {
    std::string found = difference("at the start");
    for (int k = 0; k < steps && found.empty(); ++k) {
      Hidden_follower<Kinetic> follower(*kinetic_);
      const std::string what = take_step();
      kinetic_->remove_observer(follower);
      found = difference(what);
      if (!found.empty()) break;
      if (!follower.problem.empty()) return what + ": " + follower.problem;
      if (follower.edges != edges_of(*kinetic_)) return what + ": edges by events differ";
      if (follower.hidden != hidden()) return what + ": hidden points by events differ";
      if (any(4) == 0) {
        const auto snapshot = kinetic_->snapshot();
        const Kinetic restored = Kinetic::restore(snapshot, {}, Coincident_points::hide);
        if (edges_of(restored) != edges_of(*kinetic_)) return what + ": restored edges";
      }
    }
    return found;
  }

  std::size_t twins_seen() const { return twins_; }
  std::size_t compared() const { return compared_; }

 private:
  // Less than `limit`.
  std::size_t any(std::size_t limit) {
    return static_cast<std::size_t>(choices_.integer(0, static_cast<int>(limit) - 1));
  }
  double whole(int lowest, int highest) { return choices_.integer(lowest, highest); }
  double now() const { return kinetic_ ? kinetic_->current_time().to_double() : 0.0; }

  // A point of the grid now, with a small velocity; the representation varies.
  Motion any_motion() {
    const Vector_2 place = {whole(0, 2), whole(0, 2)};
    const Vector_2 velocity = {whole(-1, 1), whole(-1, 1)};
    const double before = whole(0, 2);
    const double weight = has_weights_ ? whole(0, 1) : 0;
    return motion_of(
        {{place.x - before * velocity.x, place.y - before * velocity.y}, velocity, now() - before},
        weight, static_cast<const Motion*>(nullptr));
  }
  // Often the motion of another point.
  Motion other_motion() {
    const std::vector<Point_id> ids = present();
    if (ids.empty() || any(3) == 0) return any_motion();
    return kinetic_->motion(ids[any(ids.size())]);
  }
  std::vector<Point_id> present() const {
    std::vector<Point_id> result;
    for (Point_id id = 0; id < kinetic_->next_id(); ++id) {
      if (kinetic_->contains(id)) result.push_back(id);
    }
    return result;
  }

  std::string take_step() {
    std::vector<Point_id> ids = present();
    for (std::size_t k = ids.size(); k > 1; --k) std::swap(ids[k - 1], ids[any(k)]);
    std::ostringstream what;
    const std::size_t choice = any(9);
    if (choice == 0 || ids.empty()) {
      what << "insert " << kinetic_->insert(other_motion());
    } else if (choice == 1) {
      std::vector<Motion> motions;
      for (std::size_t k = 0; k < 1 + any(3); ++k) motions.push_back(other_motion());
      what << "insert " << motions.size() << " from " << kinetic_->insert(motions);
    } else if (choice == 2 && ids.size() > 1) {
      kinetic_->erase(ids.front());
      what << "erase " << ids.front();
    } else if (choice == 3 && ids.size() > 4) {
      ids.resize(1 + any(3));
      kinetic_->erase(ids);
      what << "erase " << ids.size() << ", first " << ids.front();
    } else if (choice < 6) {
      kinetic_->set_motion(ids.front(), other_motion());
      what << "set motion of " << ids.front();
    } else if (choice == 6) {
      ids.resize(1 + any(ids.size()));
      std::vector<Motion> motions;
      for (std::size_t k = 0; k < ids.size(); ++k) motions.push_back(other_motion());
      kinetic_->set_motions(ids, motions);
      what << "set motions of " << ids.size();
    } else if (choice == 7 && any(4) == 0) {
      kinetic_->reverse();
      what << "reverse";
    } else {
      const double until = now() + 0.5 * static_cast<double>(1 + any(3));
      kinetic_->advance_to(Algebraic_number(until));
      what << "advance";
    }
    what << " at " << kinetic_->current_time();
    return what.str();
  }

  std::set<Point_id> hidden() const {
    std::set<Point_id> result;
    for (const Point_id id : present()) {
      if (kinetic_->is_hidden(id)) result.insert(id);
    }
    return result;
  }

  // Whether two linear motions, and the weights, are equal from now on.
  static bool do_coincide(const Disc_motion_2& a, const Disc_motion_2& b) {
    return a.weight == b.weight && place_at(a, 0) == place_at(b, 0) &&
           place_at(a, 1) == place_at(b, 1);
  }

  // What differs from the oracle.
  std::string difference(const std::string& what) {
    const auto wrong = [&](const std::string& which) {
      std::ostringstream text;
      text << what << ": " << which << " differ";
      for (const Point_id id : present()) {
        const auto place = place_at(disc_of(kinetic_->motion(id)), 0);
        const auto next = place_at(disc_of(kinetic_->motion(id)), 1);
        text << "\n" << id << ": " << place << " to " << next;
      }
      return text.str();
    };
    const std::string audit = audit_problem(*kinetic_, Audit_level::certificates);
    if (!audit.empty()) return what + ": " + audit;
    std::vector<Point_id> shown;
    std::vector<Disc_motion_2> discs;
    std::vector<Motion> motions;
    std::set<Point_id> twins;
    for (const Point_id id : present()) {
      const Disc_motion_2 disc = disc_of(kinetic_->motion(id));
      const auto same = std::ranges::find_if(
          discs, [&](const Disc_motion_2& other) { return do_coincide(disc, other); });
      if (same == discs.end()) {
        shown.push_back(id);
        discs.push_back(disc);
        motions.push_back(kinetic_->motion(id));
        continue;
      }
      twins.insert(id);
      const Point_id by = shown[static_cast<std::size_t>(same - discs.begin())];
      if (!kinetic_->is_hidden(id)) return wrong("hidden coincident points");
      if (kinetic_->vertex(id) != kinetic_->vertex(by))
        return wrong("vertices of coincident points");
      const std::vector<Point_id> others = kinetic_->coincident_points(id);
      if (std::ranges::count(others, by) != 1) return wrong("groups of coincident points");
    }
    for (const Point_id id : shown) {
      if (kinetic_->vertex(id)->point().id() != id) return wrong("vertices");
      std::size_t group = 0;
      for (const Point_id twin : twins)
        group += kinetic_->vertex(twin)->point().id() == id ? 1u : 0u;
      if (kinetic_->coincident_points(id).size() != group) return wrong("sizes of groups");
    }
    twins_ += twins.size();
    if (kinetic_->number_of_points() != shown.size() + twins.size()) return wrong("numbers");
    // A start with the others, which are refused if they coincide.
    const Kinetic started(motions, kinetic_->current_time());
    std::set<Edge_ids> edges;
    for (const auto& [a, b] : started.finite_edge_ids()) edges.insert(edge_ids(shown[a], shown[b]));
    if (edges != edges_of(*kinetic_)) return wrong("edges of a start");
    std::set<Point_id> expected = twins;
    for (Point_id k = 0; k < shown.size(); ++k) {
      if (started.is_hidden(k)) expected.insert(shown[k]);
    }
    if (expected != hidden()) return wrong("hidden points of a start");
    // The definition, at a time just after now, if nothing happens until then.
    const auto next = kinetic_->next_event_time();
    const Rational t = Rational(now()) + Rational(1, 1009);
    if (next && *next <= Algebraic_number(t)) return {};
    const Static_regular oracle(discs, t);
    if (!oracle.is_certain()) return {};
    ++compared_;
    edges.clear();
    for (const auto& [a, b] : oracle.edges()) edges.insert(edge_ids(shown[a], shown[b]));
    return edges == edges_of(*kinetic_) ? std::string() : wrong("edges by definition");
  }

  Choices& choices_;
  bool has_weights_ = false;
  std::optional<Kinetic> kinetic_;
  std::size_t twins_ = 0;
  std::size_t compared_ = 0;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_COINCIDENT_RUNS_H
