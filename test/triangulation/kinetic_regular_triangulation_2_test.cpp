// SPDX-License-Identifier: GPL-3.0-or-later
//
// The kinetic regular triangulation against CGAL's static one, event by event.
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "support/kinetic_runs.h"
#include "support/multiplier.h"

namespace kinetri::kinetic_regular_triangulation_2_test {
namespace {

using test::cases;

using Kinetic = Kinetic_regular_triangulation_2<>;

Disc_motion_2 disc(double x, double y, double vx, double vy, double radius, double growth = 0,
                   double weight = 0) {
  return {{{x, y}, {vx, vy}, 0}, radius, growth, weight};
}

std::string text(const std::vector<Disc_motion_2>& discs) {
  std::ostringstream out;
  out.precision(17);
  for (const Disc_motion_2& d : discs) {
    out << "disc(" << d.position.x << ", " << d.position.y << ", " << d.velocity.x << ", "
        << d.velocity.y << ", " << d.radius << ", " << d.growth << ", " << d.weight << "),\n";
  }
  return out.str();
}

// Audits after each event up to `until`; at most `most` instants.
template <class Triangulation>
void run_audited(Triangulation& kinetic, double until, int most, Audit_level level) {
  const auto start = kinetic.audit(level);
  ASSERT_TRUE(start.passed()) << "at the start: " << start.failures.front();
  for (int i = 0; i < most && kinetic.step(Algebraic_number(until)) > 0; ++i) {
    const auto report = kinetic.audit(level);
    ASSERT_TRUE(report.passed()) << "after instant " << i << " at "
                                 << kinetic.current_time().to_double() << ": "
                                 << report.failures.front();
  }
}

// Random discs in a square of side 10; on a lattice if `step` is not zero.
std::vector<Disc_motion_2> random_discs(std::mt19937_64& random, std::size_t points, double step,
                                        double largest_radius, double largest_growth,
                                        double largest_weight) {
  const auto number = [&](double from, double to) {
    const double x = from + (to - from) * static_cast<double>(random() >> 11U) * 0x1p-53;
    return step == 0 ? x : std::round(x / step) * step;
  };
  std::vector<Disc_motion_2> discs;
  while (discs.size() < points) {
    const Disc_motion_2 d =
        disc(number(0, 10), number(0, 10), number(-1, 1), number(-1, 1), number(0, largest_radius),
             number(-largest_growth, largest_growth), number(-largest_weight, largest_weight));
    const auto is_alike = [&](const Disc_motion_2& other) { return same_trajectory(d, other); };
    if (std::ranges::none_of(discs, is_alike)) discs.push_back(d);
  }
  return discs;
}

TEST(Kinetic_regular_triangulation, of_random_discs_is_that_of_CGAL_after_each_event) {
  std::mt19937_64 random(1);
  std::uint64_t hidden_events = 0;
  for (int run = 0; run < cases(15); ++run) {
    const auto discs = random_discs(random, 30, 0, 2.5, 0.2, 0);
    SCOPED_TRACE("run " + std::to_string(run));
    Kinetic kinetic(discs);
    run_audited(kinetic, 4, 60, Audit_level::certificates);
    if (HasFatalFailure()) return;
    hidden_events += kinetic.counters().events[static_cast<std::size_t>(Event_kind::hide)] +
                     kinetic.counters().events[static_cast<std::size_t>(Event_kind::reveal)];
    EXPECT_EQ(kinetic.counters().reconstructions, 0u);
  }
  EXPECT_GT(hidden_events, 100u);
}

TEST(Kinetic_regular_triangulation, of_few_points_with_any_weights_is_that_of_CGAL) {
  std::mt19937_64 random(2);
  for (int run = 0; run < cases(50); ++run) {
    const auto discs = random_discs(random, static_cast<std::size_t>(1 + run % 9), 0, 3, 1, 4);
    SCOPED_TRACE("run " + std::to_string(run) + "\n" + text(discs));
    Kinetic kinetic(discs);
    run_audited(kinetic, 10, 100, Audit_level::certificates);
    if (HasFatalFailure()) return;
  }
}

TEST(Kinetic_regular_triangulation, of_discs_on_a_lattice_is_that_of_CGAL) {
  std::mt19937_64 random(3);
  for (int run = 0; run < cases(80); ++run) {
    const double step = run % 2 == 0 ? 1 : 2;
    const auto discs = random_discs(random, static_cast<std::size_t>(1 + run % 9), step, 4, 1, 4);
    SCOPED_TRACE("run " + std::to_string(run) + "\n" + text(discs));
    Kinetic kinetic(discs);
    run_audited(kinetic, 10, 100, Audit_level::certificates);
    if (HasFatalFailure()) return;
  }
}

// Centers that accelerate, and some that do not.
TEST(Kinetic_regular_triangulation, of_accelerated_discs_is_that_of_CGAL) {
  std::mt19937_64 random(7);
  for (int run = 0; run < cases(8); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const auto straight =
        random_discs(random, static_cast<std::size_t>(3 + run % 8), run % 2, 3, 1, 2);
    std::vector<Polynomial_disc_motion_2> discs;
    for (const Disc_motion_2& d : straight) {
      Polynomial_disc_motion_2& accelerated = discs.emplace_back(polynomial_motion(d));
      if (random() % 2 == 0) accelerated.acceleration = {static_cast<double>(random() % 3) - 1, 1};
      if (random() % 4 == 0) accelerated.jerk = {1, static_cast<double>(random() % 3) - 1};
    }
    Kinetic_regular_triangulation_2<Polynomial_disc_kinetic_traits_2> kinetic(discs);
    run_audited(kinetic, 5, 60, Audit_level::certificates);
    if (HasFatalFailure()) return;
  }
}

// The disc that grows for ever hides the one in its place for ever.
TEST(Kinetic_regular_triangulation, of_a_disc_that_grows_for_ever_comes_to_an_end_of_its_events) {
  Kinetic kinetic(std::vector<Disc_motion_2>{disc(2, 2, 0, 0, 1, -1), disc(0, 0, 0, 0, 3, 1),
                                             disc(0, 0, 0, 0, 1), disc(0, 1, 0, 0, 1)});
  EXPECT_TRUE(kinetic.is_hidden(2));
  while (kinetic.step() > 0) {
  }
  EXPECT_FALSE(kinetic.next_event_time());
  EXPECT_TRUE(kinetic.is_hidden(2));
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
}

TEST(Kinetic_regular_triangulation, of_any_discs_comes_to_an_end_of_its_events) {
  std::mt19937_64 random(8);
  for (int run = 0; run < cases(100); ++run) {
    const auto discs =
        random_discs(random, static_cast<std::size_t>(2 + run % 6), run % 3, 3, 1, 3);
    SCOPED_TRACE("run " + std::to_string(run) + "\n" + text(discs));
    Kinetic kinetic(discs);
    while (kinetic.step() > 0 || kinetic.next_event_time()) {
    }
    EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  }
}

// ---- equal weights ----

std::vector<Disc_motion_2> discs_of(const std::vector<Linear_motion_2>& motions, double radius) {
  std::vector<Disc_motion_2> result;
  for (const Linear_motion_2& motion : motions) result.push_back({motion, radius, 0, 0});
  return result;
}

// The Delaunay triangulation and the regular one of discs of one size, changed in the same way.
TEST(Kinetic_regular_triangulation, of_equal_discs_has_the_events_of_the_Delaunay_triangulation) {
  std::mt19937_64 random(4);
  for (int run = 0; run < cases(20); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    // Mostly degenerate: points on a lattice, which meet.
    const auto motions = run % 4 == 0 ? test::random_motions(40, 6, 1, static_cast<unsigned>(run))
                                      : test::grid_motions(static_cast<std::size_t>(5 + run % 40),
                                                           6, 2, static_cast<unsigned>(run));
    test::Kinetic_delaunay delaunay(motions);
    Kinetic regular(discs_of(motions, 0.25));
    ASSERT_EQ(regular.finite_edge_ids(), delaunay.finite_edge_ids());
    test::Event_recorder expected(delaunay);
    test::Event_recorder events(regular);
    for (int time = 1; time <= 3; ++time) {
      delaunay.advance_to(Algebraic_number(time));
      regular.advance_to(Algebraic_number(time));
      const auto id = static_cast<Point_id>(random() % motions.size());
      const Linear_motion_2 motion = {
          {static_cast<double>(random() % 7) + 0.5, static_cast<double>(random() % 7)},
          {1, 0.5},
          0};
      delaunay.set_motion(id, motion);
      regular.set_motion(id, {motion, 0.25, 0, 0});
      delaunay.reverse();
      regular.reverse();
      delaunay.reverse();
      regular.reverse();
    }
    EXPECT_EQ(test::difference(events.events, expected.events), "");
    EXPECT_EQ(regular.number_of_hidden_points(), delaunay.number_of_hidden_points());
  }
}

// ---- changes ----

// The edges and the hidden points, from the events alone.
class State_recorder : public Event_observer {
 public:
  explicit State_recorder(Kinetic& kinetic) : edges(test::edges_of(kinetic)) {
    for (Point_id id = 0; id < kinetic.next_id(); ++id) {
      if (kinetic.contains(id) && kinetic.is_hidden(id)) hidden.insert(id);
    }
    kinetic.add_observer(*this);
  }

