// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small triangulation from bytes in a periodic box, with points or weighted points, most of them
// on a grid, that turn, jump, come, go and move through events while the box is sheared, grows or
// shrinks: after each step beside a new triangulation of the same motions, and audited.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/fuzz.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/position_runs.h"

namespace {

using kinetri::Algebraic_number;
using kinetri::Linear_motion_2;
using kinetri::Periodic_box_2;
using kinetri::Periodic_edge;
using kinetri::Point_id;
using kinetri::Rational;
using kinetri::Vector_2;
using kinetri::test::Fuzz_input;
using kinetri::test::ids_of;
using kinetri::test::motions_of;

/// Edges and hidden points by the events alone.
template <class Kinetic>
class Event_follower : public kinetri::Event_observer {
 public:
  explicit Event_follower(Kinetic& kinetic) : kinetic_(kinetic), hidden_(hidden_points(kinetic)) {
    for (const Periodic_edge& edge : kinetic.periodic_edges()) edges_.insert(edge);
    kinetic_.add_observer(*this);
  }
  ~Event_follower() override { kinetic_.remove_observer(*this); }
  Event_follower(const Event_follower&) = delete;
  Event_follower& operator=(const Event_follower&) = delete;

  void after_event(const kinetri::Event& event) override {
    using enum kinetri::Event_kind;
    if (event.removed) {
      note(edges_.erase({*event.removed, event.removed_offset}) == 1, "removes no edge");
    }
    if (event.added) {
      note(edges_.insert({*event.added, event.added_offset}).second, "adds an edge again");
    }
    if (event.kind == hide) note(hidden_.insert(*event.point_a).second, "hides a hidden point");
    if (event.kind == reveal) note(hidden_.erase(*event.point_a) == 1, "reveals a visible point");
    if (event.kind == erase) hidden_.erase(*event.point_a);
  }

  /// What is wrong with what the events have told; empty if nothing is.
  std::string problem() const {
    if (!problem_.empty()) return problem_;
    if (kinetic_.periodic_edges() != std::vector(edges_.begin(), edges_.end())) {
      return "other edges by events";
    }
    return hidden_points(kinetic_) == hidden_ ? "" : "other hidden points by events";
  }

  static std::set<Point_id> hidden_points(const Kinetic& kinetic) {
    std::set<Point_id> result;
    for (const Point_id id : ids_of(kinetic)) {
      if (kinetic.is_hidden(id)) result.insert(id);
    }
    return result;
  }

 private:
  void note(bool holds, const std::string& what) {
    if (!holds && problem_.empty()) problem_ = "an event " + what;
  }

  Kinetic& kinetic_;
  std::set<Periodic_edge> edges_;
  std::set<Point_id> hidden_;
  std::string problem_;
};

template <class Kinetic>
class Periodic_run {
 public:
  using Motion = typename Kinetic::Motion;
  using Traits = std::remove_cvref_t<decltype(std::declval<Kinetic>().traits())>;

  explicit Periodic_run(Fuzz_input& input)
      : input_(input),
        scale_(std::ldexp(1, std::array{0, 0, 0, -200, 200}[any(5)])),
        range_(input.integer(1, 9)) {
    const Periodic_box_2 box = any_box();
    std::vector<Motion> motions;
    for (std::size_t n = any(most_points + 1); n > 0; --n) motions.push_back(any_motion(0));
    kinetic_.emplace(motions, Algebraic_number(0), Traits(box));
  }

  void take_steps(int number) {
    require(difference(), "at the start");
    for (int k = 0; k < number && !input_.at_end(); ++k) {
      Event_follower<Kinetic> follower(*kinetic_);
      const std::string what = take_step();
      std::string found = follower.problem();
      if (found.empty()) found = difference();
      require(found, "step " + std::to_string(k) + ", " + what);
    }
  }

 private:
  static constexpr std::size_t most_points = 7;

  static void require(const std::string& found, const std::string& where) {
    kinetri::test::require(found.empty(), where + ": " + found);
  }

  // Less than `limit`.
  std::size_t any(std::size_t limit) {
    return static_cast<std::size_t>(input_.integer(0, static_cast<int>(limit) - 1));
  }
  double number(int range) {
    const double whole = input_.integer(-range, range);
    return scale_ * (any(8) == 0 ? whole + input_.byte() / 256.0 : whole);
  }
  Vector_2 vector(int range) {
    const double x = number(range);
    return {x, number(range)};
  }

