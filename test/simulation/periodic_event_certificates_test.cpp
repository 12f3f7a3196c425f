// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate of each event in a periodic box, checked with determinants that are expanded in
// another way, and against who was beside whom, and since when, as all faces tell after each event.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/simulation/event_certificates.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/failure_proofs.h"
#include "support/images.h"
#include "support/motions.h"

namespace kinetri::periodic_event_certificates_test {
namespace {

using Time = Algebraic_number;
using Points = Periodic_kinetic_traits_2;
using Discs = Periodic_disc_kinetic_traits_2;

/// Certifies a simulation, and checks what it is given.
template <class Traits>
class Checked : Event_observer {
 public:
  using Simulation = Simulation_2<Traits>;
  using Motion = typename Traits::Motion;

  /// `knows_since` says whether what is beside an edge changes with the events alone.
  explicit Checked(Simulation& simulation, bool knows_since = true)
      : simulation_(simulation),
        knows_since_(knows_since),
        certificates_(simulation.triangulation(), simulation.options(),
                      [this](const Event_certificate& c) { given.push_back(c); }),
        start_(simulation.current_time()) {
    simulation.add_observer(certificates_);
    simulation.add_observer(*this);
    look(start_);
  }
  Checked(const Checked&) = delete;
  Checked& operator=(const Checked&) = delete;
  ~Checked() override {
    simulation_.remove_observer(*this);
    simulation_.remove_observer(certificates_);
  }

  std::size_t number_of(Event_kind kind) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        given, [&](const Event_certificate& c) { return c.kind == kind && c.failure; }));
  }
  std::size_t number_with_offsets() const {
    return static_cast<std::size_t>(std::ranges::count_if(given, [](const Event_certificate& c) {
      return std::ranges::any_of(
          c.offsets, [](const Lattice_offset_2& offset) { return offset != Lattice_offset_2(); });
    }));
  }
  std::size_t number_proved() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        given, [](const Event_certificate& c) { return c.failure.has_value(); }));
  }

  std::vector<Event_certificate> given;

 private:
  // The corners opposite an edge, as its first end sees them.
  using Beside = std::multiset<Periodic_image>;
  struct Since {
    Beside beside;
    Time time;
  };

  const auto& triangulation() const { return simulation_.triangulation(); }

  void before_event(const Event& /*event*/) override {
    before_.clear();
    for (Point_id id = 0; id < triangulation().next_id(); ++id) {
      if (triangulation().contains(id)) before_.emplace(id, triangulation().motion(id));
    }
  }

  void after_event(const Event& event) override {
    ASSERT_FALSE(given.empty());
    const Event_certificate& c = given.back();
    ASSERT_EQ(c.event, event.number);
    ASSERT_EQ(c.kind, event.kind);
    SCOPED_TRACE("event " + std::to_string(event.number) + ", " + std::string(name(event.kind)));
    EXPECT_EQ(c.failure.has_value(), c.reason.empty());
    if (c.failure) {
      check(c, event);
    } else {
      EXPECT_TRUE(c.offsets.empty());
      EXPECT_NE(event.kind == Event_kind::flip && knows_since_, true);
    }
    look(event.time);
  }

  void check(const Event_certificate& c, const Event& event) {
    ASSERT_EQ(c.offsets.size(), c.points.size());
    const auto image = [&](std::size_t i) {
      const Motion& motion = before_.at(c.points[i]);
      using Image = Basic_moving_point_2<Image_motion_of<Motion>>;
      return Image(image_of(motion, c.offsets[i], &triangulation().traits().box()), c.points[i]);
    };
    const auto edge = [&](std::size_t i, std::size_t k) {
      return periodic_edge(c.points[i], c.points[k], offset_between(c.offsets[i], c.offsets[k]));
    };
    Polynomial p;
    Time since = start_;
    if (event.kind == Event_kind::collision) {
      ASSERT_EQ(c.points.size(), 2u);
      EXPECT_EQ(edge(0, 1), periodic_edge(*event.point_a, *event.point_b, event.added_offset));
      p = contact_polynomial(image(0), image(1), 2 * simulation_.options().radius);
    } else {
      ASSERT_EQ(c.points.size(), 4u);
      p = -perturbed_in_circle_polynomial(image(0), image(1), image(2), image(3));
      if constexpr (!HasWeight<Motion>) {
        EXPECT_EQ(
            primitive_part(p),
            primitive_part(-test::perturbed_determinant(std::array{
                image(0).motion(), image(1).motion(), image(2).motion(), image(3).motion()})));
      }
      since = Time(c.failure->from);
    }
    if (event.kind == Event_kind::flip) {
      const Periodic_edge removed = {*event.removed, event.removed_offset};
      EXPECT_EQ(edge(0, 1), removed);
      EXPECT_EQ(edge(2, 3), (Periodic_edge{*event.added, event.added_offset}));
      EXPECT_EQ(c.offsets[0], Lattice_offset_2());
      if (knows_since_) {
        const auto known = edges_.find(removed);
        ASSERT_NE(known, edges_.end());
        const Beside beside = {{c.points[2], c.offsets[2]}, {c.points[3], c.offsets[3]}};
        EXPECT_EQ(known->second.beside, beside);
        since = known->second.time;
      }
    }
    if (testing::Test::HasFatalFailure()) return;
    for (const Point_id id : c.points) since = std::max(since, motions_.at(id).second);
    if (!knows_since_) since = std::min(event.time, Time(c.failure->from));
    test::expect_proof(*c.failure, p, since, event.time);
  }

  // Notes which edges have other faces beside them than before.
  void look(const Time& now) {
    std::map<Periodic_edge, Since> edges;
    for (const auto face : triangulation().triangulation().finite_face_handles()) {
      for (int i = 0; i < 3; ++i) {
        const int k = (i + 1) % 3;
        const int apex = (i + 2) % 3;
        const auto id = [&](int corner) { return face->vertex(corner)->point().id(); };
        const Lattice_offset_2 offset = offset_between(face->offset(i), face->offset(k));
        const Periodic_edge edge = periodic_edge(id(i), id(k), offset);
        const bool is_directed = edge.ids == Edge_ids{id(i), id(k)} && edge.offset == offset;
        const int first = is_directed ? i : k;
        edges[edge].beside.insert(
            {id(apex), offset_between(face->offset(first), face->offset(apex))});
      }
    }
    for (auto& [edge, since] : edges) {
      const auto before = edges_.find(edge);
      const bool is_same = before != edges_.end() && before->second.beside == since.beside;
      since.time = is_same ? before->second.time : now;
    }
    edges_ = std::move(edges);
    for (Point_id id = 0; id < triangulation().next_id(); ++id) {
      if (!triangulation().contains(id)) continue;
      const auto known = motions_.find(id);
      if (known == motions_.end() || !(known->second.first == triangulation().motion(id))) {
        motions_.insert_or_assign(id, std::pair(triangulation().motion(id), now));
      }
    }
  }

  Simulation& simulation_;
  bool knows_since_;
  Event_certificates<Traits> certificates_;
  Time start_;
  std::map<Periodic_edge, Since> edges_;
  std::map<Point_id, std::pair<Motion, Time>> motions_;
  std::map<Point_id, Motion> before_;  // the event
};

