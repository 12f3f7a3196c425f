// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "support/motions.h"
#include "support/precondition_error.h"

namespace kinetri::kinetic_delaunay_triangulation_2_test {
namespace {

using Kinetic_delaunay = Kinetic_delaunay_triangulation_2<>;

class Recorder : public Kinetic_delaunay::Observer {
 public:
  explicit Recorder(const Kinetic_delaunay& kinetic) : kinetic_(kinetic) {}

  void before_event(const Event& event) override {
    EXPECT_EQ(event.number, events.size());
    EXPECT_EQ(event.time, kinetic_.triangulation().geom_traits().instant().time);
    if (event.removed) {
      EXPECT_TRUE(has_edge(*event.removed));
    }
    pending_ = true;
  }
  void after_event(const Event& event) override {
    EXPECT_TRUE(pending_);
    pending_ = false;
    if (event.added) {
      EXPECT_TRUE(has_edge(*event.added));
    }
    if (event.removed && event.kind != Event_kind::rebuild) {
      EXPECT_FALSE(has_edge(*event.removed));
    }
    events.push_back(event);
  }

  std::vector<Event> events;

 private:
  bool has_edge(const Edge_ids& ids) const {
    return kinetic_.triangulation().is_edge(kinetic_.vertex(ids[0]), kinetic_.vertex(ids[1]));
  }

