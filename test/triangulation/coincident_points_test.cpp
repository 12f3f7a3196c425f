// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "kinetri/triangulation/kinetic_regular_triangulation_2.h"
#include "support/kinetic_parts.h"

namespace kinetri::coincident_points_test {
namespace {

using Kinetic = Kinetic_delaunay_triangulation_2<>;
using test::resting;

// The events of points, each as its kind and ids.
class Texts : public Event_observer {
 public:
  void after_event(const Event& event) override {
    if (event.kind == Event_kind::rebuild) return;
    std::ostringstream text;
    text << name(event.kind);
    if (event.point_a) text << ' ' << *event.point_a;
    if (event.point_b) text << ' ' << *event.point_b;
    texts.push_back(text.str());
  }
  std::vector<std::string> take() { return std::exchange(texts, {}); }

  std::vector<std::string> texts;
};

using Strings = std::vector<std::string>;
using Ids = std::vector<Point_id>;

const std::vector<Linear_motion_2> square = {resting(0, 0), resting(4, 0), resting(4, 4),
                                             resting(0, 4)};

TEST(Coincident_points, share_the_vertex_of_the_least_until_it_leaves) {
  Kinetic kinetic(square, {}, {}, Coincident_points::hide);
  Texts events;
  kinetic.add_observer(events);
  EXPECT_EQ(kinetic.insert(resting(4, 4)), 4u);
  EXPECT_EQ(events.take(), (Strings{"insert 4", "hide 4 2"}));
  EXPECT_EQ(kinetic.insert(resting(4, 4)), 5u);
  EXPECT_EQ(events.take(), (Strings{"insert 5", "hide 5 2"}));
  EXPECT_EQ(kinetic.number_of_points(), 6u);
  EXPECT_EQ(kinetic.number_of_hidden_points(), 2u);
  EXPECT_TRUE(kinetic.is_hidden(4));
  EXPECT_FALSE(kinetic.is_hidden(2));
  EXPECT_EQ(kinetic.vertex(5), kinetic.vertex(2));
  EXPECT_EQ(kinetic.coincident_points(2), (Ids{4, 5}));
  EXPECT_EQ(kinetic.coincident_points(4), (Ids{2, 5}));
  EXPECT_EQ(kinetic.coincident_points(0), Ids());

  kinetic.set_motion(2, {{4, 4}, {1, 1}, 0});
  EXPECT_EQ(events.take(), (Strings{"trajectory 2", "reveal 4 2"}));
  EXPECT_EQ(kinetic.vertex(5)->point().id(), 4u);
  EXPECT_EQ(kinetic.coincident_points(4), Ids{5});
  EXPECT_EQ(kinetic.coincident_points(2), Ids());

  kinetic.erase(4);
  EXPECT_EQ(events.take(), (Strings{"erase 4", "reveal 5 4"}));
  kinetic.set_motion(1, resting(4, 4));
  EXPECT_EQ(events.take(), (Strings{"trajectory 1", "hide 5 1"}));
  EXPECT_TRUE(kinetic.audit(Audit_level::certificates).passed());
}

TEST(Coincident_points, that_all_leave_at_once_are_all_revealed) {
  std::vector<Linear_motion_2> motions = square;
  motions.push_back(resting(4, 4));
  motions.push_back({{3, 4}, {1, 0}, -1});  // another one at (4, 4) at time 0, and gone then
  motions.push_back(resting(4, 4));
  Kinetic kinetic(motions, {}, {}, Coincident_points::hide);
  EXPECT_EQ(kinetic.coincident_points(2), (Ids{4, 6}));
  Texts events;
  kinetic.add_observer(events);
  const Ids ids = {2, 4, 6};
  kinetic.set_motions(ids, std::vector<Linear_motion_2>{
                               {{4, 4}, {1, 0}, 0}, {{4, 4}, {0, 1}, 0}, {{4, 4}, {-1, 0}, 0}});
  EXPECT_EQ(events.take(), (Strings{"trajectory 2", "trajectory 4", "trajectory 6", "reveal 4 2",
                                    "hide 5 2", "reveal 6 2"}));
  EXPECT_TRUE(kinetic.audit(Audit_level::certificates).passed());
}

TEST(Coincident_points, with_weights_are_hidden_by_one_of_the_same_weight) {
  const auto disc = [](double x, double y, double weight) {
    return Disc_motion_2{resting(x, y), 0, 0, weight};
  };
  const std::vector<Disc_motion_2> discs = {disc(0, 0, 0), disc(8, 0, 0), disc(0, 8, 0),
                                            disc(2, 2, 1), disc(2, 2, 3), disc(2, 2, 1)};
  Kinetic_regular_triangulation_2<> kinetic(discs, {}, {}, Coincident_points::hide);
  EXPECT_TRUE(kinetic.is_hidden(3)) << "by the face beside the heavier point 4";
  EXPECT_TRUE(kinetic.is_hidden(5));
  EXPECT_EQ(kinetic.coincident_points(5), Ids{3});
  EXPECT_EQ(kinetic.number_of_hidden_points(), 2u);
  Texts events;
  kinetic.add_observer(events);
  kinetic.erase(4);
  EXPECT_EQ(events.take(), (Strings{"erase 4", "reveal 3"}));
  EXPECT_TRUE(kinetic.is_hidden(5));
  kinetic.set_motion(5, disc(2, 2, 2));
  EXPECT_EQ(events.take(), (Strings{"trajectory 5", "hide 3", "reveal 5 3"}));
  EXPECT_TRUE(kinetic.audit(Audit_level::certificates).passed());
}

TEST(Coincident_points, are_refused_on_request_without_any_change) {
  Kinetic kinetic(square, {}, {}, Coincident_points::refuse);
  EXPECT_EQ(kinetic.coincident(), Coincident_points::refuse);
  EXPECT_THROW(kinetic.insert(resting(4, 4)), Coincident_trajectories_error);
  EXPECT_EQ(kinetic.next_id(), 4u);
  EXPECT_THROW(kinetic.set_motion(0, resting(4, 0)), Coincident_trajectories_error);
  EXPECT_EQ(kinetic.motion(0), square[0]);
  const Kinetic hides(std::vector<Linear_motion_2>(2, resting(1, 1)));
  EXPECT_EQ(hides.coincident(), Coincident_points::hide);
  EXPECT_THROW(Kinetic::restore(hides.snapshot(), {}, Coincident_points::refuse), Snapshot_error);
}

}  // namespace
}  // namespace kinetri::coincident_points_test