// At rest, sheared, growing, turning.
std::vector<Periodic_box_2> boxes(double side) {
  return {{{{side, 0}, {0, 0}, 0}, {{0, side}, {0, 0}, 0}},
          {{{side, 0}, {0, 0}, 0}, {{side / 4, side}, {side / 2, 0}, 0}},
          {{{side, 0}, {side / 8, 0}, 0}, {{0, side}, {0, side / 4}, 0}},
          {{{side, 1}, {0.5, -1}, 0}, {{-1, side}, {0.75, 0.25}, 1}}};
}

TEST(Periodic_event_certificates, of_points_prove_each_flip) {
  std::size_t with_offsets = 0;
  for (const std::size_t n : {1U, 2U, 3U, 30U}) {
    for (const Periodic_box_2& box : boxes(10)) {
      SCOPED_TRACE(std::to_string(n) + " points");
      Simulation_2<Points> simulation(test::random_motions(n, 10, 3, 71), {}, 0, Points(box));
      Checked<Points> checked(simulation);
      simulation.advance_to(n < 4 ? 8 : 3);
      if (n > 1) {
        EXPECT_GT(checked.number_of(Event_kind::flip), n > 3 ? 80U : 1U);
      }
      EXPECT_EQ(checked.number_proved(), checked.given.size());
      with_offsets += checked.number_with_offsets();
    }
  }
  EXPECT_GT(with_offsets, 150U);
}