  const Kinetic_delaunay& kinetic_;
  bool pending_ = false;
};

void expect_passes(const Kinetic_delaunay& kinetic, Audit_level level = Audit_level::certificates) {
  const Audit_report report = kinetic.audit(level);
  EXPECT_TRUE(report.passed()) << report.failures.front();
}

void run_audited(Kinetic_delaunay& kinetic, double until) {
  expect_passes(kinetic);
  while (kinetic.next_event_time() && *kinetic.next_event_time() <= Algebraic_number(until)) {
    kinetic.step();
    expect_passes(kinetic, Audit_level::reference);
    if (testing::Test::HasFailure()) return;
  }
  kinetic.advance_to(until);
  expect_passes(kinetic);
}

TEST(Kinetic_delaunay_triangulation_2, steps_over_a_time_at_which_points_meet_and_no_edge_changes) {
  // The first two pass through each other at t = 1; later the last one leaves the hull.
  Kinetic_delaunay_triangulation_2<> kinetic(
      {{{0, 0}, {1, 0}}, {{2, 0}, {-1, 0}}, {{1, 5}, {0, 0}}, {{1, 9}, {0, -1}}});
  EXPECT_GT(kinetic.step(), 0u);
  EXPECT_GT(kinetic.current_time(), Algebraic_number(1.0));
  EXPECT_GT(kinetic.counters().points_set_aside + kinetic.counters().reconstructions, 0u);
}

TEST(Kinetic_delaunay_triangulation_2, of_no_points_is_empty_for_ever) {
  const std::vector<Linear_motion_2> none;
  Kinetic_delaunay kinetic(none.begin(), none.end());
  EXPECT_EQ(kinetic.number_of_points(), 0u);
  EXPECT_FALSE(kinetic.next_event_time());
  EXPECT_EQ(kinetic.step(), 0u);
  EXPECT_EQ(kinetic.advance_to(10.0), 0u);
  EXPECT_EQ(kinetic.current_time(), Algebraic_number(10.0));
  expect_passes(kinetic);
}

TEST(Kinetic_delaunay_triangulation_2, of_one_point_has_no_edges) {
  Kinetic_delaunay kinetic({{{1, 2}, {3, 4}, 0}});
  EXPECT_EQ(kinetic.advance_to(10.0), 0u);
  EXPECT_TRUE(kinetic.finite_edge_ids().empty());
  expect_passes(kinetic);
}

TEST(Kinetic_delaunay_triangulation_2, of_two_points_that_pass_through_each_other_keeps_its_edge) {
  Kinetic_delaunay kinetic({{{0, 0}, {1, 1}, 0}, {{2, 2}, {-1, -1}, 0}});
  EXPECT_EQ(kinetic.next_event_time(), Algebraic_number(1.0));
  kinetic.advance_to(10.0);
  EXPECT_EQ(kinetic.finite_edge_ids(), (std::vector<Edge_ids>{{0, 1}}));
  EXPECT_EQ(kinetic.counters().reconstructions, 1u);
  EXPECT_EQ(kinetic.counters().number_of_events(), 0u) << "no edge has changed";
  expect_passes(kinetic);
}

TEST(Kinetic_delaunay_triangulation_2, of_points_that_stay_collinear_is_their_order) {
  // On the line y = 2x: 0 overtakes 1 at t = 1 and 2 at t = 2.
  Kinetic_delaunay kinetic({{{0, 0}, {1, 2}, 0}, {{1, 2}, {0, 0}, 0}, {{2, 4}, {0, 0}, 0}});
  EXPECT_EQ(kinetic.triangulation().dimension(), 1);
  EXPECT_EQ(kinetic.finite_edge_ids(), (std::vector<Edge_ids>{{0, 1}, {1, 2}}));
  expect_passes(kinetic);
  kinetic.advance_to(1.0);
  EXPECT_EQ(kinetic.finite_edge_ids(), (std::vector<Edge_ids>{{0, 1}, {0, 2}}));
  expect_passes(kinetic);
  kinetic.advance_to(2.0);
  EXPECT_EQ(kinetic.finite_edge_ids(), (std::vector<Edge_ids>{{0, 2}, {1, 2}}));
  EXPECT_FALSE(kinetic.next_event_time());
  expect_passes(kinetic);
}

TEST(Kinetic_delaunay_triangulation_2, of_points_in_one_place_at_the_start_is_delaunay_just_after) {
  Kinetic_delaunay kinetic({{{1, 1}, {1, 0}, 0},
                            {{1, 1}, {-1, 0}, 0},
                            {{1, 1}, {0, 1}, 0},
                            {{1, 1}, {0, -2}, 0},
                            {{1, 1}, {0, 0}, 0}});
  EXPECT_EQ(kinetic.finite_edge_ids().size(), 8u);
  run_audited(kinetic, 5);
}

TEST(Kinetic_delaunay_triangulation_2, of_one_trajectory_twice_is_refused_with_both_ids) {
  const std::vector<Linear_motion_2> motions = {
      {{5, 5}, {0, 0}, 0}, {{1, 2}, {1, 1}, 0}, {{9, 2}, {0, 1}, 0}, {{3, 4}, {1, 1}, 2}};
  try {
    Kinetic_delaunay kinetic(motions, {}, {}, Coincident_points::refuse);
    FAIL() << "points 1 and 3 are the same trajectory";
  } catch (const Coincident_trajectories_error& error) {
    EXPECT_EQ(error.first(), 1u);
    EXPECT_EQ(error.second(), 3u);
    EXPECT_NE(std::string(error.what()).find("points 1 and 3"), std::string::npos);
  }
}

TEST(Kinetic_delaunay_triangulation_2, of_a_number_that_is_not_finite_is_refused) {
  const std::vector<Linear_motion_2> motions = {
      {{5, std::numeric_limits<double>::infinity()}, {0, 0}, 0}};
  EXPECT_PRECONDITION_ERROR(Kinetic_delaunay(motions),
                            "the motion of point 0 has a number that is not finite");
}

TEST(Kinetic_delaunay_triangulation_2, a_flip_is_reported_with_its_edges_and_exact_time) {
  Kinetic_delaunay kinetic(
      {{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 3}, {0, -1}, 0}});
  Recorder recorder(kinetic);
  kinetic.add_observer(recorder);
  EXPECT_EQ(kinetic.next_event_time(), Algebraic_number(2.0));
  EXPECT_EQ(kinetic.step(), 1u);
  ASSERT_EQ(recorder.events.size(), 1u);
  const Event& event = recorder.events.front();
  EXPECT_EQ(event.kind, Event_kind::flip);
  EXPECT_EQ(event.time, Algebraic_number(2.0));
  EXPECT_EQ(event.removed, (Edge_ids{0, 2}));
  EXPECT_EQ(event.added, (Edge_ids{1, 3}));
  EXPECT_EQ(kinetic.current_time(), Algebraic_number(2.0));
}

TEST(Kinetic_delaunay_triangulation_2, a_vertex_leaves_the_hull_and_enters_it_on_the_other_side) {
  Kinetic_delaunay kinetic(
      {{{0, 0}, {0, 0}, 0}, {{4, 0}, {0, 0}, 0}, {{2, 9}, {0, 0}, 0}, {{2.5, -1}, {0, 1}, 0}});
  Recorder recorder(kinetic);
  kinetic.add_observer(recorder);
  run_audited(kinetic, 0.5);
  run_audited(kinetic, 100);
  std::erase_if(recorder.events, [](const auto& e) { return e.kind == Event_kind::flip; });
  ASSERT_EQ(recorder.events.size(), 3u);
  EXPECT_EQ(recorder.events[0].kind, Event_kind::hull_remove);
  EXPECT_EQ(recorder.events[0].added, (Edge_ids{0, 1}));
  EXPECT_EQ(recorder.events[0].removed, std::nullopt);
  EXPECT_EQ(recorder.events[1].kind, Event_kind::hull_insert);
  EXPECT_EQ(recorder.events[1].removed, (Edge_ids{1, 2}));
  EXPECT_EQ(recorder.events[1].added, std::nullopt);
  EXPECT_EQ(recorder.events[1].time, Algebraic_number(7.75));
  // High above, it hides the top vertex behind the edge to the left one.
  EXPECT_EQ(recorder.events[2].kind, Event_kind::hull_remove);
  EXPECT_EQ(recorder.events[2].added, (Edge_ids{0, 3}));
}

TEST(Kinetic_delaunay_triangulation_2, advance_includes_an_event_at_exactly_the_given_time) {
  Kinetic_delaunay kinetic(
      {{{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 3}, {0, -1}, 0}});
  EXPECT_EQ(kinetic.advance_to(1.9999999999999998), 0u);
  EXPECT_EQ(kinetic.advance_to(2.0), 1u);
  EXPECT_PRECONDITION_ERROR(kinetic.advance_to(1.0),
                            "the time to advance to is in the past; take the present one or a "
                            "later one, or call reverse first");
}

TEST(Kinetic_delaunay_triangulation_2, an_event_exactly_at_the_start_has_happened_already) {
  Kinetic_delaunay kinetic(
      std::vector<Linear_motion_2>{
          {{-1, 0}, {0, 0}, 0}, {{0, -1}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{0, 3}, {0, -1}, 0}},
      Algebraic_number(2.0));
  EXPECT_TRUE(kinetic.triangulation().is_edge(kinetic.vertex(1), kinetic.vertex(3)));
  EXPECT_NE(kinetic.next_event_time(), Algebraic_number(2.0));
  expect_passes(kinetic);
}

class Audited_run : public testing::TestWithParam<std::size_t> {};

TEST_P(Audited_run, of_random_points_equals_the_static_triangulation_between_all_events) {
  const std::size_t n = GetParam();
  const auto motions = test::random_motions(n, 10 * std::sqrt(double(n)), 5, 1000 + unsigned(n));
  Kinetic_delaunay kinetic(motions);
  Recorder recorder(kinetic);
  kinetic.add_observer(recorder);
  run_audited(kinetic, n < 50 ? 5 : n < 200 ? 1 : 0.25);
  EXPECT_GT(recorder.events.size(), n / 5);
  EXPECT_EQ(kinetic.counters().reconstructions, 0u);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Audited_run, testing::Values(4, 6, 10, 20, 40, 100, 250));

TEST(Kinetic_delaunay_triangulation_2, of_many_seeds_passes_audits_from_time_to_time) {
  for (unsigned seed = 0; seed < test::cases(20u); ++seed) {
    SCOPED_TRACE(seed);
    Kinetic_delaunay kinetic(test::random_motions(10 + seed % 20, 40, 5, seed));
    for (const double t : {0.5, 1.0, 3.0}) {
      kinetic.advance_to(t);
      expect_passes(kinetic);
    }
  }
}

TEST(Kinetic_delaunay_triangulation_2, events_do_not_depend_on_the_order_of_the_points) {
  const auto motions = test::random_motions(60, 80, 5, 77);
  std::vector<Point_id> order(motions.size());
  std::iota(order.begin(), order.end(), Point_id{0});
  std::mt19937_64 random(3);
  std::ranges::shuffle(order, random);
  std::vector<Linear_motion_2> permuted;
  for (const Point_id id : order) permuted.push_back(motions[id]);

  Kinetic_delaunay first(motions);
  Kinetic_delaunay second(permuted);
  Recorder a(first);
  Recorder b(second);
  first.add_observer(a);
  second.add_observer(b);
  first.advance_to(2.0);
  second.advance_to(2.0);
  const auto renamed = [&order](const std::optional<Edge_ids>& edge) -> std::optional<Edge_ids> {
    if (!edge) return edge;
    return edge_ids(order[(*edge)[0]], order[(*edge)[1]]);
  };
  ASSERT_EQ(a.events.size(), b.events.size());
  ASSERT_GT(a.events.size(), 50u);
  for (std::size_t i = 0; i < a.events.size(); ++i) {
    ASSERT_EQ(a.events[i].kind, b.events[i].kind);
    ASSERT_EQ(a.events[i].time, b.events[i].time);
    ASSERT_EQ(a.events[i].removed, renamed(b.events[i].removed));
    ASSERT_EQ(a.events[i].added, renamed(b.events[i].added));
  }
}

TEST(Kinetic_delaunay_triangulation_2, an_observer_that_was_removed_hears_nothing) {
  Kinetic_delaunay kinetic(test::random_motions(20, 40, 5, 8));
  Recorder kept(kinetic);
  Recorder removed(kinetic);
  kinetic.add_observer(removed);
  kinetic.add_observer(kept);
  kinetic.remove_observer(removed);
  kinetic.advance_to(1.0);
  EXPECT_TRUE(removed.events.empty());
  EXPECT_FALSE(kept.events.empty());
  EXPECT_EQ(kept.events.size(), kinetic.counters().number_of_events());
}

// Nothing asks for the time of an event where nobody looks on, so that it may be made late, or
// never.
TEST(Kinetic_delaunay_triangulation_2, stands_at_the_same_exact_times_with_observers_and_without) {
  const auto motions = test::random_motions(40, 60, 5, 22);
  Kinetic_delaunay alone(motions);
  Kinetic_delaunay observed(motions);
  Recorder recorder(observed);
  observed.add_observer(recorder);
  std::size_t seen = 0;
  while (alone.next_event_time() && *alone.next_event_time() < Algebraic_number(3.0)) {
    const Algebraic_number expected = *alone.next_event_time();
    EXPECT_EQ(alone.step(), observed.step());
    for (const Kinetic_delaunay* kinetic : {&alone, &observed}) {
      EXPECT_EQ(kinetic->current_time(), expected);
      const Instant& instant = kinetic->triangulation().geom_traits().instant();
      EXPECT_EQ(instant.time, expected);
      EXPECT_EQ(instant.side, Time_side::after);
    }
    for (; seen < recorder.events.size(); ++seen) EXPECT_EQ(recorder.events[seen].time, expected);
  }
  EXPECT_GT(seen, 0u);
  EXPECT_EQ(alone.finite_edge_ids(), observed.finite_edge_ids());
  EXPECT_EQ(alone.counters(), observed.counters());
  for (Kinetic_delaunay* kinetic : {&alone, &observed}) {
    kinetic->advance_to(5.0);
    EXPECT_EQ(kinetic->current_time(), Algebraic_number(5.0));
    EXPECT_EQ(kinetic->triangulation().geom_traits().instant().time, Algebraic_number(5.0));
  }
}

TEST(Kinetic_delaunay_triangulation_2, counters_add_up) {
  Kinetic_delaunay kinetic(test::random_motions(50, 70, 5, 21));
  kinetic.advance_to(3.0);
  const std::uint64_t executed = kinetic.counters().number_of_events();
  std::uint64_t left = 0;
  while (kinetic.next_event_time()) {
    kinetic.step();
    ++left;
  }
  EXPECT_GT(executed, 0u);
  EXPECT_GT(left, 0u);
  EXPECT_GT(kinetic.counters().rechecks, 0u);
  const Queue_counters queue = kinetic.queue_counters();
  EXPECT_EQ(queue.pushed,
            queue.discarded + kinetic.counters().rechecks + kinetic.counters().number_of_events());
}

// At t = 1 all points are on one line; before and after, the edges are the same.
TEST(Kinetic_delaunay_triangulation_2, of_points_once_on_a_line_reports_only_what_has_changed) {
  Kinetic_delaunay kinetic(
      {{{1, 1}, {0, 1}, 0}, {{0, 0}, {1, 0}, 0}, {{2, 0}, {-1, -1}, 0}, {{1, 1}, {0, 0}, 0}});
  const auto before = kinetic.finite_edge_ids();
  kinetic.advance_to(1.0);
  EXPECT_EQ(kinetic.finite_edge_ids(), before);
  EXPECT_EQ(kinetic.counters().number_of_events(), 0u);
  EXPECT_EQ(kinetic.counters().flat_hulls, 1u);
  EXPECT_EQ(kinetic.counters().reconstructions, 1u);
}

// The certificates start at the present time, so that they stay well conditioned in long runs.
TEST(Kinetic_delaunay_triangulation_2, a_long_run_needs_no_more_exact_arithmetic) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Kinetic_delaunay kinetic(test::random_motions(50, 70, 5, seed));
    kinetic.advance_to(10.0);
    const Certificate_counters early = kinetic.certificate_counters();
    EXPECT_LE(early.exact_decided * 1000, early.created) << "with seed " << seed;
    kinetic.advance_to(1e6);
    const Certificate_counters late = kinetic.certificate_counters();
    EXPECT_LE(late.exact_decided * 1000, late.created) << "with seed " << seed;
    EXPECT_TRUE(kinetic.audit(Audit_level::certificates).passed());
  }
}

