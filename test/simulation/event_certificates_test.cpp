// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate of each event, checked with Sturm sequences and roots of the general kind, and
// against who was beside whom, and since when, as all edges tell after each event.
#include "kinetri/simulation/event_certificates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "kinetri/kinetic/certificate_polynomials.h"
#include "kinetri/simulation/scenarios.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"
#include "support/failure_proofs.h"
#include "support/motions.h"

namespace kinetri::event_certificates_test {
namespace {

using Time = Algebraic_number;

// Certifies a simulation, and checks what it is given.
template <class Traits>
class Checked : Event_observer {
 public:
  using Simulation = Simulation_2<Traits>;
  using Triangulation = typename Simulation::Triangulation;
  using Point_2 = typename Traits::Point_2;

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
  std::size_t number_proved() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        given, [](const Event_certificate& c) { return c.failure.has_value(); }));
  }
  std::size_t number_without_failure(Event_kind kind) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        given, [&](const Event_certificate& c) { return c.kind == kind && !c.failure; }));
  }

  std::vector<Event_certificate> given;

 private:
  // The points of the triangles beside an edge, but its ends.
  using Beside = std::multiset<Point_id>;
  struct Since {
    Beside beside;
    Time time;
  };

  void before_event(const Event& event) override {
    number_ = event.number;
    points_.clear();
    for (Point_id id = 0; id < triangulation().next_id(); ++id) {
      if (triangulation().contains(id)) points_.emplace(id, triangulation().point(id));
    }
  }

  void after_event(const Event& event) override {
    ASSERT_FALSE(given.empty());
    const Event_certificate& c = given.back();
    ASSERT_EQ(c.event, event.number);
    ASSERT_EQ(number_, event.number);
    ASSERT_EQ(c.kind, event.kind);
    SCOPED_TRACE("event " + std::to_string(event.number) + ", " + std::string(name(event.kind)));
    check(c, event);
    look(event.time);
  }

  void check(const Event_certificate& c, const Event& event) {
    switch (event.kind) {
      case Event_kind::insert:
      case Event_kind::erase:
      case Event_kind::trajectory:
        EXPECT_EQ(c.points, std::vector<Point_id>{*event.point_a});
        EXPECT_FALSE(c.failure);
        break;
      default:
        break;
    }
    EXPECT_EQ(c.failure.has_value(), c.reason.empty());
    if (!c.failure) return;
    const auto at = [&](std::size_t i) -> const Point_2& { return points_.at(c.points[i]); };
    const auto have_motions_since = [&](Time since) {
      for (const Point_id id : c.points) {
        const auto motion = motions_.find(id);
        if (motion != motions_.end()) since = std::max(since, motion->second.second);
      }
      return since;
    };
    Polynomial p;
    Time since = start_;
    switch (event.kind) {
      case Event_kind::flip: {
        ASSERT_EQ(c.points.size(), 4u);
        EXPECT_EQ(edge_ids(c.points[0], c.points[1]), *event.removed);
        EXPECT_EQ(edge_ids(c.points[2], c.points[3]), *event.added);
        p = -perturbed_in_circle_polynomial(at(0), at(1), at(2), at(3));
        since = since_of(*event.removed, {c.points[2], c.points[3]});
        break;
      }
      case Event_kind::hull_insert:
        ASSERT_EQ(c.points.size(), 3u);
        EXPECT_EQ(edge_ids(c.points[0], c.points[1]), *event.removed);
        EXPECT_EQ(c.points[2], *event.apex);
        p = orientation_polynomial(at(0), at(1), at(2));
        since = since_of(*event.removed, {c.points[2], no_point});
        break;
      case Event_kind::hull_remove: {
        ASSERT_EQ(c.points.size(), 3u);
        std::set<Point_id> ends(c.points.begin(), c.points.end());
        ends.erase(*event.apex);
        EXPECT_EQ(ends, std::set<Point_id>(event.added->begin(), event.added->end()));
        p = orientation_polynomial(at(0), at(1), at(2));
        since = since_of({*event.apex, no_point}, Beside(ends.begin(), ends.end()));
        break;
      }
      case Event_kind::wall: {
        ASSERT_EQ(c.points, std::vector<Point_id>{*event.point_a});
        p = failing(walls(), at(0), event.time);
        break;
      }
      case Event_kind::collision:
        ASSERT_EQ(c.points, (std::vector<Point_id>{*event.point_a, *event.point_b}));
        p = contact_polynomial(at(0), at(1), 2 * simulation_.options().radius);
        break;
      default:
        // Hidden points: whoever is beside them, the proof itself is checked.
        p = c.points.size() == 4 ? -perturbed_in_circle_polynomial(at(0), at(1), at(2), at(3))
                                 : orientation_polynomial(at(0), at(1), at(2));
        since = Time(c.failure->from);
    }
    if (testing::Test::HasFatalFailure()) return;
    since = knows_since_ ? have_motions_since(since) : std::min(event.time, Time(c.failure->from));
    test::expect_proof(*c.failure, p, since, event.time);
  }

  std::vector<Wall_2> walls() const {
    const Simulation_options& options = simulation_.options();
    std::vector<Wall_2> result;
    for (Wall_2 wall : options.box->walls(options.rim_touches ? options.radius : 0)) {
      wall.rim_touches = HasWeight<typename Traits::Motion> && options.rim_touches;
      result.push_back(wall);
    }
    return result;
  }

  static Polynomial failing(const std::vector<Wall_2>& walls, const Point_2& p, const Time& time) {
    for (const Wall_2& wall : walls) {
      Polynomial inside = wall_polynomial(p, wall);
      if (sign_at(inside, time) == CGAL::ZERO && sign_just_after(inside, time) == CGAL::NEGATIVE) {
        return inside;
      }
    }
    ADD_FAILURE() << "the point is at no wall";
    return Polynomial{1};
  }

  Time since_of(const Edge_ids& edge, const Beside& beside) const {
    const auto known = edges_.find(edge);
    EXPECT_TRUE(!knows_since_ || (known != edges_.end() && known->second.beside == beside));
    return known == edges_.end() ? start_ : known->second.time;
  }

  // Notes which edges have other triangles beside them than before.
  void look(const Time& now) {
    std::map<Edge_ids, Since> edges;
    const auto& t = triangulation().triangulation();
    if (t.dimension() == 2) {
      for (const auto& [face, i] : t.all_edges()) {
        const auto id = [](const auto& v) { return v->point().id(); };
        const Edge_ids ids = edge_ids(id(face->vertex(t.cw(i))), id(face->vertex(t.ccw(i))));
        const Beside beside = {id(face->vertex(i)), id(t.mirror_vertex(face, i))};
        const auto before = edges_.find(ids);
        const bool is_same = before != edges_.end() && before->second.beside == beside;
        edges.emplace(ids, Since{beside, is_same ? before->second.time : now});
      }
    }
    edges_ = std::move(edges);
    for (Point_id id = 0; id < triangulation().next_id(); ++id) {
      if (!triangulation().contains(id)) {
        motions_.erase(id);
        continue;
      }
      const auto& motion = triangulation().motion(id);
      const auto known = motions_.find(id);
      if (known == motions_.end() || !(known->second.first == motion)) {
        motions_.insert_or_assign(id, std::pair(motion, now));
      }
    }
  }

  const Triangulation& triangulation() const { return simulation_.triangulation(); }

  Simulation& simulation_;
  bool knows_since_;  // whether what is beside an edge changes with the events alone
  Event_certificates<Traits> certificates_;
  Time start_;
  std::map<Edge_ids, Since> edges_;
  std::map<Point_id, std::pair<typename Traits::Motion, Time>> motions_;
  std::uint64_t number_ = 0;            // of the event that is about to happen
  std::map<Point_id, Point_2> points_;  // before it
};

