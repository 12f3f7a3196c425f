// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that come, turn, jump and go while time runs: on grids so coarse that they land on edges,
// on hulls and on one another, with audits after each change.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <random>

#include "support/kinetic_runs.h"
#include "support/precondition_error.h"

namespace kinetri::changes_test {
namespace {

using test::Kinetic_delaunay;

// Mixed operations at random, checked after each.
class Mixed_operations {
 public:
  Mixed_operations(std::size_t points, int size, int speed, unsigned seed)
      : size_(size),
        speed_(speed),
        random_(seed),
        kinetic_(test::grid_motions(points, size, speed, seed), {}, {}, Coincident_points::refuse),
        recorder_(kinetic_) {
    for (Point_id id = 0; id < points; ++id) remember(id);
  }

  std::string problem(int operations) {
    for (int i = 0; i < operations; ++i) {
      const std::string text = operate();
      const Audit_level level = i % 8 == 0 ? Audit_level::certificates : Audit_level::reference;
      std::string found = test::audit_problem(kinetic_, level);
      if (found.empty()) found = bookkeeping_problem();
      if (!found.empty()) return "operation " + std::to_string(i) + ", " + text + ": " + found;
    }
    return {};
  }

  int refused() const { return refused_; }
  const Triangulation_counters& counters() const { return kinetic_.counters(); }

 private:
  struct Known_point {
    Kinetic_delaunay::Vertex_handle vertex;
    Linear_motion_2 motion;
  };

  std::string operate() {
    switch (number(0, 9)) {
      case 0:
      case 1:
        kinetic_.step();
        return "step";
      case 2: {
        // Mostly times at which the points are on the grid again.
        const Rational quarters(number(1, 8), 4);
        const Rational now(static_cast<long>(kinetic_.current_time().to_double() + 1));
        kinetic_.advance_to(std::max(Algebraic_number(now + quarters), kinetic_.current_time()));
        return "advance";
      }
      case 3:
      case 4:
        return insert();
      case 5:
        return erase();
      case 6:
        return turn_two();
      default:
        return turn();
    }
  }

  std::string insert() {
    const Linear_motion_2 motion = random_motion();
    const Point_id id = kinetic_.next_id();
    if (known_.size() > 12) return "nothing";
    attempt(motion, [&] {
      EXPECT_EQ(kinetic_.insert(motion), id);
      remember(id);
    });
    return "insert " + std::to_string(id);
  }

  std::string erase() {
    if (known_.empty()) return "nothing";
    const Point_id id = random_id();
    kinetic_.erase(id);
    known_.erase(id);
    return "erase " + std::to_string(id);
  }

  std::string turn() {
    if (known_.empty()) return "nothing";
    const Point_id id = random_id();
    Linear_motion_2 motion = random_motion();
    if (number(0, 2) == 0) {
      // From where it is, if that is a binary64 number and not only next to it.
      const double t = kinetic_.current_time().to_double();
      const Linear_motion_2 old = kinetic_.motion(id);
      motion.position = {old.position.x + old.velocity.x * (t - old.epoch),
                         old.position.y + old.velocity.y * (t - old.epoch)};
      motion.epoch = t;
    }
    attempt(motion, [&] {
      kinetic_.set_motion(id, motion);
      known_.at(id).motion = motion;
    });
    return "turn " + std::to_string(id);
  }

  // Two in one event, of which one may stay where it is and the other jump.
  std::string turn_two() {
    if (known_.size() < 2) return "nothing";
    const Point_id a = random_id();
    const Point_id b = random_id();
    const Linear_motion_2 for_a = number(0, 1) == 0 ? random_motion() : slower(kinetic_.motion(a));
    const Linear_motion_2 for_b = random_motion();
    const auto is_taken = [&](const Linear_motion_2& motion) {
      return std::ranges::any_of(
          known_, [&](const auto& known) { return same_trajectory(known.second.motion, motion); });
    };
    if (a == b || is_taken(for_a) || is_taken(for_b) || same_trajectory(for_a, for_b)) {
      return "nothing";
    }
    const std::array<Kinetic_delaunay::Change, 2> changes = {{{a, for_a}, {b, for_b}}};
    kinetic_.apply(Event_kind::collision, a, b, changes);
    known_.at(a).motion = for_a;
    known_.at(b).motion = for_b;
    return "turn " + std::to_string(a) + " and " + std::to_string(b);
  }