  Periodic_box_2 any_box() {
    const bool rests = any(4) == 0;
    const auto lattice_vector = [&] {
      const Vector_2 position = vector(range_);
      return Linear_motion_2{position, rests ? Vector_2() : vector(1), 0};
    };
    const Linear_motion_2 a = lattice_vector();
    const Linear_motion_2 b = lattice_vector();
    // Scales are powers of two: the products are exact.
    const Vector_2 p = {a.position.x / scale_, a.position.y / scale_};
    const Vector_2 q = {b.position.x / scale_, b.position.y / scale_};
    if (p.x * q.y > p.y * q.x) return {a, b};
    const double side = scale_ * range_;
    return {{{side, 0}, a.velocity, 0}, {{0, side}, b.velocity, 0}};
  }

  Motion any_motion(double epoch) {
    Motion result = {};
    result.position = vector(2 * range_);
    result.velocity = any(3) == 0 ? Vector_2() : vector(3);
    result.epoch = epoch;
    if constexpr (kinetri::HasWeight<Motion>) {
      result.radius = scale_ * input_.integer(0, range_);
      if (any(2) == 0) result.growth = scale_ * input_.integer(-1, 1);
      if (any(2) == 0) result.weight = scale_ * scale_ * input_.integer(-range_, range_);
    }
    return result;
  }

  const Algebraic_number& now() const { return kinetic_->current_time(); }

  // A time before the box loses its area.
  Algebraic_number later() {
    Algebraic_number end(Rational(now().upper() + 1));
    if (const auto collapse = kinetic_->traits().box().collapse_after(now())) {
      end = std::min(end, *collapse);
    }
    return Algebraic_number(kinetri::simplest_between(now(), end));
  }

  std::string take_step() {
    const std::vector<Point_id> ids = ids_of(*kinetic_);
    const double epoch = now().to_double();
    const std::size_t choice = any(8);
    if (ids.empty() || (choice == 0 && ids.size() < most_points)) {
      kinetic_->insert(any_motion(epoch));
      return "insert";
    }
    const Point_id some = ids[any(ids.size())];
    switch (choice) {
      case 1:
        kinetic_->erase(some);
        return "erase";
      case 2:
        kinetic_->set_motion(some, any(4) > 0 ? any_motion(epoch) : kinetic_->motion(ids[0]));
        return "set a motion";
      case 3: {
        std::vector<Motion> motions;
        for (std::size_t k = 0; k < ids.size(); ++k) motions.push_back(any_motion(epoch));
        kinetic_->set_motions(ids, motions);
        return "set all motions";
      }
      case 4: {
        std::vector<Vector_2> places;
        for (const Point_id id : ids) {
          const Vector_2 by = any(2) == 0 ? vector(1) : Vector_2();
          const Vector_2 place = kinetri::rounded_place(kinetic_->motion(id), epoch);
          places.push_back({place.x + by.x / 8, place.y + by.y / 8});
        }
        kinetic_->set_positions(places);
        return "set positions";
      }
      case 5:
        if (any(3) == 0) {
          kinetic_->reverse();
          return "reverse";
        }
        [[fallthrough]];
      case 6:
        kinetic_->advance_to(later());
        return "advance";
      default:
        kinetic_->step(later());
        return "one time of events";
    }
  }

  // What differs from a new triangulation of the same motions, or fails in an audit.
  std::string difference() {
    const kinetri::Audit_report report = kinetic_->audit(kinetri::Audit_level::certificates);
    if (!report.passed()) return report.failures.front();
    const Kinetic made(motions_of(*kinetic_), now(), kinetic_->traits());
    const std::vector<Point_id> ids = ids_of(*kinetic_);
    std::vector<Periodic_edge> edges;
    for (Periodic_edge edge : made.periodic_edges()) {
      edge.ids = {ids[edge.ids[0]], ids[edge.ids[1]]};
      edges.push_back(edge);
    }
    if (edges != kinetic_->periodic_edges()) return "other edges than those of a new one";
    for (Point_id k = 0; k < ids.size(); ++k) {
      if (kinetic_->is_hidden(ids[k]) != made.is_hidden(k)) return "other hidden points";
    }
    return "";
  }

  Fuzz_input& input_;
  const double scale_;
  const int range_;
  std::optional<Kinetic> kinetic_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr int steps = 10;
  Fuzz_input input(data, size);
  if (input.integer(0, 1) == 0) {
    Periodic_run<kinetri::Kinetic_delaunay_triangulation_2<kinetri::Periodic_kinetic_traits_2>>(
        input)
        .take_steps(steps);
  } else {
    Periodic_run<kinetri::Kinetic_regular_triangulation_2<kinetri::Periodic_disc_kinetic_traits_2>>(
        input)
        .take_steps(steps);
  }
  return 0;
}