  void after_event(const Event& event) override {
    if (event.removed && edges.erase(*event.removed) == 0) problem = "removes what is not there";
    if (event.added && !edges.insert(*event.added).second) problem = "adds what is there";
    if (event.kind == Event_kind::hide && !hidden.insert(*event.point_a).second) {
      problem = "hides what is hidden";
    }
    if (event.kind == Event_kind::reveal && hidden.erase(*event.point_a) == 0) {
      problem = "reveals what is not hidden";
    }
    if (event.kind == Event_kind::erase) hidden.erase(*event.point_a);
  }

  std::set<Edge_ids> edges;
  std::set<Point_id> hidden;
  std::string problem;
};

std::set<Point_id> hidden_points(const Kinetic& kinetic) {
  std::set<Point_id> result;
  for (Point_id id = 0; id < kinetic.next_id(); ++id) {
    if (kinetic.contains(id) && kinetic.is_hidden(id)) result.insert(id);
  }
  return result;
}

class Changing_discs {
 public:
  Changing_discs(std::uint64_t seed, double step)
      : random_(seed),
        step_(step),
        kinetic_(random_discs(random_, random_() % 8, step, 4, 1, 4), {}, {},
                 Coincident_points::refuse),
        recorder_(kinetic_) {}

  std::string problem(int operations) {
    for (int i = 0; i < operations; ++i) {
      const std::string text = operate();
      std::string found = test::audit_problem(kinetic_, Audit_level::certificates);
      if (found.empty()) found = recorder_.problem;
      if (found.empty() && recorder_.edges != test::edges_of(kinetic_)) {
        found = "the events do not account for the edges";
      }
      if (found.empty() && recorder_.hidden != hidden_points(kinetic_)) {
        found = "the events do not account for the hidden points";
      }
      if (!found.empty()) return "operation " + std::to_string(i) + ", " + text + ": " + found;
    }
    return {};
  }

