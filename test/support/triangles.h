// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles of a triangulation by ids, and those of a played recording.
#ifndef KINETRI_TEST_SUPPORT_TRIANGLES_H
#define KINETRI_TEST_SUPPORT_TRIANGLES_H

#include <gtest/gtest.h>

#include <set>

#include "kinetri/simulation/recording.h"

namespace kinetri::test {

template <class Kinetic_triangulation>
std::set<Triangle_ids> triangles_of(const Kinetic_triangulation& kinetic) {
  std::set<Triangle_ids> result;
  if (kinetic.triangulation().dimension() < 2) return result;
  for (const auto face : kinetic.triangulation().finite_face_handles()) {
    result.insert(triangle_ids(face->vertex(0)->point().id(), face->vertex(1)->point().id(),
                               face->vertex(2)->point().id()));
  }
  return result;
}

/// The triangles of a recording after each of its events.
class Triangle_player {
 public:
  explicit Triangle_player(const Recording& recording)
      : next_(recording.triangles.begin()),
        end_(recording.triangles.end()),
        triangles_(recording.initial_triangles.begin(), recording.initial_triangles.end()) {
    EXPECT_EQ(triangles_.size(), recording.initial_triangles.size());
  }

  /// Precondition: events are executed in order.
  void execute(std::size_t event) {
    for (; next_ != end_ && next_->event == event; ++next_) {
      if (next_->is_added) {
        EXPECT_TRUE(triangles_.insert(next_->corners).second) << "event " << event;
      } else {
        EXPECT_EQ(triangles_.erase(next_->corners), 1u) << "event " << event;
      }
    }
  }

  const std::set<Triangle_ids>& triangles() const { return triangles_; }
  bool is_at_end() const { return next_ == end_; }

 private:
  std::vector<Recorded_triangle>::const_iterator next_;
  std::vector<Recorded_triangle>::const_iterator end_;
  std::set<Triangle_ids> triangles_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_TRIANGLES_H
