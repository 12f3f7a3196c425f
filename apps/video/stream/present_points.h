// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a segment at the end of the blocks so far. Writer and reader use them to predict
// and to check the next block.
#ifndef KINETRI_VIDEO_STREAM_PRESENT_POINTS_H
#define KINETRI_VIDEO_STREAM_PRESENT_POINTS_H

#include <optional>
#include <string>
#include <vector>

#include "video/stream/stream.h"

namespace kinetri::video {

/// The points that exist after the blocks so far.
class Present_points {
 public:
  struct Point {
    Point_id id = 0;
    Node node;
    /// Its displacement in the last group, and the frames of that group; 0 frames if the point is
    /// new.
    Place step;
    std::uint32_t frames = 0;
  };

  explicit Present_points(const Stream_header& header) : header_(header) {}

  /// Why the block cannot be the next one; empty if it can. Checks all conditions of stream.h, and
  /// ranges of numbers. Cost: O(n log n).
  std::string problem(const Block& block) const;

  /// Goes to the end of the block. Precondition: problem(block) is empty.
  void follow(const Block& block);

  /// Sets the colors of the points to those of the targets, if they were not known before.
  /// Precondition: there are as many targets as points.
  void set_colors(const std::vector<Node>& targets);

  /// By number.
  const std::vector<Point>& points() const { return points_; }
  /// The time at which the last block ends.
  std::uint32_t time() const { return time_; }
  bool has_ended() const { return has_ended_; }
  /// The number that the next point gets.
  Point_id next_id() const { return next_id_; }

  /// The points after the group's erasures and insertions.
  std::vector<Point> at_begin_of(const Group& group) const;

  /// The expected position of a point after a group of `frames`: it continues as before, or, if it
  /// is new, moves by `shift`. Quotients are rounded toward zero.
  static Place expected_place(const Point& point, std::uint32_t frames, const Place& shift);

 private:
  std::string problem_of(const Key& key) const;
  std::string problem_of(const Group& group) const;
  std::string problem_of(const End& end) const;
  std::string problem_of_node(const Node& node) const;

  Stream_header header_;
  std::vector<Point> points_;
  std::uint32_t time_ = 0;
  Point_id next_id_ = 0;
  bool has_begun_ = false;
  bool has_ended_ = false;
};

}  // namespace kinetri::video

#endif  // KINETRI_VIDEO_STREAM_PRESENT_POINTS_H