TEST(Periodic_event_certificates, of_points_that_come_turn_and_go_begin_with_that) {
  for (const Periodic_box_2& box : boxes(10)) {
    Simulation_2<Points> simulation(test::random_motions(24, 10, 3, 73), {}, 0, Points(box));
    Checked<Points> checked(simulation);
    for (unsigned i = 0; i < 12; ++i) {
      const double now = 0.25 * (i + 1);
      simulation.advance_to(now);
      const Point_id id = 2 * i;
      Linear_motion_2 motion = simulation.triangulation().motion(id);
      switch (i % 4) {
        case 0:
          simulation.set_motion(id, with_velocity_at(motion, {3.0 - i, i / 2.0}, now));
          break;
        case 1:
          simulation.insert({{5.0 + i / 8.0, 5.0 - i / 4.0}, {1, -2}, now});
          break;
        case 2:
          simulation.erase(id);
          break;
        default: {
          // To another image of itself: edges have other names from then on.
          const Linear_motion_2 a = with_velocity_at(box.first(), box.first().velocity, 0);
          const Linear_motion_2 there = with_velocity_at(motion, motion.velocity, 0);
          simulation.set_motion(id,
                                {{there.position.x + a.position.x, there.position.y + a.position.y},
                                 {there.velocity.x + a.velocity.x, there.velocity.y + a.velocity.y},
                                 0});
        }
      }
    }
    simulation.advance_to(4);
    EXPECT_GT(checked.number_of(Event_kind::flip), 60U);
  }
}

TEST(Periodic_event_certificates, of_discs_of_any_size_prove_when_they_hide_and_come_out) {
  std::size_t hidden = 0;
  std::size_t revealed = 0;
  for (const Periodic_box_2& box : boxes(12)) {
    std::vector<Disc_motion_2> motions;
    for (const Linear_motion_2& m : test::random_motions(24, 12, 3, 74)) {
      const double radius = 0.375 * static_cast<double>(motions.size() % 7);
      motions.push_back({m, radius, radius > 0 ? 0.125 : 0, 0});
    }
    Simulation_2<Discs> simulation(motions, {}, 0, Discs(box));
    Checked<Discs> checked(simulation);
    simulation.advance_to(3);
    hidden += checked.number_of(Event_kind::hide);
    revealed += checked.number_of(Event_kind::reveal);
    EXPECT_GT(checked.number_of(Event_kind::flip), 40U);
    // When a disc comes out or is hidden, edges come and go with it.
    const auto rebuilt =
        std::ranges::count(checked.given, Event_kind::rebuild, &Event_certificate::kind);
    EXPECT_EQ(checked.number_proved() + static_cast<std::size_t>(rebuilt), checked.given.size());
  }
  EXPECT_GT(hidden, 20U);
  EXPECT_GT(revealed, 20U);
}

TEST(Periodic_event_certificates, of_discs_prove_each_contact) {
  for (const Periodic_box_2& box : boxes(12)) {
    Simulation_options options;
    options.response = collide_elastically;
    options.radius = 0.5;
    Simulation_2<Points> simulation(test::random_motions(16, 12, 3, 75), options, 0, Points(box));
    Checked<Points> checked(simulation);
    simulation.advance_to(3);
    EXPECT_GT(checked.number_of(Event_kind::collision), 5U);
    EXPECT_GT(checked.number_of(Event_kind::flip), 20U);

    std::vector<Disc_motion_2> discs;
    for (const Linear_motion_2& m : test::random_motions(16, 12, 3, 76)) {
      discs.push_back({m, 0.125 * static_cast<double>(discs.size() % 7), 0, 0});
    }
    options.radius = 0;
    Simulation_2<Discs> of_discs(discs, options, 0, Discs(box));
    Checked<Discs> checked_discs(of_discs);
    of_discs.advance_to(3);
    EXPECT_GT(checked_discs.number_of(Event_kind::collision), 5U);
  }
}

// Points of a lattice with small integer velocities: many events at one time, and images that meet.
// So only what each proof says by itself is checked.
TEST(Periodic_event_certificates, of_degenerate_points_prove_their_events) {
  std::size_t rebuilt = 0;
  for (const Periodic_box_2& box : boxes(4)) {
    std::mt19937_64 random(75);
    std::vector<Linear_motion_2> motions;
    for (int i = 0; i < 16; ++i) {
      const auto speed = [&] { return static_cast<double>(random() % 3) - 1; };
      const double x = speed();
      motions.push_back(
          {{static_cast<double>(i % 4), static_cast<double>(i / 4)}, {x, speed()}, 0});
    }
    Simulation_2<Points> simulation(motions, {}, 0, Points(box));
    Checked<Points> checked(simulation, false);
    simulation.advance_to(3);
    EXPECT_GT(checked.number_of(Event_kind::flip), 20U);
    rebuilt += static_cast<std::size_t>(
        std::ranges::count(checked.given, Event_kind::rebuild, &Event_certificate::kind));
  }
  EXPECT_GT(rebuilt, 5U);
}

}  // namespace
}  // namespace kinetri::periodic_event_certificates_test
