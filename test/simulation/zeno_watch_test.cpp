// SPDX-License-Identifier: GPL-3.0-or-later
//
// Contacts that accumulate: by formulas for their times, and in simulations.
#include "simulation/zeno_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/simulation/simulation_2.h"
#include "support/message_of.h"

namespace kinetri::zeno_watch_test {
namespace {

using detail::Zeno_watch;

/// What the watch finds in contacts of two points, the k-th of which is at time_of(k).
template <class Time_of>
std::optional<Zeno_watch::Accumulation> find(const Time_of& time_of, std::uint64_t number) {
  Zeno_watch watch;
  for (std::uint64_t k = 1; k <= number; ++k) {
    if (!watch.count()) continue;
    if (const auto found = watch.look(time_of(static_cast<double>(k)), 2)) return found;
  }
  return std::nullopt;
}

TEST(Zeno_watch, finds_where_times_accumulate) {
  for (const double power : {0.5, 1.0, 2.0}) {
    SCOPED_TRACE(power);
    const auto found = find([&](double k) { return 3 - 2 * std::pow(k, -power); }, 1'000'000);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->point, 3, 2 * std::pow(1000, -power));
    EXPECT_GT(found->rate, 200 * found->rate_before);
  }
  // After many contacts at an equal rate.
  const auto later =
      find([](double k) { return k < 5e5 ? k : 5e5 + 1e4 * (1 - 1 / (1 + (k - 5e5) / 1e4)); },
           2'000'000);
  ASSERT_TRUE(later);
  EXPECT_NEAR(later->point, 5.1e5, 1e3);
}

TEST(Zeno_watch, is_not_alarmed_by_times_that_go_on) {
  constexpr std::uint64_t number = 3'000'000;
  EXPECT_FALSE(find([](double k) { return k; }, number));
  EXPECT_FALSE(find([](double k) { return std::sqrt(k); }, number));
  EXPECT_FALSE(find([](double k) { return std::log(k); }, number));
  EXPECT_FALSE(find([](double /*k*/) { return 2.0; }, number));
  // Bursts.
  EXPECT_FALSE(find([](double k) { return std::floor(k / 70'000) + 1e-9 * k; }, number));
  // A rate that rises a hundredfold and falls again.
  EXPECT_FALSE(
      find([](double k) { return k + 1e5 * 0.99 / 3.2 * std::sin(k * 3.2 / 1e5); }, number));
}

// Two discs between walls that have no free area left at t = 2.
TEST(Zeno, of_jammed_discs_ends_the_run) {
  Simulation_options options;
  options.box = Box_2{0, 0, 8, 8};
  options.rim_touches = true;
  options.response = swap_velocities;
  Simulation_2<Disc_kinetic_traits_2> simulation(
      {{{{2, 4}, {1, 0}}, 1, 0.5, 0}, {{{6, 4}, {-1, 0}}, 1, 0.5, 0}}, options);
  simulation.advance_to(1.9);
  const std::string message =
      test::message_of<Endless_contacts_error>([&] { simulation.advance_to(5.0); });
  EXPECT_TRUE(message.starts_with("contacts without end before about t = ")) << message;
  const double time = simulation.current_time().to_double();
  EXPECT_GT(time, 1.9);
  EXPECT_LT(time, 2.001);
  EXPECT_TRUE(simulation.audit(Audit_level::certificates).passed());
  // It can go on, and meets more of them.
  EXPECT_THROW(simulation.advance_to(5.0), Endless_contacts_error);
  EXPECT_GT(simulation.current_time().to_double(), time);
}

// Discs in a sheared box with little room, whose exchanges of velocities add energy.
TEST(Zeno, of_discs_in_a_sheared_box_ends_the_run) {
  Simulation_options options;
  options.radius = 1.49;
  options.response = swap_velocities;
  Simulation_2<Periodic_kinetic_traits_2> simulation(
      {{{3, 0}, {0, 2}}, {{0, 0}, {0, 0}}}, options, 0,
      Periodic_kinetic_traits_2(Periodic_box_2({{6, 0}, {0, 0}}, {{0, 3}, {3, 0}})));
  EXPECT_GT(simulation.advance_to(0.4), 0U);
  const std::string message =
      test::message_of<Endless_contacts_error>([&] { simulation.advance_to(6.0); });
  EXPECT_TRUE(message.starts_with("contacts without end before about t = 0.4035")) << message;
  EXPECT_LT(simulation.current_time().to_double(), 0.40352);
}

}  // namespace
}  // namespace kinetri::zeno_watch_test