TEST(Event_certificates, of_points_prove_each_flip_and_each_change_of_the_hull) {
  Simulation_2<> simulation(test::random_motions(40, 10, 5, 71), {});
  Checked<Linear_kinetic_traits_2> checked(simulation);
  simulation.advance_to(4);
  EXPECT_GT(checked.number_of(Event_kind::flip), 100u);
  EXPECT_GT(checked.number_of(Event_kind::hull_insert), 5u);
  EXPECT_GT(checked.number_of(Event_kind::hull_remove), 5u);
  EXPECT_EQ(checked.number_proved(), checked.given.size());
}

TEST(Event_certificates, of_discs_in_a_box_prove_each_contact) {
  const auto motions = test::discs_in_a_box(36, 1, 72);
  Simulation_options options = test::discs(test::box_of(36), 2, collide_elastically);
  options.rim_touches = true;
  Simulation_2<> simulation(motions, options);
  Checked<Linear_kinetic_traits_2> checked(simulation);
  simulation.advance_to(4);
  EXPECT_GT(checked.number_of(Event_kind::wall), 10u);
  EXPECT_GT(checked.number_of(Event_kind::collision), 10u);
  EXPECT_GT(checked.number_of(Event_kind::flip), 50u);
  EXPECT_EQ(checked.number_proved(), checked.given.size());
}