 private:
  Disc_motion_2 random_disc() {
    Disc_motion_2 result = random_discs(random_, 1, step_, 4, 1, 4).front();
    result.epoch = static_cast<double>(random_() % 3);
    return result;
  }

  std::vector<Point_id> ids() const {
    std::vector<Point_id> result;
    for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
      if (kinetic_.contains(id)) result.push_back(id);
    }
    return result;
  }

  std::string operate() {
    const auto all = ids();
    const auto one = [&] { return all[random_() % all.size()]; };
    try {
      switch (random_() % 10) {
        case 0:
          if (all.size() > 14) return "nothing";
          kinetic_.insert(random_disc());
          return "insert";
        case 1:
          if (all.size() > 14) return "nothing";
          kinetic_.insert(std::vector<Disc_motion_2>{random_disc(), random_disc()});
          return "insert two";
        case 2:
          if (all.empty()) return "nothing";
          kinetic_.erase(one());
          return "erase";
        case 3:
          if (all.empty()) return "nothing";
          kinetic_.set_motion(one(), random_disc());
          if (const std::array<Point_id, 2> two = {one(), one()}; two[0] != two[1]) {
            const std::array<Disc_motion_2, 2> motions = {random_disc(), random_disc()};
            kinetic_.set_motions(two, motions);
          }
          return "jump";
        case 4: {  // another velocity, and growth, from where it is
          if (all.empty()) return "nothing";
          const Point_id id = one();
          Disc_motion_2 motion = with_velocity_at(kinetic_.motion(id), random_disc().velocity,
                                                  kinetic_.current_time().to_double());
          motion.growth = random_disc().growth;
          kinetic_.set_motion(id, motion);
          return "turn";
        }
        case 5: {  // another radius alone
          if (all.empty()) return "nothing";
          const Point_id id = one();
          Disc_motion_2 motion = kinetic_.motion(id);
          motion.radius = random_disc().radius;
          kinetic_.set_motion(id, motion);
          return "another radius";
        }
        case 6: {
          std::vector<Disc_motion_2> motions;
          for (std::size_t i = 0; i < all.size(); ++i) {
            motions.push_back(with_velocity_at(kinetic_.motion(all[i]), random_disc().velocity,
                                               kinetic_.current_time().to_double()));
          }
          kinetic_.set_motions(all, motions);
          return "turn all";
        }
        case 7:
          kinetic_.reverse();
          return "reverse";
        default:
          kinetic_.step(Algebraic_number(kinetic_.current_time().to_double() + 1));
          return "step";
      }
    } catch (const Coincident_trajectories_error&) {
      return "refused";
    }
  }

