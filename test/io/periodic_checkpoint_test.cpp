// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checkpoint files of simulations in periodic boxes: a run that is broken off and taken up again
// gives the same bytes as one without a break, and a file with another box, or none, is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/io/checkpoint_file.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/broken_runs.h"
#include "support/multiplier.h"
#include "support/periodic_contacts.h"
#include "support/precondition_error.h"

namespace kinetri::periodic_checkpoint_test {
namespace {

using test::checkpoint_of;
using test::expect_refusal;
using test::forged;
using test::text_of;

using Points = Periodic_kinetic_traits_2;
using Discs = Periodic_disc_kinetic_traits_2;

// In eighths, in the box of side 8 or outside of it.
Linear_motion_2 some_point(std::mt19937_64& random, bool is_whole) {
  const auto number = [&](int least, int greatest) {
    const double unit = is_whole ? 1 : 8;
    std::uniform_int_distribution<int> some(least * static_cast<int>(unit),
                                            greatest * static_cast<int>(unit));
    return some(random) / unit;
  };
  const double x = number(-8, 16);
  const double y = number(-8, 16);
  const double vx = number(-3, 3);
  return {{x, y}, {vx, number(-3, 3)}, 0};
}

// None, or one of those with a name.
Simulation_options options_of(unsigned seed) {
  Simulation_options result;
  result.response = named_responses[seed / 6 % named_responses.size()].response;
  result.max_contacts_per_instant = 1000;
  return result;
}

// In each of the boxes in turn: points that touch nothing, images of others among them, and discs.
test::Start<Points> start_of_points(unsigned seed) {
  std::mt19937_64 random(seed);
  test::Start<Points> result{{}, options_of(seed), Points(test::boxes()[seed % 6].box)};
  result.options.radius = result.options.response ? 0.5 : 0;
  for (unsigned i = 0; i < 2 + seed % 7; ++i) {
    result.motions.push_back(some_point(random, seed % 4 == 3));
  }
  if (!result.options.response) result.motions.push_back(result.motions.front());
  return result;
}

// Of several sizes; some grow.
test::Start<Discs> start_of_discs(unsigned seed) {
  std::mt19937_64 random(seed);
  test::Start<Discs> result{{}, options_of(seed), Discs(test::boxes()[seed % 6].box)};
  for (unsigned i = 0; i < 2 + seed % 7; ++i) {
    const double radius = static_cast<double>(random() % 8) / 8;
    const double growth = random() % 4 == 0 ? 0.03125 : 0;
    result.motions.push_back({some_point(random, seed % 4 == 3), radius, growth, 0});
    result.options.masses.push_back(0.5 + radius);
  }
  return result;
}

template <class Traits>
void expect_the_runs_without_breaks(test::Start<Traits> (*start)(unsigned),
                                    test::Broken_runs& sums) {
  for (unsigned seed = 0; seed < test::cases(72u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    try {
      test::expect_the_run_without_breaks(start(seed), seed, sums);
    } catch (const Coincident_trajectories_error&) {  // two of the motions are equal
    }
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Periodic_checkpoint, a_run_of_points_with_breaks_is_the_run_without) {
  test::Broken_runs sums;
  expect_the_runs_without_breaks(start_of_points, sums);
  EXPECT_GT(sums.irrational_breaks, 30);
  EXPECT_GT(sums.bytes, 50'000u);
}

TEST(Periodic_checkpoint, a_run_of_discs_with_breaks_is_the_run_without) {
  test::Broken_runs sums;
  expect_the_runs_without_breaks(start_of_discs, sums);
  EXPECT_GT(sums.irrational_breaks, 30);
  EXPECT_GT(sums.bytes, 50'000u);
}

// Vectors with different epochs, a contact with an image, and a change that is to come.
Checkpoint some_checkpoint(std::int32_t offset = -2) {
  Simulation_snapshot<Points> snapshot;
  snapshot.triangulation.time = 0.5;
  snapshot.triangulation.motions = {Linear_motion_2{{1, 2}, {3, -0.0}, 0.1}, std::nullopt,
                                    Linear_motion_2{{0.5, 3}, {0, 0}, 0}};
  snapshot.options.radius = 0.125;
  snapshot.has_response = true;
  snapshot.in_contact = {{{0, 2}, {offset, 3}}};
  snapshot.scheduled.push_back({Algebraic_number(7.0), Event_kind::erase, 2, std::nullopt});
  Checkpoint result{snapshot, "log"};
  result.periodic_box.emplace(Linear_motion_2{{8, 0.1}, {1e-300, 0}, 0.25},
                              Linear_motion_2{{-1, 7}, {1.0 / 3, 0}, -1});
  return result;
}

TEST(Periodic_checkpoint, numbers_read_back_exactly) {
  for (const std::int32_t offset : {-2, 0, std::numeric_limits<std::int32_t>::max()}) {
    const Checkpoint checkpoint = some_checkpoint(offset);
    const std::string text = text_of(checkpoint);
    const Checkpoint read = checkpoint_of(text);
    EXPECT_EQ(read.periodic_box, checkpoint.periodic_box);
    const auto& snapshot = std::get<Simulation_snapshot<Points>>(read.simulation);
    EXPECT_EQ(snapshot.in_contact, (std::vector<Periodic_edge>{{{0, 2}, {offset, 3}}}));
    EXPECT_EQ(text_of(read), text);
  }
}

TEST(Periodic_checkpoint, names_what_is_wrong) {
  const std::string text = text_of(some_checkpoint());
  const std::string box =
      "\"periodic_box\":[[8.0,0.1,1e-300,0.0,0.25],"
      "[-1.0,7.0,0.3333333333333333,0.0,-1.0]]";
  ASSERT_NE(text.find(box), std::string::npos) << text;
  const auto with_box = [&](const std::string& other) {
    return forged(text, box, "\"periodic_box\":" + other);
  };
  expect_refusal(with_box("[[8.0,0.0,0.0,0.0,0.0]]"),
                 "state.periodic_box has 1 elements; expected 2");
  expect_refusal(with_box("[8.0,7.0]"), "state.periodic_box[0] is no list;");
  expect_refusal(with_box("[[8.0,0.0,0.0,0.0,0.0],[0.0,8.0,0.0,0.0]]"),
                 "state.periodic_box[1] has 4 numbers; expected x, y, vx, vy and epoch");
  expect_refusal(with_box("[[8.0,0.0,0.0,0.0,0.0],[8.0,0.0,0.0,0.0,0.0]]"),
                 "state.periodic_box cannot be used: the periodic box has no area at time 0");
  expect_refusal(with_box("[[8.0,0.0,0.0,0.0,0.0],[0.0,0.5,0.0,-1.0,0.0]]"),
                 "state.periodic_box cannot be used: the periodic box has no area at time 0.5");
  EXPECT_EQ(
      test::refusal(with_box("[[8.0,0.0,0.0,0.0,0.0],[0.0,0.25,0.0,-1.0,0.0]]")),
      "run.kinetri: state.periodic_box cannot be used: the periodic box has a negative area at "
      "time 0.5; the second lattice vector is to the right of the first: swap the two");
  expect_refusal(with_box("[null,null]"), "state.periodic_box[0] is no list;");
  // A contact with an image is none in the plane, and the other way round.
  expect_refusal(with_box("null"), "state.in_contact[0] has 4 elements; expected 2");
  expect_refusal(forged(text, "[0,2,-2,3]", "[0,2]"),
                 "state.in_contact[0] has 2 elements; expected 4");
  expect_refusal(forged(text, "[0,2,-2,3]", "[0,2,-2147483648,3]"),
                 "state.in_contact[0][2] is no whole number from -2147483647 to 2147483647;");
  expect_refusal(
      forged(text, "\"motion\":\"linear\"", "\"motion\":\"polynomial\""),
      "state.motion is 'polynomial'; expected one of 'linear', 'disc' in a periodic box");
}

TEST(Periodic_checkpoint, of_a_point_too_far_away_is_refused_when_it_is_restored) {
  const std::string text = forged(text_of(some_checkpoint()), "[1.0,2.0,", "[1e300,2.0,");
  EXPECT_THROW(test::restored<Points>(checkpoint_of(text), log_contact), Periodic_box_error);
}

TEST(Periodic_checkpoint, has_a_box_if_and_only_if_the_simulation_is_in_one) {
  const char* const message =
      "a checkpoint with a periodic box of a simulation in the plane, or without one of a "
      "simulation in a periodic box; set both or none";
  Checkpoint checkpoint = some_checkpoint();
  checkpoint.periodic_box.reset();
  EXPECT_PRECONDITION_ERROR(text_of(checkpoint), message);
  checkpoint = some_checkpoint();
  checkpoint.simulation = Simulation_snapshot<Linear_kinetic_traits_2>();
  EXPECT_PRECONDITION_ERROR(text_of(checkpoint), message);
}

// With a right checksum anything may stand in a file. It is refused, or makes a simulation that is
// right.
TEST(Periodic_checkpoint, changed_at_random_is_refused_or_right) {
  test::Start<Discs> start = start_of_discs(2);
  start.options.response = collide_elastically;
  Simulation_2<Discs> simulation(start.motions, start.options, 0, start.traits);
  for (int i = 0; i < 20; ++i) simulation.step();
  const std::string text = text_of(checkpoint_of(simulation, "elastic"));
  int refused = 0;
  int right = 0;
  for (unsigned seed = 0; seed < test::cases(600u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    try {
      auto restored = test::restored<Discs>(checkpoint_of(test::forged_at_random(text, random)),
                                            collide_elastically);
      ASSERT_TRUE(restored.audit(Audit_level::certificates).passed());
      ++right;
      restored.step();
    } catch (const Input_error&) {
      ++refused;
    } catch (const Snapshot_error&) {
      ++refused;
    } catch (const Periodic_box_error&) {  // a point far away
      ++refused;
    } catch (const Contact_error&) {  // discs on top of each other, or one too large for the box
    }
  }
  EXPECT_GT(refused, 200);
  EXPECT_GT(right, 20);
}

}  // namespace
}  // namespace kinetri::periodic_checkpoint_test