TEST(Event_certificates, of_points_that_come_turn_and_go_begin_with_that) {
  Simulation_2<> simulation(test::random_motions(30, 10, 3, 73), {});
  Checked<Linear_kinetic_traits_2> checked(simulation);
  for (int i = 0; i < 12; ++i) {
    const double now = 0.25 * (i + 1);
    simulation.advance_to(now);
    const auto id = static_cast<Point_id>(2 * i);
    switch (i % 3) {
      case 0: {
        Linear_motion_2 motion =
            with_velocity_at(simulation.triangulation().motion(id), {3.0 - i, i / 2.0}, now);
        simulation.set_motion(id, motion);
        break;
      }
      case 1:
        simulation.insert({{5.0 + i / 8.0, 5.0 - i / 4.0}, {1, -2}, now});
        break;
      default:
        simulation.erase(id);
    }
  }
  simulation.advance_to(4);
  EXPECT_EQ(checked.number_without_failure(Event_kind::insert), 4u);
  EXPECT_EQ(checked.number_without_failure(Event_kind::erase), 4u);
  EXPECT_EQ(checked.number_without_failure(Event_kind::trajectory), 4u);
  EXPECT_GT(checked.number_of(Event_kind::flip), 40u);
}

TEST(Event_certificates, of_discs_of_any_size_prove_when_they_hide_and_come_out) {
  std::vector<Disc_motion_2> motions;
  for (const Linear_motion_2& m : test::random_motions(24, 10, 3, 74)) {
    motions.push_back({m, 0.25 * static_cast<double>(motions.size() % 7)});
  }
  Simulation_2<Disc_kinetic_traits_2> simulation(motions, {});
  Checked<Disc_kinetic_traits_2> checked(simulation);
  simulation.advance_to(4);
  EXPECT_GT(checked.number_of(Event_kind::hide), 3u);
  EXPECT_GT(checked.number_of(Event_kind::reveal), 3u);
  EXPECT_GT(checked.number_of(Event_kind::flip), 40u);
}

