// SPDX-License-Identifier: GPL-3.0-or-later
//
// The motion log: outside programs read these lines, and the motions are those of the run.
#include "kinetri/io/motion_log.h"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/simulation/collision_response.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/disc_runs.h"
#include "support/precondition_error.h"

namespace kinetri::motion_log_test {
namespace {

const std::string header = "event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch\n";

// A simulation, and what the log of it has after the lines of the start.
template <class Traits>
class Logged {
 public:
  using Simulation = Simulation_2<Traits>;

  explicit Logged(const std::vector<typename Traits::Motion>& motions,
                  const Simulation_options& options = {})
      : simulation_(motions, options),
        writer_(out_, simulation_.triangulation(), options.radius),
        start_(out_.str()) {
    simulation_.add_observer(writer_);
  }

  Simulation& simulation() { return simulation_; }
  const std::string& start() const { return start_; }
  std::string text() const { return out_.str(); }
  std::string rows() const { return text().substr(start_.size()); }

 private:
  std::ostringstream out_;
  Simulation simulation_;
  Motion_log_writer<Traits> writer_;
  std::string start_;
};

using Logged_points = Logged<Linear_kinetic_traits_2>;
using Logged_discs = Logged<Disc_kinetic_traits_2>;

double read_back(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  EXPECT_TRUE(error == std::errc() && stop == end) << text;
  return value;
}

// ---- the lines ----

TEST(Motion_log, begins_with_the_motions_of_the_start) {
  EXPECT_EQ(Logged_points({{{1, 2}, {3, -4}, 0.5}, {{0, 0}, {0, 0}}}).text(),
            header + ",0,1,2,3,-4,0,0,0,0,0,0,0.5\n,1,0,0,0,0,0,0,0,0,0,0,0\n");
  EXPECT_EQ(Logged<Polynomial_kinetic_traits_2>({{{1, 2}, {3, 4}, {5, 6}, {7, 8}, 9}}).text(),
            header + ",0,1,2,3,4,5,6,7,8,0,0,9\n");
  EXPECT_EQ(Logged_discs({{{{1, 2}, {3, 4}, 9}, 5, 0.25}}).text(),
            header + ",0,1,2,3,4,0,0,0,0,5,0.25,9\n");
  EXPECT_EQ(Logged<Polynomial_disc_kinetic_traits_2>({{{{1, 2}, {3, 4}, {5, 6}, {7, 8}, 9}, 10, 1}})
                .text(),
            header + ",0,1,2,3,4,5,6,7,8,10,1,9\n");
}

TEST(Motion_log, has_the_radius_that_all_points_have) {
  EXPECT_EQ(Logged_points({{{1, 2}, {0, 0}}}, test::discs(0.75, log_contact)).text(),
            header + ",0,1,2,0,0,0,0,0,0,0.75,0,0\n");
}

TEST(Motion_log, begins_with_the_points_that_are_there) {
  Kinetic_delaunay_triangulation_2<> triangulation(
      std::vector<Linear_motion_2>{{{0, 0}, {0, 0}}, {{1, 0}, {0, 0}}, {{0, 1}, {0, 0}}});
  triangulation.erase(1);
  std::ostringstream out;
  const Motion_log_writer<> writer(out, triangulation);
  EXPECT_EQ(out.str(), header + ",0,0,0,0,0,0,0,0,0,0,0,0\n,2,0,1,0,0,0,0,0,0,0,0,0\n");
}

TEST(Motion_log, has_a_line_for_each_change) {
  Logged_points run({{{0, 0}, {0, 0}}, {{9, 0}, {0, 0}}, {{0, 9}, {0, 0}}});
  run.simulation().advance_to(2.0);
  const Point_id id = run.simulation().insert({{1, 1}, {1, 0}, 2});
  run.simulation().advance_to(3.0);
  run.simulation().set_motion(id, {{2, 1}, {0, 0.5}, 3});
  run.simulation().erase(id);
  // The rows between are those of the edges, as the event log has them.
  EXPECT_EQ(run.rows(),
            "0,3,1,1,1,0,0,0,0,0,0,0,2\n"
            "4,3,2,1,0,0.5,0,0,0,0,0,0,3\n"
            "5,3,,,,,,,,,,,\n");
}

// All of them change together, before the first of their events is over.
TEST(Motion_log, of_changes_at_once_names_the_event_of_each) {
  Logged_points run({{{0, 0}, {0, 0}}, {{9, 0}, {0, 0}}, {{0, 9}, {0, 0}}});
  const std::vector<Point_id> ids = {2, 0};
  const std::vector<Linear_motion_2> motions = {{{0, 9}, {1, 1}}, {{0, 0}, {-1, -1}}};
  run.simulation().set_motions(ids, motions);
  EXPECT_EQ(run.rows(), "0,0,0,0,-1,-1,0,0,0,0,0,0,0\n1,2,0,9,1,1,0,0,0,0,0,0,0\n");
}

TEST(Motion_log, of_a_wall_has_the_reflected_motion) {
  Logged_points run({{{1, 1}, {2, 0.25}}}, test::in_box({0, 0, 5, 5}));
  run.simulation().advance_to(2.5);
  EXPECT_EQ(run.rows(), "0,0,5,1.5,-2,0.25,0,0,0,0,0,0,2\n");
}

TEST(Motion_log, of_a_collision_has_the_points_whose_motions_change) {
  // They touch at time 1.
  const std::vector<Linear_motion_2> motions = {
      {{0, 0}, {1, 0}}, {{4, 0}, {-1, 0}}, {{0, 99}, {0, 0}}};
  const auto rows = [&](Collision_response response, std::vector<Linear_motion_2> points) {
    Logged_points run(points, test::discs(1, std::move(response)));
    run.simulation().advance_to(1.5);
    return run.rows();
  };
  EXPECT_EQ(rows(swap_velocities, motions),
            "0,0,1,0,-1,0,0,0,0,0,1,0,1\n0,1,3,0,1,0,0,0,0,0,1,0,1\n");
  EXPECT_EQ(rows(log_contact, motions), "");
  EXPECT_EQ(rows(erase_both, motions).substr(0, 30), "0,0,,,,,,,,,,,\n0,1,,,,,,,,,,,\n");
  // The one that rests already goes on as it is.
  std::vector<Linear_motion_2> one_rests = motions;
  one_rests[0] = {{1, 0}, {0, 0}};
  EXPECT_EQ(rows(stop_both, one_rests), "0,1,3,0,0,0,0,0,0,0,1,0,1\n");
}

TEST(Motion_log, numbers_read_back_exactly) {
  const std::array<double, 9> numbers = {0.1,    1.0 / 3, -0x1p-1074,  1e300, -0.0,
                                         1e-300, 1e22,    123456789.0, -2e-7};
  const Polynomial_disc_motion_2 motion = {{{numbers[0], numbers[1]},
                                            {numbers[2], numbers[3]},
                                            {numbers[4], numbers[5]},
                                            {numbers[6], numbers[7]},
                                            numbers[8]},
                                           std::numeric_limits<double>::max(),
                                           std::numeric_limits<double>::denorm_min()};
  Kinetic_triangulation_2<Polynomial_disc_kinetic_traits_2> triangulation(std::vector{motion});
  std::ostringstream out;
  const Motion_log_writer<Polynomial_disc_kinetic_traits_2> writer(out, triangulation);
  std::istringstream fields(out.str().substr(header.size()));
  std::vector<std::string> texts;
  for (std::string field; std::getline(fields, field, ',');) texts.push_back(field);
  ASSERT_EQ(texts.size(), 13U);
  texts.back().pop_back();  // the line end
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(read_back(texts[2 + i]), numbers[i]);
    EXPECT_EQ(std::signbit(read_back(texts[2 + i])), std::signbit(numbers[i]));
  }
  EXPECT_EQ(read_back(texts[10]), std::numeric_limits<double>::max());
  EXPECT_EQ(read_back(texts[11]), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(read_back(texts[12]), numbers[8]);
}

TEST(Motion_log, has_no_column_for_weights) {
  Disc_motion_2 weighted = {{{0, 0}, {0, 0}}, 0};
  weighted.weight = 1;
  EXPECT_PRECONDITION_ERROR(Logged_discs({weighted}),
                            "a motion has a weight besides its radius, for which a motion log has "
                            "no column; expected discs, or points without weights");
}

// ---- whole runs ----

// The motions that the lines tell up to now, by id.
class Replay {
 public:
  void read(const std::string& text) {
    std::istringstream lines(text.substr(done_));
    done_ = text.size();
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> fields(1);
      for (const char c : line) c == ',' ? void(fields.emplace_back()) : void(fields.back() += c);
      ASSERT_EQ(fields.size(), 13U) << line;
      if (fields[1] == "id") continue;
      const auto id = static_cast<Point_id>(std::stoul(fields[1]));
      if (fields[2].empty()) {
        motions_.erase(id);
        continue;
      }
      std::array<double, 11> n = {};
      for (std::size_t i = 0; i < n.size(); ++i) n[i] = read_back(fields[2 + i]);
      motions_[id] = {{{n[0], n[1]}, {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}, n[10]}, n[8], n[9]};
    }
  }