  // From about where it is, at half the speed.
  Linear_motion_2 slower(const Linear_motion_2& m) const {
    return with_velocity_at(m, {m.velocity.x / 2, m.velocity.y / 2},
                            kinetic_.current_time().to_double());
  }

  // Makes the change, which is refused exactly if the motion is that of another point.
  template <class Change>
  void attempt(const Linear_motion_2& motion, Change change) {
    const auto others = std::ranges::count_if(
        known_, [&](const auto& entry) { return same_trajectory(entry.second.motion, motion); });
    const std::size_t events = recorder_.events.size();
    try {
      change();
    } catch (const Coincident_trajectories_error& error) {
      EXPECT_GE(others, 1);
      EXPECT_TRUE(same_trajectory(kinetic_.motion(error.first()), motion) ||
                  same_trajectory(kinetic_.motion(error.second()), motion));
      EXPECT_EQ(recorder_.events.size(), events);
      ++refused_;
    }
  }

  // The points are those that are known, under the handles that they have had from the start.
  std::string bookkeeping_problem() const {
    if (kinetic_.number_of_points() != known_.size()) return "a wrong number of points";
    for (Point_id id = 0; id < kinetic_.next_id(); ++id) {
      if (kinetic_.contains(id) != known_.contains(id)) return "a point too many, or missing";
    }
    for (const auto& [id, point] : known_) {
      if (kinetic_.vertex(id) != point.vertex) return "another handle";
      if (point.vertex->point().id() != id) return "another point at the handle";
      if (kinetic_.motion(id) != point.motion) return "another motion";
    }
    if (recorder_.edges != test::edges_of(kinetic_)) return "events do not account for the edges";
    return {};
  }

  void remember(Point_id id) { known_[id] = {kinetic_.vertex(id), kinetic_.motion(id)}; }

  Linear_motion_2 random_motion() {
    const auto coordinate = [&] { return static_cast<double>(number(0, size_ - 1)); };
    const auto component = [&] { return static_cast<double>(number(-speed_, speed_)); };
    const double x = coordinate();
    const double y = coordinate();
    const double vx = component();
    const double vy = component();
    return {{x, y}, {vx, vy}, number(0, 1) == 0 ? 0.0 : kinetic_.current_time().to_double()};
  }

  Point_id random_id() {
    return std::next(known_.begin(), number(0, static_cast<int>(known_.size()) - 1))->first;
  }
  int number(int least, int greatest) {
    return std::uniform_int_distribution<int>(least, greatest)(random_);
  }

