// SPDX-License-Identifier: GPL-3.0-or-later
//
// Discs that pass through each other: what is known of them after each step, and what several
// threads make of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/contact_region_runs.h"
#include "support/multiplier.h"

namespace kinetri::passing_discs_test {
namespace {

// Many events at one time: a step executes all of them, those of discs whose edge comes at that
// time too, if nothing was in the queue before; and discs that only touch are no reason to watch
// others.
TEST(Passing_discs, on_a_grid_are_known_after_each_step) {
  for (const auto& [seed, end] :
       {std::pair(65u, Rational(1, 2)), {178u, Rational(2, 5)}, {163u, Rational(2)}}) {
    Simulation_options options;
    if (seed % 3 != 1) options.box = Box_2{-1, -1, 20, 20};
    options.radius = seed % 3 == 1 ? 1 : 2.5;
    options.response = log_contact;
    Simulation_2<Linear_kinetic_traits_2> simulation(
        test::on_lattice(5 + seed % 40, 5 + seed % 3, seed), options);
    const Algebraic_number until(end);
    std::optional<Algebraic_number> last;
    while (simulation.step(until) > 0) {
      ASSERT_TRUE(!last || *last < simulation.current_time()) << "seed " << seed;
      last = simulation.current_time();
      ASSERT_EQ(simulation.audit(Audit_level::certificates).failures, std::vector<std::string>())
          << "seed " << seed << " at t = " << simulation.current_time();
    }
    ASSERT_EQ(last, until) << "seed " << seed;
  }
}

// The plain loop runs, whatever the number of threads, and also where the response is said to be
// pure.
TEST(Passing_discs, are_for_one_thread) {
  detail::Region_counters sum;
  for (unsigned seed = 0; seed < test::cases(4u); ++seed) {
    const std::size_t n = 30 + 17 * (seed % 30);
    const double side = 10 * std::sqrt(static_cast<double>(n));
    Simulation_options options;
    if (seed % 4 != 3) options = test::in_square(side);
    options.radius = std::array{1.2, 4.0, 9.0}[seed % 3];
    options.response = log_contact;
    options.response_is_pure = seed % 2 == 0;
    const double apart = seed % 2 == 0 ? 2 * std::min(options.radius, 4.0) : 0;
    ASSERT_EQ(
        test::difference_from_loop(test::gas(n, side, apart, 10, seed), options, {0.5, 1.5},
                                   test::options_of(1 + seed * 7 % 64, 0.1 * (1 + seed % 9)), sum),
        "")
        << "seed " << seed;
  }
  EXPECT_EQ(sum.windows, 0u);
}

}  // namespace
}  // namespace kinetri::passing_discs_test
