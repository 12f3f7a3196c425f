// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether an event is to come before a time.
#include <gtest/gtest.h>

#include <vector>

#include "support/kinetic_runs.h"
#include "support/motions.h"

namespace kinetri::has_event_before_test {
namespace {

using test::Kinetic_delaunay;

// has_event_before looks again where next_event_time does, but keeps nothing.
TEST(Has_event_before, agrees_with_the_next_event_time_and_changes_nothing) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const auto motions = seed % 3 == 0 ? test::grid_motions(6, 3, 1, seed)
                                       : test::random_motions(8 + 2 * seed, 30, 3, seed);
    Kinetic_delaunay asked(motions);
    Kinetic_delaunay undisturbed(motions);
    Kinetic_delaunay known(motions);
    for (int i = 0; i < 25; ++i) {
      const auto next = known.next_event_time();
      if (!next) break;
      EXPECT_FALSE(asked.has_event_before(*next));
      EXPECT_FALSE(asked.has_event_before(asked.current_time()));
      EXPECT_FALSE(asked.has_event_before(simplest_between(asked.current_time(), *next)));
      EXPECT_TRUE(asked.has_event_before(simplest_between(*next, next->upper() + 1)));
      EXPECT_TRUE(asked.has_event_before(next->upper() + 1000));
      EXPECT_FALSE(known.has_event_before(*next));
      EXPECT_TRUE(known.has_event_before(simplest_between(*next, next->upper() + 1)));
      EXPECT_EQ(asked.queue_counters(), undisturbed.queue_counters());
      EXPECT_EQ(asked.certificate_counters(), undisturbed.certificate_counters());
      for (Kinetic_delaunay* kinetic : {&asked, &undisturbed, &known}) kinetic->step();
    }
    EXPECT_EQ(asked.current_time(), undisturbed.current_time());
    EXPECT_EQ(asked.finite_edge_ids(), undisturbed.finite_edge_ids());
    EXPECT_TRUE(asked.audit(Audit_level::certificates).passed());
  }
}

TEST(Has_event_before, of_a_triangulation_that_never_changes_is_never_true) {
  const Kinetic_delaunay kinetic({{{0, 0}, {1, 1}}, {{2, 0}, {1, 1}}, {{0, 5}, {1, 1}}});
  EXPECT_FALSE(kinetic.has_event_before(1e300));
}

}  // namespace
}  // namespace kinetri::has_event_before_test