  int size_;
  int speed_;
  std::mt19937_64 random_;
  Kinetic_delaunay kinetic_;
  test::Event_recorder recorder_;
  std::map<Point_id, Known_point> known_;
  int refused_ = 0;
};

class Mixed_operations_on_grids : public testing::TestWithParam<std::tuple<int, int, int>> {};

TEST_P(Mixed_operations_on_grids, leave_the_triangulation_right) {
  const auto [points, size, speed] = GetParam();
  int refused = 0;
  std::uint64_t rebuilds = 0;
  for (unsigned seed = 0; seed < test::cases(7u); ++seed) {
    Mixed_operations run(static_cast<std::size_t>(points), size, speed, seed);
    ASSERT_EQ(run.problem(60), "") << "seed " << seed;
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
    refused += run.refused();
    rebuilds += run.counters().reconstructions;
  }
  if (size == 2) {
    EXPECT_GT(refused, 0);
    EXPECT_GT(rebuilds, 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Mixed_operations_on_grids,
                         testing::Values(std::tuple(0, 2, 1), std::tuple(3, 2, 1),
                                         std::tuple(1, 3, 0), std::tuple(6, 3, 1),
                                         std::tuple(8, 5, 2), std::tuple(12, 40, 7)));

// A point on a line with others, and back: the dimension goes down and up.
TEST(Changes, take_the_points_onto_a_line_and_off_it) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {0, 0}, 0}, {{1, 0}, {0, 0}, 0}, {{2, 0}, {0, 0}, 0}, {{1, 1}, {0, 0}, 0}};
  Kinetic_delaunay kinetic(motions);
  const Point_id v = 3;
  EXPECT_EQ(kinetic.triangulation().dimension(), 2);
  kinetic.set_motion(v, {{3, 0}, {0, 0}, 0});
  EXPECT_EQ(kinetic.triangulation().dimension(), 1);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  kinetic.set_motion(v, {{3, 0}, {0, 1}, 0});
  EXPECT_EQ(kinetic.triangulation().dimension(), 2);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  EXPECT_TRUE(kinetic.contains(v));
  EXPECT_EQ(kinetic.counters().reconstructions, 0u);
}

TEST(Changes, of_the_last_points_leave_a_triangulation_that_goes_on) {
  Kinetic_delaunay kinetic(std::vector<Linear_motion_2>{{{0, 0}, {1, 0}, 0}});
  kinetic.erase(0);
  EXPECT_EQ(kinetic.number_of_points(), 0u);
  EXPECT_FALSE(kinetic.contains(0));
  EXPECT_PRECONDITION_ERROR(kinetic.vertex(0), "no point has the id 0; ask contains(id) first");
  EXPECT_EQ(kinetic.next_event_time(), std::nullopt);
  for (const double x : {0.0, 1.0, 2.0}) kinetic.insert({{x, 0}, {0, x - 1}, 0});
  EXPECT_EQ(kinetic.next_id(), 4u);
  EXPECT_EQ(kinetic.triangulation().dimension(), 1);
  kinetic.insert({{1, 1}, {0, 0}, 0});
  EXPECT_EQ(kinetic.triangulation().dimension(), 2);
  EXPECT_EQ(test::audited_run(kinetic, std::nullopt, Audit_level::certificates), "");
}

TEST(Changes, cost_what_the_degree_asks_for) {
  Kinetic_delaunay kinetic(test::random_motions(2000, 450, 5, 1));
  kinetic.advance_to(0.5);
  const std::uint64_t before = kinetic.certificate_counters().created;
  for (Point_id id = 0; id < 100; ++id) {
    const Linear_motion_2 old = kinetic.motion(id);
    const Vector_2 place = {old.position.x + old.velocity.x * 0.5,
                            old.position.y + old.velocity.y * 0.5};
    kinetic.set_motion(id, {place, {-old.velocity.x, old.velocity.y}, 0.5});
  }
  // About two certificates an edge of the point, which has six on average.
  EXPECT_LT(kinetic.certificate_counters().created - before, 100u * 30);
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::reference), "");
  EXPECT_EQ(test::audited_run(kinetic, Algebraic_number(0.6), Audit_level::links), "");
}

TEST(Changes, refuse_what_is_no_motion) {
  Kinetic_delaunay kinetic(test::random_motions(5, 10, 5, 1));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_PRECONDITION_ERROR(kinetic.insert({{infinity, 0}, {0, 0}, 0}),
                            "the motion of point 5 has a number that is not finite");
  EXPECT_PRECONDITION_ERROR(kinetic.set_motion(0, {{0, 0}, {infinity, 0}, 0}),
                            "the motion of point 0 has a number that is not finite");
  EXPECT_PRECONDITION_ERROR(kinetic.erase(5), "no point has the id 5; ask contains(id) first");
  EXPECT_PRECONDITION_ERROR(kinetic.set_motion(no_point, {{0, 0}, {1, 0}, 0}),
                            "no point has the id 4294967295; ask contains(id) first");
  EXPECT_EQ(kinetic.counters().number_of_events(), 0u);
}

TEST(Changes, that_are_refused_leave_everything_as_it_was) {
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {0, 0}, 0}, {{4, 0}, {0, 0}, 0}, {{0, 4}, {0, 0}, 0}, {{3, 3}, {1, 1}, 0}};
  Kinetic_delaunay kinetic(motions, {}, {}, Coincident_points::refuse);
  struct Watcher : Kinetic_delaunay::Observer {
    void before_event(const test::Kinetic_event& event) override { events.push_back(event); }
    std::vector<test::Kinetic_event> events;
  } watcher;
  kinetic.add_observer(watcher);
  EXPECT_THROW(kinetic.insert(motions[1]), Coincident_trajectories_error);
  EXPECT_THROW(kinetic.set_motion(0, motions[3]), Coincident_trajectories_error);
  EXPECT_EQ(kinetic.next_id(), 4u);
  EXPECT_TRUE(watcher.events.empty());
  kinetic.step();
  ASSERT_EQ(watcher.events.size(), 1u);
  EXPECT_EQ(watcher.events[0].kind, Event_kind::flip);
}