  std::mt19937_64 random_;
  double step_;
  Kinetic kinetic_;
  State_recorder recorder_;
};

TEST(Kinetic_regular_triangulation, stays_that_of_CGAL_through_changes_of_all_kinds) {
  for (int run = 0; run < cases(8); ++run) {
    SCOPED_TRACE("seed " + std::to_string(run));
    ASSERT_EQ(Changing_discs(static_cast<std::uint64_t>(run), run % 2).problem(60), "");
  }
}

// At t = 0 the corners 5, 0 and 6 of a triangle are, lifted, on one line. The triangle turns over,
// and the certificates of its edges touch zero: none of them changes its sign.
TEST(Kinetic_regular_triangulation, sees_a_triangle_turn_over_where_its_certificates_touch) {
  const std::vector<Disc_motion_2> discs = {
      disc(1, 1, -1, 2, 0),  disc(2, 2, -2, -1, 0), disc(0, 0, 0, 1, 0, 0, 2), disc(2, 0, -2, 1, 0),
      disc(1, 2, -1, -1, 0), disc(0, 1, 0, 0, 0),   disc(2, 1, -2, 0, 0, 0, 2)};
  Kinetic kinetic(discs, Algebraic_number(Rational(-7, 2)));
  kinetic.advance_to(Algebraic_number(Rational(-1, 1000)));
  EXPECT_EQ(hidden_points(kinetic), std::set<Point_id>());
  kinetic.advance_to(0.0);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  EXPECT_EQ(hidden_points(kinetic), std::set<Point_id>{0});
  EXPECT_EQ(kinetic.finite_edge_ids(), Kinetic(discs, Algebraic_number(0.0)).finite_edge_ids());
}

// ---- snapshots ----

TEST(Kinetic_regular_triangulation, hides_a_point_in_the_place_of_one_of_two_that_jump) {
  const std::vector<Disc_motion_2> discs = {disc(1, 1, 0, 1, 0), disc(0, 1, -1, 1, 1),
                                            disc(0, 0, -1, -1, 0), disc(1, 1, 1, -1, 1),
                                            disc(1, 0, -1, 0, 2)};
  Kinetic kinetic(discs.begin(), discs.end());
  // The last one comes to the place of point 1, and is heavier.
  const std::array<Point_id, 2> ids = {3, 4};
  const std::array<Disc_motion_2, 2> motions = {disc(1, 1, -1, 0, 1), disc(0, 1, -1, 1, 2)};
  kinetic.set_motions(ids, motions);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  EXPECT_TRUE(kinetic.is_hidden(1));
}

// CGAL, when it removes a vertex, inserts hidden points anew: none may be like a vertex.
TEST(Kinetic_regular_triangulation, gives_a_hidden_point_the_motion_of_one_that_jumps) {
  Kinetic kinetic(std::vector<Disc_motion_2>{disc(2, 0, -1, 1, 0), disc(1, 1, 1, -1, 0),
                                             disc(2, 2, 0, 0, 0), disc(0, 0, -1, 0, 0),
                                             disc(2, 0, -1, 1, 1), disc(1, 0, 0, 0, 0)});
  ASSERT_TRUE(kinetic.is_hidden(0));
  const std::array<Point_id, 3> ids = {0, 1, 2};
  kinetic.set_motions(ids, std::array<Disc_motion_2, 3>{disc(2, 2, 0, 0, 0), disc(4, 9, 0, 0, 0),
                                                        disc(1, 1, 1, -1, 0)});
  EXPECT_FALSE(kinetic.is_hidden(0));
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
}

// One weight that all have becomes another while points jump, one after the other: then some would
// hide others.
TEST(Kinetic_regular_triangulation, takes_another_weight_of_all_while_points_jump) {
  for (unsigned seed = 0; seed < cases(100u); ++seed) {
    std::mt19937 random(seed);
    const auto number = [&](unsigned most) { return static_cast<double>(random() % (most + 1)); };
    std::vector<Disc_motion_2> before;
    std::vector<Disc_motion_2> after;
    std::vector<Point_id> ids;
    const double radius = number(3);
    for (Point_id id = 0; id < 3 + seed % 6; ++id) {
      const auto any_disc = [&](double r) {
        const double x = number(5);
        const double y = number(5);
        const double vx = number(2) - 1;
        return disc(x, y, vx, number(2) - 1, r);
      };
      ids.push_back(id);
      before.push_back(any_disc(0));
      after.push_back(any_disc(radius));
      if (number(2) > 0) after.back().position = before.back().position;
    }
    Kinetic kinetic(before);
    kinetic.set_motions(ids, after);
    ASSERT_TRUE(kinetic.audit(Audit_level::certificates).passed()) << "seed " << seed;
    ASSERT_EQ(kinetic.finite_edge_ids(), Kinetic(after).finite_edge_ids()) << "seed " << seed;
    ASSERT_EQ(kinetic.number_of_hidden_points(), Kinetic(after).number_of_hidden_points());
  }
}

TEST(Kinetic_regular_triangulation, goes_on_from_a_snapshot_as_it_would_have) {
  std::mt19937_64 random(5);
  for (int run = 0; run < cases(10); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    Kinetic kinetic(random_discs(random, 12, run % 2, 4, 1, 4));
    kinetic.advance_to(Algebraic_number(1));
    Kinetic restored = Kinetic::restore(kinetic.snapshot());
    EXPECT_EQ(hidden_points(restored), hidden_points(kinetic));
    ASSERT_EQ(test::audit_problem(restored, Audit_level::certificates), "");
    test::Event_recorder expected(kinetic);
    test::Event_recorder events(restored);
    kinetic.advance_to(Algebraic_number(5));
    restored.advance_to(Algebraic_number(5));
    EXPECT_EQ(test::difference(events.events, expected.events), "");
  }
}

// The hidden point 0 leaves the hull through the vertex 1, and then sees both hull edges there.
// With all ids, and from snapshots, since a restored triangulation stores its faces otherwise.
TEST(Kinetic_regular_triangulation, reveals_a_point_at_the_least_hull_edge_that_it_sees) {
  const std::array<Disc_motion_2, 4> discs = {disc(6, 4, 0, 1, 0), disc(6, 8, 0, 0, 3),
                                              disc(7, 0, -1, 0, 0), disc(7, 0, 0, 0, 0)};
  std::array<Point_id, 4> ids = {0, 1, 2, 3};
  do {
    SCOPED_TRACE(testing::PrintToString(ids));
    std::vector<Disc_motion_2> by_id(4);
    for (std::size_t i = 0; i < 4; ++i) by_id[ids[i]] = discs[i];
    Kinetic kinetic(by_id);
    kinetic.advance_to(Algebraic_number(3));
    const auto [passing, passed, left, right] = ids;
    ASSERT_TRUE(kinetic.is_hidden(passing));
    Kinetic restored = Kinetic::restore(kinetic.snapshot());
    for (Kinetic* const each : {&kinetic, &restored}) {
      test::Event_recorder recorder(*each);
      each->advance_to(Algebraic_number(4));
      ASSERT_EQ(recorder.events.size(), 4u);
      EXPECT_EQ(recorder.events[0].kind, Event_kind::reveal);
      std::array<Edge_ids, 2> first = {edge_ids(passing, passed),
                                       edge_ids(passing, std::min(left, right))};
      std::ranges::sort(first);
      EXPECT_EQ(recorder.events[1].added, first[0]);
      EXPECT_EQ(recorder.events[2].added, first[1]);
      EXPECT_EQ(recorder.events[3].kind, Event_kind::hull_remove);
      EXPECT_EQ(recorder.events[3].added, edge_ids(passing, std::max(left, right)));
    }
  } while (std::ranges::next_permutation(ids).found);
}

TEST(Kinetic_regular_triangulation, has_the_same_events_without_filters) {
  std::mt19937_64 random(6);
  for (int run = 0; run < cases(15); ++run) {
    SCOPED_TRACE("run " + std::to_string(run));
    const auto discs = random_discs(random, 12, run % 2, 3, 1, run % 3 == 0 ? 3 : 0);
    Kinetic filtered(discs);
    Kinetic exact(discs, Algebraic_number(), Disc_kinetic_traits_2::exact());
    test::Event_recorder expected(exact);
    test::Event_recorder events(filtered);
    filtered.advance_to(Algebraic_number(4));
    exact.advance_to(Algebraic_number(4));
    EXPECT_EQ(test::difference(events.events, expected.events), "");
  }
}

// The changes in place make a reconstruction necessary, while hidden points that jump are taken
// out.
TEST(Kinetic_regular_triangulation, may_be_rebuilt_while_hidden_points_jump) {
  const auto weighted = [](Vector_2 place, Vector_2 velocity, double epoch, double weight) {
    return Disc_motion_2{{place, velocity, epoch}, 0, 0, weight};
  };
  const std::vector<Disc_motion_2> discs = {
      weighted({0, 1}, {1, -1}, 2, 0),   weighted({0, 1}, {-1, 0}, 3, 1),
      weighted({2, 1}, {-1, 1}, -1, 0),  weighted({0, 0}, {1, 1}, -2, 0),
      weighted({0, 2}, {0, 1}, 0, 0),    weighted({1, -1}, {-1, 1}, 2, 1),
      weighted({1, 3}, {-1, -1}, -1, 0), weighted({0, 0}, {1, 1}, 2, 0),
      weighted({1, 3}, {-1, -1}, -1, 1), weighted({2, 0}, {-1, 0}, 2, 1)};
  Kinetic kinetic(discs, Algebraic_number(3));
  const std::vector<Point_id> ids = {8, 9, 7, 1, 4, 6};
  const std::vector<Disc_motion_2> others = {
      weighted({-2, -2}, {1, 1}, 1, 0), weighted({1, 1}, {0, 1}, 3, 1),
      weighted({0, 0}, {1, 1}, 2, 0),   weighted({1, 1}, {0, 0}, 1, 1),
      weighted({0, 1}, {-1, 0}, 3, 1),  weighted({4, 0}, {-1, 0}, 1, 0)};
  kinetic.set_motions(ids, others);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  std::vector<Disc_motion_2> all = discs;
  for (std::size_t k = 0; k < ids.size(); ++k) all[ids[k]] = others[k];
  EXPECT_EQ(kinetic.finite_edge_ids(), Kinetic(all, Algebraic_number(3)).finite_edge_ids());
}

TEST(Kinetic_regular_triangulation, refuses_two_discs_that_are_alike_also_when_they_are_hidden) {
  const std::vector<Disc_motion_2> discs = {disc(0, 0, 0, 0, 10), disc(30, 0, 0, 0, 1),
                                            disc(0, 30, 0, 0, 1), disc(-30, -30, 0, 0, 1),
                                            disc(1, 1, 0, 0, 1),  disc(2, 1, 0, 0, 1)};
  std::vector<Disc_motion_2> alike = discs;
  alike.push_back(discs[4]);
  EXPECT_THROW(Kinetic(alike, {}, {}, Coincident_points::refuse), Coincident_trajectories_error);
  Kinetic kinetic(discs, {}, {}, Coincident_points::refuse);
  EXPECT_TRUE(kinetic.is_hidden(4));
  EXPECT_THROW(kinetic.insert(discs[5]), Coincident_trajectories_error);
  EXPECT_THROW(kinetic.set_motion(4, discs[5]), Coincident_trajectories_error);
  EXPECT_THROW(kinetic.set_motion(4, discs[0]), Coincident_trajectories_error);
  EXPECT_EQ(kinetic.number_of_points(), 6u);
  // The same place with another radius is another disc.
  EXPECT_EQ(kinetic.insert(disc(2, 1, 0, 0, 2)), 6u);
  EXPECT_TRUE(kinetic.is_hidden(6));
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
}

// Certificates of growing discs that only touch zero are decided by predicates just after the time.
TEST(Kinetic_regular_triangulation, sees_where_certificates_of_growing_discs_touch) {
  std::vector<Disc_motion_2> discs = {disc(5, -6, 0, 1, 0.2), disc(-3, -6, 0, 0, 0.1),
                                      disc(-5, -2, -1, 1, 0.3), disc(-5, -1, -1, -1, 0.3),
                                      disc(-5, -5, -1, -1, 0.2)};
  const std::array<double, 5> growths = {1, 0.5, 0.5, 1, 0.5};
  for (std::size_t i = 0; i < discs.size(); ++i) discs[i].growth = growths[i];
  Kinetic kinetic(discs);
  for (const double time : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
    kinetic.advance_to(Algebraic_number(time));
    EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  }
}

}  // namespace
}  // namespace kinetri::kinetic_regular_triangulation_2_test
