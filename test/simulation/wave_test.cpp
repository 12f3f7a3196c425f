// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/simulation/wave.h"

#include <gtest/gtest.h>

#include <set>

#include "kinetri/base/error.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/precondition_error.h"

namespace kinetri::wave_test {
namespace {

// The rows, counted from below, in which points move.
template <class Simulation>
std::multiset<std::size_t> moving_rows(const Simulation& simulation, std::size_t columns) {
  std::multiset<std::size_t> result;
  const auto& triangulation = simulation.triangulation();
  for (Point_id id = 0; id < triangulation.next_id(); ++id) {
    if (triangulation.motion(id).velocity != Vector_2{}) result.insert(id / columns);
  }
  return result;
}

TEST(Wave, runs_from_row_to_row_and_back) {
  Wave_setting setting;
  setting.columns = 5;
  setting.rows = 4;
  setting.spacing = 8;
  setting.speed = 8;
  setting.diameter = 1;
  Simulation_2<> simulation(wave_motions(setting), wave_options(setting));
  const auto all_of_row = [](std::size_t row) {
    return std::multiset<std::size_t>{row, row, row, row, row};
  };
  // From one row to the next it is 8 - 1; from the last one to the wall 4, and 4 back to where the
  // row below stands 1 away.
  EXPECT_EQ(moving_rows(simulation, 5), all_of_row(0));
  const struct {
    double way;
    std::size_t row;
  } stages[] = {{6.5, 0}, {7.5, 1}, {14.5, 2}, {21.5, 3}, {24.5, 3}, {29.5, 2}};
  for (const auto& [way, row] : stages) {
    simulation.advance_to(way / 8);
    EXPECT_EQ(moving_rows(simulation, 5), all_of_row(row)) << "after a way of " << way;
    EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  }
  // All contacts of one row happen at one exact time.
  EXPECT_EQ(simulation.contact_counters().most_at_one_time, 5u);
  simulation.advance_to(20.0);
  EXPECT_EQ(moving_rows(simulation, 5).size(), 5u);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

// From one row to the next it is 8 - 2: a point of the radius 0.5 beside one of 1.5.
TEST(Wave, of_two_sizes_runs_from_row_to_row) {
  Wave_setting setting;
  setting.columns = 5;
  setting.rows = 4;
  setting.spacing = 8;
  setting.speed = 8;
  setting.diameter = 1;
  setting.size_ratio = 3;
  const auto discs = wave_discs(setting);
  EXPECT_EQ(discs[0].radius, 0.5);
  EXPECT_EQ(discs[1].radius, 1.5);
  EXPECT_EQ(discs[5].radius, 1.5);
  EXPECT_EQ(discs[6].radius, 0.5);
  Simulation_2<Disc_kinetic_traits_2> simulation(discs, wave_options(setting));
  for (std::size_t row = 0; row < 4; ++row) {
    simulation.advance_to((6 * static_cast<double>(row) + 1) / 8);
    EXPECT_EQ(moving_rows(simulation, 5), (std::multiset<std::size_t>{row, row, row, row, row}));
    EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  }
  simulation.advance_to(20.0);
  EXPECT_EQ(moving_rows(simulation, 5).size(), 5u);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Wave, with_jitter_moves_one_point_of_each_column) {
  Wave_setting setting;
  setting.columns = 6;
  setting.rows = 5;
  setting.jitter = 3;
  setting.seed = 7;
  const auto motions = wave_motions(setting);
  ASSERT_EQ(motions.size(), 30u);
  std::set<double> offsets;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    EXPECT_EQ(motions[i].position.x, 10.0 * static_cast<double>(i % 6));
    const double offset = motions[i].position.y - 10.0 * static_cast<double>(i / 6);
    EXPECT_TRUE(offset >= -3 && offset <= 3) << offset;
    offsets.insert(offset);
  }
  EXPECT_GT(offsets.size(), 25u);
  EXPECT_EQ(motions, wave_motions(setting));
  setting.seed = 8;
  EXPECT_NE(motions, wave_motions(setting));

  Simulation_2<> simulation(motions, wave_options(setting));
  for (double t = 1; t <= 12; ++t) {
    simulation.advance_to(t);
    std::set<std::size_t> columns;
    for (Point_id id = 0; id < 30; ++id) {
      if (simulation.triangulation().motion(id).velocity != Vector_2{}) columns.insert(id % 6);
    }
    EXPECT_EQ(columns.size(), 6u) << "t = " << t;
  }
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
}

TEST(Wave, refuses_what_is_no_lattice) {
  const auto refused = [](const char* message, auto change) {
    Wave_setting setting;
    change(setting);
    EXPECT_PRECONDITION_ERROR(wave_motions(setting), message);
    EXPECT_PRECONDITION_ERROR(wave_options(setting), message);
  };
  const char* const none = "a wave without points; expected 1 row and 1 column or more";
  refused(none, [](Wave_setting& s) { s.columns = 0; });
  refused(none, [](Wave_setting& s) { s.rows = 0; });
  refused("a wave of too many points; expected fewer than 2^32 - 1",
          [](Wave_setting& s) { s.columns = s.rows = std::size_t{1} << 33; });
  const char* const size =
      "spacing, speed or diameter of a wave out of range; expected numbers from 1e-100 to 1e100, "
      "and a diameter less than the spacing";
  refused(size, [](Wave_setting& s) { s.spacing = 0; });
  refused(size, [](Wave_setting& s) { s.speed = 1e200; });
  refused(size, [](Wave_setting& s) { s.diameter = s.spacing; });
  refused(size, [](Wave_setting& s) { s.size_ratio = 0.5; });
  refused(size, [](Wave_setting& s) { s.size_ratio = s.spacing / s.diameter; });
  const char* const jitter =
      "the jitter of a wave is out of range; expected 0, or a number from 1e-100 on and less than "
      "half of the room between neighbors";
  refused(jitter, [](Wave_setting& s) { s.jitter = -1; });
  refused(jitter, [](Wave_setting& s) { s.jitter = 5; });
  refused(jitter, [](Wave_setting& s) {
    s.size_ratio = 10;
    s.jitter = 4.5;
  });
}

}  // namespace
}  // namespace kinetri::wave_test
