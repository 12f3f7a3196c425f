// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points of a segment at the present, which writer and reader follow alike: what they expect of
// the next block, and what a block may say.
#ifndef KINETRI_VIDEO_STREAM_PRESENT_POINTS_H
#define KINETRI_VIDEO_STREAM_PRESENT_POINTS_H

#include <optional>
#include <string>
#include <vector>

#include "video/stream/stream.h"

namespace kinetri::video {

/// The points that are there after the blocks so far.
class Present_points {
 public:
  struct Point {
    Point_id id = 0;
    Node node;
    /// By which the last group moved it, and in how many frames; 0 frames if it has just come.
    Place step;
    std::uint32_t frames = 0;
  };

  explicit Present_points(const Stream_header& header) : header_(header) {}

  /// Why the block cannot be the next one; empty if it can. That is everything stream.h says of it,
  /// and that numbers fit. Cost: O(n log n).
  std::string problem(const Block& block) const;

  /// Goes to the end of the block. Precondition: problem(block) is empty.
  void follow(const Block& block);

  /// Gives the points the colors of the targets, where these are found only now. Precondition: as
  /// many as points.
  void set_colors(const std::vector<Node>& targets);

  /// By number.
  const std::vector<Point>& points() const { return points_; }
  /// The time up to which the blocks reach.
  std::uint32_t time() const { return time_; }
  bool has_begun() const { return has_begun_; }
  bool has_ended() const { return has_ended_; }
  /// The number that the next point gets.
  Point_id next_id() const { return next_id_; }

  /// The points after those that the group erases have gone and those that it inserts have come.
  std::vector<Point> at_begin_of(const Group& group) const;

  /// Where a point is expected to be after a group of `frames`: it goes on as before; where it has
  /// not moved before, by `shift`. Quotients are rounded towards zero.
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