TEST(Kinetic_delaunay_triangulation_2, the_triangulation_answers_queries_at_the_current_instant) {
  const auto motions = test::random_motions(30, 50, 5, 4);
  Kinetic_delaunay kinetic(motions);
  kinetic.advance_to(2.5);
  EXPECT_TRUE(kinetic.triangulation().is_valid());
  const Moving_point_2 query(Linear_motion_2{{25, 25}, {0, 0}, 0});
  const auto nearest = kinetic.triangulation().nearest_vertex(query);
  const Rational t(5, 2);
  for (const Linear_motion_2& m : motions) {
    EXPECT_NE(CGAL::compare_distance_to_point(test::Static_point(25, 25), test::place_at(m, t),
                                              test::place_at(nearest->point().motion(), t)),
              CGAL::SMALLER);
  }
}

TEST(Kinetic_delaunay_triangulation_2, of_far_away_epochs_equals_that_of_epoch_zero) {
  // Integer motions, so that moving the epoch is exact.
  auto motions = test::grid_motions(25, 1000, 50, 6);
  Kinetic_delaunay here(motions);
  for (Linear_motion_2& m : motions) {
    m.epoch = 1048576;
    m.position.x += m.velocity.x * m.epoch;
    m.position.y += m.velocity.y * m.epoch;
  }
  Kinetic_delaunay there(motions);
  for (int i = 0; i < 100 && here.next_event_time(); ++i) {
    ASSERT_EQ(here.next_event_time(), there.next_event_time());
    here.step();
    there.step();
    ASSERT_EQ(here.finite_edge_ids(), there.finite_edge_ids());
  }
}

// At the start nothing has been popped; in the end there is no edge that could fail.
TEST(Kinetic_delaunay_triangulation_2, tells_the_present_length_of_its_queue) {
  Kinetic_delaunay kinetic(test::random_motions(50, 100, 10, 9));
  EXPECT_GT(kinetic.queue_size(), 10u);
  EXPECT_EQ(kinetic.queue_size(),
            kinetic.queue_counters().pushed - kinetic.queue_counters().discarded);
  for (Point_id id = 0; id < 50; ++id) kinetic.erase(id);
  EXPECT_EQ(kinetic.queue_size(), 0u);
}

}  // namespace
}  // namespace kinetri::kinetic_delaunay_triangulation_2_test