TEST(Changes, of_one_event_are_made_together_or_not_at_all) {
  Kinetic_delaunay kinetic(test::random_motions(20, 10, 5, 1), {}, {}, Coincident_points::refuse);
  test::Event_recorder recorder(kinetic);
  const Linear_motion_2 turned = {kinetic.motion(3).position, {0, 0}, 0};
  const std::array<Kinetic_delaunay::Change, 2> changes = {{{3, turned}, {4, turned}}};
  EXPECT_THROW(kinetic.apply(Event_kind::collision, 3, 4, changes), Coincident_trajectories_error);
  EXPECT_NE(kinetic.motion(3), turned);
  EXPECT_NE(kinetic.motion(4), turned);
  EXPECT_TRUE(recorder.events.empty());
  EXPECT_EQ(recorder.edges, test::edges_of(kinetic));
  EXPECT_EQ(test::audit_problem(kinetic, Audit_level::certificates), "");
  EXPECT_EQ(test::audited_run(kinetic, Algebraic_number(1.0), Audit_level::links), "");
}

TEST(Changes, of_one_event_return_the_edges_that_have_changed) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Kinetic_delaunay kinetic(test::random_motions(30, 50, 5, seed));
    kinetic.advance_to(1.0);
    const std::vector<Edge_ids> before = kinetic.finite_edge_ids();
    const Linear_motion_2 elsewhere = {{25, 25.5}, {1, seed * 0.5}, 1.0};
    const std::array<Kinetic_delaunay::Change, 2> changes = {{{3, elsewhere}, {4, std::nullopt}}};
    const Changed_edges changed = kinetic.apply(Event_kind::collision, 3, 4, changes);
    const std::vector<Edge_ids> after = kinetic.finite_edge_ids();
    std::vector<Edge_ids> removed;
    std::ranges::set_difference(before, after, std::back_inserter(removed));
    std::vector<Edge_ids> added;
    std::ranges::set_difference(after, before, std::back_inserter(added));
    EXPECT_EQ(changed.removed, removed);
    EXPECT_EQ(changed.added, added);
    EXPECT_FALSE(removed.empty());
    EXPECT_FALSE(added.empty());
  }
}

// Of two points both are looked at; of one, or where the ids of most points are erased, any will
// do.
Kinetic_delaunay::Vertex_handle vertex_near(const Kinetic_delaunay& kinetic,
                                            const Moving_point_2& place) {
  return detail::Core_access::core(kinetic).topology.vertex_near(
      place, kinetic.current_time().to_double());
}

TEST(Vertex_near, is_the_nearer_of_two_points_at_the_current_time) {
  Kinetic_delaunay kinetic({{{0, 0}, {1, 0}, 0}, {{10, 0}, {-1, 0}, 0}});
  const Moving_point_2 place({{2, 1}, {0, 0}, 0});
  EXPECT_EQ(vertex_near(kinetic, place), kinetic.vertex(0));
  kinetic.advance_to(8.0);
  EXPECT_EQ(vertex_near(kinetic, place), kinetic.vertex(1));
  kinetic.erase(1);
  EXPECT_EQ(vertex_near(kinetic, place), kinetic.vertex(0));
  Kinetic_delaunay sparse(test::random_motions(100, 10, 5, 1));
  for (Point_id id = 0; id < 99; ++id) sparse.erase(id);
  EXPECT_EQ(vertex_near(sparse, place), sparse.vertex(99));
}

TEST(Changes, are_events_with_their_points) {
  Kinetic_delaunay kinetic(test::random_motions(20, 10, 5, 1));
  test::Event_recorder recorder(kinetic);
  kinetic.insert({{5, 5}, {0, 0}, 0});
  ASSERT_FALSE(recorder.events.empty());
  EXPECT_EQ(recorder.events.front().kind, Event_kind::insert);
  EXPECT_EQ(recorder.events.front().point_a, 20u);
  EXPECT_EQ(recorder.events.front().number, 0u);
  for (std::size_t i = 1; i < recorder.events.size(); ++i) {
    EXPECT_EQ(recorder.events[i].kind, Event_kind::rebuild);
    EXPECT_EQ(recorder.events[i].number, i);
  }
  recorder.events.clear();
  kinetic.apply(Event_kind::collision, 3, 4, {});
  ASSERT_EQ(recorder.events.size(), 1u);
  EXPECT_EQ(recorder.events.front().kind, Event_kind::collision);
  EXPECT_EQ(recorder.events.front().point_b, 4u);
  EXPECT_EQ(kinetic.counters().events[static_cast<std::size_t>(Event_kind::collision)], 1u);
}

}  // namespace
}  // namespace kinetri::changes_test
