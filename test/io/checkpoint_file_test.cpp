// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checkpoint files: a run that is broken off and taken up again gives the same bytes as one without
// a break, and a file that is damaged, foreign or made up is refused.
#include "kinetri/io/checkpoint_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/simulation/scenarios.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/broken_runs.h"
#include "support/disc_runs.h"
#include "support/motions.h"
#include "support/temporary_directory.h"

namespace kinetri::checkpoint_file_test {
namespace {

using test::checkpoint_of;
using test::expect_refusal;
using test::refusal;
using test::signed_anew;
using test::Simulation;
using test::text_of;

// ---- a run with breaks ----

using Case = test::Start<Linear_kinetic_traits_2>;

// Every kind of input in turn: tiny grids, the scenarios, and discs in a box.
Case make_case(unsigned seed) {
  const auto number = static_cast<std::size_t>(seed / 3);
  switch (seed % 3) {
    case 0:
      return {test::grid_motions(8 + number % 5, 3 + seed % 4, 1 + seed % 2, seed), {}, {}};
    case 1: {
      Scenario_options options;
      options.points = 30;
      options.seed = seed;
      return {make_scenario(all_scenarios[number % all_scenarios.size()], options), {}, {}};
    }
    default: {
      Case result = {test::discs_in_a_box(16, 0.2, seed), {}, {}};
      result.options.box = test::box_of(16);
      result.options.radius = 1.5;
      result.options.max_contacts_per_instant = 1000;
      result.options.rim_touches = seed % 2 == 0;
      result.options.response = named_responses[number % named_responses.size()].response;
      if (number % 4 == 3) {  // many contacts at one time
        for (Linear_motion_2& m : result.motions) {
          m.position = {std::round(m.position.x), std::round(m.position.y)};
          m.velocity = {std::round(m.velocity.x), std::round(m.velocity.y)};
        }
      }
      return result;
    }
  }
}

TEST(Checkpoint, a_run_with_breaks_is_the_run_without) {
  test::Broken_runs sums;
  for (unsigned seed = 0; seed < test::cases(30u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::expect_the_run_without_breaks(make_case(seed), seed, sums);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(sums.irrational_breaks, 30);
  EXPECT_GT(sums.bytes, 50'000u);
}

// ---- numbers ----

TEST(Checkpoint, numbers_read_back_exactly) {
  constexpr double smallest = std::numeric_limits<double>::denorm_min();
  Simulation simulation({{{-0.0, 0.1}, {smallest, -1e-300}, 0.3},
                         {{1e100, 1.0 / 3}, {0, -0.0}, -7},
                         {{0, -0x1.fffffffffffffp+900}, {12345678901234567.0, 2}, 0}},
                        {}, Algebraic_number(Rational(-1, 3)));
  simulation.schedule_erase(Algebraic_number(0.1), 2);
  const std::vector<Checkpoint_log> logs = {
      {"events", "\"odd\" \n name \u00e4", std::numeric_limits<std::uint64_t>::max(), 0xFFFFFFFF},
      {"", "/", 0, 0}};
  const Checkpoint read =
      checkpoint_of(text_of({simulation.snapshot(), "\"odd\" \n name \u00e4", logs}));
  EXPECT_EQ(read.response, "\"odd\" \n name \u00e4");
  EXPECT_EQ(read.logs, logs);
  EXPECT_EQ(std::get<0>(read.simulation).triangulation.time, Algebraic_number(Rational(-1, 3)));
  for (Point_id id = 0; id < 3; ++id) {
    EXPECT_EQ(std::get<0>(read.simulation).triangulation.motions[id],
              simulation.triangulation().motion(id));
  }
  EXPECT_TRUE(std::signbit(std::get<0>(read.simulation).triangulation.motions[0]->position.x));
  EXPECT_TRUE(std::signbit(std::get<0>(read.simulation).triangulation.motions[1]->velocity.y));
  ASSERT_EQ(std::get<0>(read.simulation).scheduled.size(), 1u);
  EXPECT_EQ(std::get<0>(read.simulation).scheduled[0].time, Algebraic_number(0.1));
}

TEST(Checkpoint, read_and_written_again_is_the_same_text) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    Case start = make_case(seed);
    Simulation simulation(start.motions, start.options);
    for (int i = 0; i < 20; ++i) simulation.step();
    const std::string text = text_of({simulation.snapshot(), "none"});
    const Checkpoint read = checkpoint_of(text);
    EXPECT_EQ(text_of(read), text);
    // Those of what happened.
    Triangulation_counters counters = simulation.triangulation().counters();
    counters.discarded = {};
    counters.rechecks = 0;
    EXPECT_EQ(std::get<0>(read.simulation).triangulation.counters, counters);
    EXPECT_EQ(std::get<0>(read.simulation).counters.most_at_one_time,
              simulation.contact_counters().most_at_one_time);
  }
}

TEST(Checkpoint, of_few_points_is_read_back) {
  for (std::size_t points = 0; points < 4; ++points) {
    std::vector<Linear_motion_2> motions;
    for (std::size_t i = 0; i < points; ++i) motions.push_back({{double(i), 0}, {0, double(i)}, 0});
    Simulation simulation(motions, {});
    auto restored = Simulation::restore(
        std::get<0>(checkpoint_of(text_of({simulation.snapshot(), "none"})).simulation), nullptr);
    EXPECT_EQ(restored.triangulation().finite_edge_ids(),
              simulation.triangulation().finite_edge_ids());
    restored.insert({{9, 8}, {7, 6}, 0});
    EXPECT_TRUE(restored.audit(Audit_level::certificates).passed());
  }
}

// A snapshot as such: that it is no state of a simulation makes no difference here.
TEST(Checkpoint, holds_discs) {
  Simulation_snapshot<Disc_kinetic_traits_2> snapshot;
  snapshot.triangulation.motions = {Disc_motion_2{{{1, 2}, {3, -0.0}, 0.1}, 0.3, -0.0, 0},
                                    std::nullopt, Disc_motion_2{{}, 0, 0, -5e-324}};
  snapshot.options.masses = {0.1, 1, 1e300};
  snapshot.options.refuses_overlaps = true;
  snapshot.scheduled.push_back({Algebraic_number(7.0), Event_kind::insert, 3,
                                Disc_motion_2{{{4, 5}, {6, 7}, 8}, 9, 10, 11}});
  const std::string text = text_of({snapshot, "elastic"});
  const Checkpoint checkpoint = checkpoint_of(text);
  const auto& read = std::get<Simulation_snapshot<Disc_kinetic_traits_2>>(checkpoint.simulation);
  EXPECT_EQ(read.triangulation.motions, snapshot.triangulation.motions);
  EXPECT_TRUE(std::signbit(read.triangulation.motions[0]->growth));
  EXPECT_EQ(read.options.masses, snapshot.options.masses);
  EXPECT_TRUE(read.options.refuses_overlaps);
  ASSERT_EQ(read.scheduled.size(), 1u);
  EXPECT_EQ(read.scheduled[0].motion, snapshot.scheduled[0].motion);
  EXPECT_EQ(text_of(checkpoint), text);
}

TEST(Checkpoint, holds_discs_that_accelerate) {
  using Traits = Polynomial_disc_kinetic_traits_2;
  Simulation_snapshot<Traits> snapshot;
  snapshot.triangulation.motions = {
      Polynomial_disc_motion_2{{{1, 2}, {3, 4}, {5, 6}, {7, 8}, 9}, 10, 11, 12}};
  const Checkpoint checkpoint = checkpoint_of(text_of({snapshot, "none"}));
  const auto& read = std::get<Simulation_snapshot<Traits>>(checkpoint.simulation);
  EXPECT_EQ(read.triangulation.motions, snapshot.triangulation.motions);
}

// ---- damage ----

class Damaged_checkpoint : public testing::Test {
 protected:
  Damaged_checkpoint() {
    Case start = make_case(2);
    Simulation simulation(start.motions, start.options);
    for (int i = 0; i < 20; ++i) simulation.step();
    simulation.schedule_motion(Algebraic_number(1000.0), 3, {{1, 2}, {3, 4}, 0});
    text = text_of({simulation.snapshot(), "log", {{"events", "e.csv", 5, 0x0123abcd}}});
    response = start.options.response;
  }

  std::string text;
  Collision_response response;
};

TEST_F(Damaged_checkpoint, with_any_byte_changed_is_refused) {
  std::mt19937_64 random(1);
  ASSERT_EQ(refusal(text), "");
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(static_cast<unsigned char>(text[i]) ^ (1 + random() % 255));
    ASSERT_NE(refusal(damaged), "") << "byte " << i;
  }
}

TEST_F(Damaged_checkpoint, cut_off_anywhere_is_refused) {
  for (std::size_t size = 0; size < text.size(); ++size) {
    ASSERT_NE(refusal(text.substr(0, size)), "") << size << " bytes";
  }
  for (std::size_t end = text.find('\n'); end + 1 < text.size(); end = text.find('\n', end + 1)) {
    expect_refusal(text.substr(0, end + 1), "is cut short");
  }
}

TEST_F(Damaged_checkpoint, says_what_is_wrong) {
  expect_refusal("", "is empty;");
  expect_refusal("x,y,vx,vy\n1,2,3,4\n", "is no checkpoint: it begins with 'x,y,vx,vy';");
  expect_refusal(std::string(100, '\0'), "is no checkpoint:");
  expect_refusal("kinetri checkpoint 2\n{}\n",
                 "is a checkpoint of version '2'; expected version 8");
  expect_refusal(text + "\n", "is cut short, or has more");
  std::string damaged = text;
  damaged[text.size() / 2] ^= 1;
  expect_refusal(damaged, "is damaged: its checksum");
  test::Temporary_directory directory;
  EXPECT_THROW(read_checkpoint_file(directory.file("missing")), Input_error);
  EXPECT_THROW(read_checkpoint_file(directory.path()), Input_error);
}

TEST(Checkpoint_file, that_cannot_be_written_leaves_the_old_one) {
  test::Temporary_directory directory;
  const Simulation simulation({}, {});
  EXPECT_THROW(write_checkpoint_file(directory.file("no/run"), {simulation.snapshot(), "none"}),
               Output_error);
  test::write_file(directory.file("run"), "before");
  write_checkpoint_file(directory.file("run"), {simulation.snapshot(), "none"});
  EXPECT_NO_THROW(read_checkpoint_file(directory.file("run")));
  EXPECT_EQ(directory.entries(), std::vector<std::string>{"run"});
}

// ---- forgery ----

using Forged_checkpoint = Damaged_checkpoint;

TEST_F(Forged_checkpoint, names_the_place_that_is_wrong) {
  const auto forged = [this](const std::string& old, const std::string& text_instead) {
    return test::forged(text, old, text_instead);
  };
  EXPECT_EQ(signed_anew(text), text);
  expect_refusal(forged("\"motion\":\"linear\"", "\"motion\":\"wild\""),
                 "state.motion is 'wild'; expected one of 'linear', 'polynomial', 'disc', "
                 "'polynomial disc'");
  expect_refusal(forged("\"motion\":\"linear\"", "\"motion\":\"disc\""),
                 "state.points[0] has 5 numbers; expected x, y, vx, vy, epoch, radius, growth and "
                 "weight");
  expect_refusal(forged("\"masses\":[", "\"masses\":[true"), "state.masses[0] is no number;");
  expect_refusal(forged("\"refuses_overlaps\":false", "\"refuses_overlaps\":0"),
                 "state.refuses_overlaps is neither true nor false;");
  expect_refusal(forged("\"radius\":1.5", "\"radius\":\"1.5\""), "state.radius is no number;");
  expect_refusal(forged("\"radius\":1.5", "\"radius\":1e999"), "is no JSON");
  expect_refusal(forged("\"radius\":1.5", "\"Radius\":1.5"),
                 "state has no member \"radius\"; expected one");
  expect_refusal(forged("\"rim_touches\":true", "\"rim_touches\":1"),
                 "state.rim_touches is neither true nor false;");
  expect_refusal(forged("\"box\":[", "\"box\":[1.0,"), "state.box has 5 elements; expected 4");
  expect_refusal(forged("\"points\":[\n[", "\"points\":[\n[1.0,"),
                 "state.points[0] has 6 numbers; expected x, y, vx, vy and epoch");
  expect_refusal(forged("\"kind\":\"trajectory\"", "\"kind\":\"flip\""),
                 "state.scheduled[0].kind is no change of a point;");
  for (const char* crc32 :
       {"123abcd", "00123abcd", "0123ABCD", "0123abcg", "0x23abcd", "", "-123abcd"}) {
    expect_refusal(forged("\"crc32\":\"0123abcd\"", joined("\"crc32\":\"", crc32, '"')),
                   "state.logs[0].crc32 is no checksum; expected eight hexadecimal digits");
  }
  expect_refusal(forged("\"bytes\":5", "\"bytes\":-5"), "state.logs[0].bytes is no whole number");
  expect_refusal(forged("\"logs\":[", "\"logs\":[0,"), "state.logs[0] is no object;");
  for (const char* time : {"\"\"", "\"-\"", "\"1.5\"", "\"1/0\"", "\"1/-2\"", "\"010\"", "\"1/\"",
                           "\"0x10\"", "\" 1\"", "\"1/2/3\""}) {
    expect_refusal(forged("\"time\":\"1000\"", std::string("\"time\":") + time),
                   "state.scheduled[0].time is no fraction;");
  }
  const auto root = [](const std::string& polynomial, const std::string& ends) {
    return "\"time\":{\"root_of\":" + polynomial + ",\"between\":" + ends + "}";
  };
  const std::string old = "\"time\":\"1000\"";
  EXPECT_EQ(refusal(forged(old, root("[\"-2000000\",\"0\",\"1\"]", "[\"1000\",\"2000\"]"))), "");
  for (const std::string& wrong :
       {root("[\"-2\",\"0\",\"1\"]", "[\"2\",\"3\"]"), root("[]", "[\"0\",\"1\"]"),
        root("[\"-2\",\"0\",\"1\"]", "[\"2\",\"1\"]"), root("[\"5\"]", "[\"0\",\"1\"]"),
        root("[\"-1\",\"3\",\"-3\",\"1\"]", "[\"0\",\"2\"]"),     // a triple root
        root("[\"0\",\"-1\",\"0\",\"1\"]", "[\"-2\",\"2\"]")}) {  // three roots
    expect_refusal(forged(old, wrong), "state.scheduled[0].time is no root;");
  }
}

// With a right checksum anything may stand in a file. It is refused, or makes a simulation that is
// right: a number of another point, a counter.
TEST_F(Forged_checkpoint, changed_at_random_is_refused_or_right) {
  int refused = 0;
  int right = 0;
  for (unsigned seed = 0; seed < test::cases(450u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    try {
      auto restored = test::restored<Linear_kinetic_traits_2>(
          checkpoint_of(test::forged_at_random(text, random)), response);
      ASSERT_TRUE(restored.audit(Audit_level::certificates).passed());
      ++right;
      restored.step();
    } catch (const Input_error&) {
      ++refused;
    } catch (const Snapshot_error&) {
      ++refused;
    } catch (const Endless_contacts_error&) {
      // Discs that were put on top of each other.
    }
  }
  EXPECT_GT(refused, 300);
  EXPECT_GT(right, 30);
}

}  // namespace
}  // namespace kinetri::checkpoint_file_test