  const std::map<Point_id, Polynomial_disc_motion_2>& motions() const { return motions_; }

 private:
  std::size_t done_ = 0;
  std::map<Point_id, Polynomial_disc_motion_2> motions_;
};

Polynomial_disc_motion_2 general(const Linear_motion_2& motion) {
  return {polynomial_motion(motion), 2, 0};
}
Polynomial_disc_motion_2 general(const Disc_motion_2& motion) {
  return polynomial_motion(motion);
}

// After each instant the log tells the motions that the simulation has.
template <class Traits>
void expect_true_log(Logged<Traits>& run, double until) {
  Replay replay;
  std::size_t instants = 0;
  do {
    ++instants;
    replay.read(run.text());
    std::map<Point_id, Polynomial_disc_motion_2> expected;
    const auto& triangulation = run.simulation().triangulation();
    for (Point_id id = 0; id < triangulation.next_id(); ++id) {
      if (triangulation.contains(id)) expected[id] = general(triangulation.motion(id));
    }
    ASSERT_EQ(replay.motions(), expected) << "at instant " << instants;
  } while (run.simulation().step(until) > 0);
  EXPECT_GT(instants, 50U);
}

TEST(Motion_log, tells_the_motions_of_discs_that_collide) {
  for (const auto response :
       {collide_elastically, swap_velocities, stop_both, erase_both, log_contact}) {
    Logged_points run(test::discs_in_a_box(25, 2, 1), test::discs({-5, -5, 45, 45}, 2, response));
    expect_true_log(run, 8);
  }
}

TEST(Motion_log, tells_the_motions_of_discs_that_grow_and_of_changes) {
  std::vector<Disc_motion_2> motions;
  for (const Linear_motion_2& motion : test::discs_in_a_box(25, 2, 2)) {
    motions.push_back({motion, motions.size() % 3 == 0 ? 2.0 : 1.0, 0.0625});
  }
  Simulation_options options = test::in_box({-5, -5, 45, 45});
  options.rim_touches = true;
  options.response = collide_elastically;
  Logged_discs run(motions, options);
  run.simulation().schedule_erase(0.5, 3);
  run.simulation().schedule_erase(1.0, 4);
  run.simulation().schedule_insert(1.5, {{{20, 0}, {1, 1}, 1.5}, 0.125, 0});
  expect_true_log(run, 6);
}

}  // namespace
}  // namespace kinetri::motion_log_test
