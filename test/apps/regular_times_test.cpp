// SPDX-License-Identifier: GPL-3.0-or-later
//
// Regular times are those of exact arithmetic, rounded once.
#include "outputs/regular_times.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinetri/algebra/number_types.h"

namespace kinetri::app::regular_times_test {
namespace {

using Times = std::vector<double>;

TEST(Regular_times, go_on_up_to_the_end) {
  EXPECT_EQ(regular_times(0, 2, 2, 10), (Times{0, 0.5, 1, 1.5, 2}));
  EXPECT_EQ(regular_times(-1, 0.4, 1, 10), (Times{-1, 0}));
  EXPECT_EQ(regular_times(3, 3, 25, 10), Times{3});
  EXPECT_EQ(regular_times(0, 100, 1e-3, 10), Times{0});
}

// Sums of 0.1 are not those: 0.1 + 0.1 + 0.1 > 0.3, which is the last time.
TEST(Regular_times, are_rounded_once) {
  EXPECT_EQ(regular_times(0, 0.3, 10, 10), (Times{0, 0.1, 0.2, 0.3}));
  const auto times = regular_times(0.7, 9, 30, 1000);
  ASSERT_TRUE(times);
  ASSERT_EQ(times->size(), 250U);
  for (std::size_t k = 0; k < times->size(); ++k) {
    EXPECT_EQ((*times)[k], to_double(to_rational(0.7) + Rational(k, 30)));
  }
}

TEST(Regular_times, may_be_multiples_of_a_frame) {
  EXPECT_EQ(multiples(0.1, 0.5, 10, 10), (Times{0.1, 0.2, 0.3, 0.4, 0.5}));
  EXPECT_EQ(multiples(-0.25, 0.25, 10, 10), (Times{-0.2, -0.1, 0, 0.1, 0.2}));
  EXPECT_EQ(multiples(0.11, 0.19, 10, 10), Times{});
  EXPECT_EQ(multiples(0, 10, 1, 10), std::nullopt);
  // As a file is read: the quotients, rounded.
  const auto times = multiples(7 / 30.0, 500 / 30.0, 30, 1000);
  ASSERT_TRUE(times);
  ASSERT_EQ(times->size(), 494U);
  for (std::size_t k = 0; k < times->size(); ++k) {
    EXPECT_EQ((*times)[k], static_cast<double>(k + 7) / 30);
  }
}

TEST(Regular_times, have_a_limit) {
  EXPECT_EQ(regular_times(0, 9, 1, 10)->size(), 10U);
  EXPECT_EQ(regular_times(0, 10, 1, 10), std::nullopt);
  EXPECT_EQ(regular_times(-1e308, 1e308, 1e308, 1'000'000), std::nullopt);
  // Before rounding the eleventh time is after the end: 10 / 1.1 > 9.09...
  EXPECT_EQ(regular_times(0, to_double(to_rational(10.0) / to_rational(1.1)), 1.1, 10),
            std::nullopt);
}

TEST(Regular_times, that_are_one_number_are_there_once) {
  EXPECT_EQ(regular_times(1e17, 1e17 + 32, 1, 100), (Times{1e17, 1e17 + 16, 1e17 + 32}));
  EXPECT_EQ(evenly_spaced_times(1, std::nextafter(1, 2), 100),
            (Times{1, std::nextafter(1.0, 2.0)}));
  EXPECT_EQ(evenly_spaced_times(5, 5, 100), Times{5});
}

TEST(Regular_times, divide_a_run_evenly) {
  EXPECT_EQ(evenly_spaced_times(-1, 1, 4), (Times{-1, -0.5, 0, 0.5, 1}));
  const Times times = evenly_spaced_times(0, 10, 100);
  ASSERT_EQ(times.size(), 101U);
  EXPECT_EQ(times[3], 0.3);
  EXPECT_EQ(times[100], 10);
  constexpr double largest = std::numeric_limits<double>::max();
  EXPECT_EQ(evenly_spaced_times(-largest, largest, 2), (Times{-largest, 0, largest}));
}

}  // namespace
}  // namespace kinetri::app::regular_times_test