// Point 0 leaves the hull through the vertex 1, and so reaches two sides of its triangle at one
// time. With all ids, and from snapshots, since a restored triangulation stores its faces
// otherwise.
TEST(Event_certificates, of_a_point_that_leaves_through_a_vertex_are_those_after_a_restoration) {
  using Kinetic = Kinetic_triangulation_2<Disc_kinetic_traits_2>;
  const auto disc = [](Vector_2 place, Vector_2 velocity, double radius) {
    return Disc_motion_2{{place, velocity, 0}, radius, 0, 0};
  };
  const std::array<Disc_motion_2, 5> discs = {disc({6, 4}, {0, 1}, 0), disc({6, 8}, {}, 3),
                                              disc({0, 0}, {}, 0), disc({12, 0}, {}, 0),
                                              disc({7, -1}, {}, 0)};
  std::array<Point_id, 5> ids = {0, 1, 2, 3, 4};
  do {
    SCOPED_TRACE(testing::PrintToString(ids));
    std::vector<Disc_motion_2> by_id(discs.size());
    for (std::size_t i = 0; i < discs.size(); ++i) by_id[ids[i]] = discs[i];
    Kinetic kinetic(by_id);
    kinetic.advance_to(Time(3.5));
    ASSERT_TRUE(kinetic.is_hidden(ids[0]));
    Kinetic restored = Kinetic::restore(kinetic.snapshot());
    std::vector<std::vector<Point_id>> points;
    for (Kinetic* const each : {&kinetic, &restored}) {
      Event_certificates<Disc_kinetic_traits_2> certificates(
          *each, {}, [&points](const Event_certificate& certificate) {
            if (certificate.kind == Event_kind::reveal) points.push_back(certificate.points);
          });
      each->add_observer(certificates);
      each->advance_to(Time(4));
      each->remove_observer(certificates);
    }
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0], points[1]);
    // The side with the least ids comes first: to point 2, beyond the hull, or to 4, where the
    // triangle with 3 is.
    EXPECT_EQ(std::ranges::count(points[0], ids[3]) > 0, ids[4] < ids[2]);
  } while (std::ranges::next_permutation(ids).found);
}

// Every other step a point gets the motion of another one; in the next one of the two turns.
template <class Traits>
void expect_proofs_of_points_that_coincide(std::vector<typename Traits::Motion> motions) {
  motions[17] = motions[16];  // from the start on
  Simulation_2<Traits> simulation(motions, {});
  const auto& triangulation = simulation.triangulation();
  Checked<Traits> checked(simulation);
  for (Point_id i = 0; i < 12; ++i) {
    const double now = 0.25 * (i + 1);
    simulation.advance_to(now);
    if (i % 2 == 0) {
      simulation.set_motion(i + 1, triangulation.motion(i));
      EXPECT_EQ(triangulation.vertex(i + 1), triangulation.vertex(i));
    } else {
      const Point_id id = i % 4 == 1 ? i - 1 : i;
      simulation.set_motion(id, with_velocity_at(triangulation.motion(id), {1, i / 4.0}, now));
      EXPECT_NE(triangulation.vertex(i - 1), triangulation.vertex(i));
    }
  }
  simulation.erase(16);
  simulation.advance_to(4);
  std::size_t coincidences = 0;
  for (const Event_certificate& c : checked.given) {
    if (c.reason != "two points coincide from now on, or until now: nothing fails") continue;
    EXPECT_EQ(c.points.size(), 2u);
    ++coincidences;
  }
  EXPECT_GE(coincidences, HasWeight<typename Traits::Motion> ? 6u : 13u);
  EXPECT_GT(checked.number_of(Event_kind::flip), 30u);
}

TEST(Event_certificates, of_points_that_coincide_say_so) {
  expect_proofs_of_points_that_coincide<Linear_kinetic_traits_2>(
      test::random_motions(24, 10, 3, 75));
  std::vector<Disc_motion_2> discs;
  for (const Linear_motion_2& m : test::random_motions(24, 10, 3, 76)) {
    discs.push_back({m, 0.25 * static_cast<double>(discs.size() % 5)});
  }
  expect_proofs_of_points_that_coincide<Disc_kinetic_traits_2>(discs);
}

