// SPDX-License-Identifier: GPL-3.0-or-later
//
// Times of kinetri-verify: comparisons that are many do not make them longer.
#include "../../apps/verify/roots.h"

#include <gtest/gtest.h>

namespace verify::roots_test {
namespace {

// (3 t - 1) (t - k): the root 1/3 between 0 and 1, and another one.
Time third(int k) {
  const Polynomial p = {k, -1 - 3 * k, 3};
  std::vector<Time> roots = roots_in(p, dyadic(0.125), dyadic(0.875));
  EXPECT_EQ(roots.size(), 1u);
  return roots.front();
}

TEST(Times_of_kinetri_verify, that_are_equal_do_not_get_more_digits_with_each_comparison) {
  Time time = third(2);
  for (int k = 3; k < 1000; ++k) {
    Time other = third(k);
    ASSERT_EQ(compare(time, other), 0);
    ASSERT_EQ(compare(other, time), 0);
    ASSERT_LT(std::max({time.lo.e, time.hi.e, other.lo.e, other.hi.e}), 64u) << k;
  }
  Time less = {{-333'333, 1'000'000}, dyadic(0), dyadic(1)};
  EXPECT_EQ(compare(less, time), -1);
  EXPECT_EQ(compare(time, less), 1);
}

}  // namespace
}  // namespace verify::roots_test