// Points of a lattice with small integer velocities: many events at one time, between which points
// that meet are set aside. So only what each proof says by itself is checked.
TEST(Event_certificates, of_degenerate_points_prove_their_events) {
  std::mt19937_64 random(75);
  std::vector<Linear_motion_2> motions;
  for (int i = 0; i < 36; ++i) {
    const auto speed = [&] { return static_cast<double>(random() % 3) - 1; };
    const double x = speed();
    motions.push_back({{static_cast<double>(i % 6), static_cast<double>(i / 6)}, {x, speed()}, 0});
  }
  Simulation_2<> simulation(motions, {});
  Checked<Linear_kinetic_traits_2> checked(simulation, false);
  simulation.advance_to(6);
  EXPECT_GT(checked.number_of(Event_kind::flip), 80u);
  EXPECT_GT(checked.number_without_failure(Event_kind::rebuild), 5u);
}

// The circle is that of radius 5 about the origin. The fourth point comes from above, and is at
// 5 + (t - 1)^2 (3 - t): it touches the circle at 1, and enters it at 3.
TEST(Event_certificates, have_the_touches_before_a_failure) {
  std::vector<Polynomial_motion_2> motions(4);
  motions[0].position = {-3, 4};
  motions[1].position = {-3, -4};
  motions[2].position = {5, 0};
  motions[3] = {{0, 8}, {0, -7}, {0, 10}, {0, -6}, 0};
  Simulation_2<Polynomial_kinetic_traits_2> simulation(motions, {});
  Checked<Polynomial_kinetic_traits_2> checked(simulation);
  simulation.advance_to(3);
  ASSERT_EQ(checked.given.size(), 1u);
  ASSERT_TRUE(checked.given[0].failure);
  const Failure_certificate& proof = *checked.given[0].failure;
  EXPECT_EQ(proof.lower, 3);
  EXPECT_EQ(proof.upper, 3);
  ASSERT_EQ(proof.touches.size(), 1u);
  EXPECT_TRUE(proof.touches[0].lower <= 1 && proof.touches[0].upper >= 1);
}

TEST(Event_certificates, tell_the_numbers_of_a_known_failure) {
  // The fourth point falls onto the circle of radius 5 through the others, which it meets at 2.
  Simulation_2<> simulation(
      {{{-3, 4}, {0, 0}, 0}, {{-3, -4}, {0, 0}, 0}, {{5, 0}, {0, 0}, 0}, {{0, 7}, {0, -1}, 0}}, {});
  Checked<Linear_kinetic_traits_2> checked(simulation);
  simulation.advance_to(2);
  ASSERT_EQ(checked.given.size(), 1u);
  const Event_certificate& c = checked.given[0];
  EXPECT_EQ(c.kind, Event_kind::flip);
  EXPECT_EQ(c.points, (std::vector<Point_id>{0, 2, 3, 1}));
  ASSERT_TRUE(c.failure);
  EXPECT_EQ(c.failure->lower, 2);
  EXPECT_EQ(c.failure->upper, 2);
  EXPECT_EQ(c.failure->multiplicity, 1);
  EXPECT_TRUE(c.failure->touches.empty());
}

TEST(Event_certificates, say_why_nothing_fails) {
  Simulation_2<> simulation(
      {{{-3, 4}, {0, 0}, 0}, {{-3, -4}, {0, 0}, 0}, {{5, 0}, {0, 0}, 0}, {{0, 7}, {0, 0}, 0}}, {});
  Checked<Linear_kinetic_traits_2> checked(simulation);
  simulation.advance_to(1);
  simulation.set_motion(3, {{0, 7}, {0, -1}, 1});
  simulation.erase(1);
  ASSERT_EQ(checked.given.front().kind, Event_kind::trajectory);
  EXPECT_EQ(checked.given.front().points, std::vector<Point_id>{3});
  EXPECT_EQ(checked.given.front().reason, "a point gets another motion: nothing fails");
  ASSERT_EQ(checked.given[1].kind, Event_kind::erase);
  EXPECT_EQ(checked.given[1].points, std::vector<Point_id>{1});
  EXPECT_EQ(checked.given[1].reason, "a point is erased: nothing fails");
  for (std::size_t i = 0; i < checked.given.size(); ++i) {
    EXPECT_EQ(checked.given[i].event, i + checked.given[0].event);
  }
}

}  // namespace
}  // namespace kinetri::event_certificates_test
