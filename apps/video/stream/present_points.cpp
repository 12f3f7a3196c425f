// SPDX-License-Identifier: GPL-3.0-or-later
#include "video/stream/present_points.h"

#include <algorithm>
#include <bit>

#include "kinetri/impl/io/text.h"

namespace kinetri::video {
namespace {

using Point = Present_points::Point;

bool are_distinct(std::vector<Place> places) {
  std::ranges::sort(places);
  return std::ranges::adjacent_find(places) == places.end();
}

}  // namespace

std::string Present_points::problem(const Block& block) const {
  if (has_ended_) return "it comes after the end";
  return std::visit([&](const auto& b) { return problem_of(b); }, block);
}

std::string Present_points::problem_of_node(const Node& node) const {
  const auto [x, y] = node.place;
  if (x < header_.left() || x > header_.right() || y < header_.top() || y > header_.bottom()) {
    return "a point is outside of the stage";
  }
  for (std::size_t plane = header_.format.planes(); plane < 3; ++plane) {
    if (node.colors[plane] != 0) return "a point has a color that the format has no room for";
  }
  return {};
}

std::string Present_points::problem_of(const Key& key) const {
  if (!has_begun_ && key.frame != 0) return "the first key is not at frame 0";
  if (has_begun_ && key.frame < time_) return "a key comes before the end of the group before it";
  if (key.points.size() < number_of_corners || key.points.size() > most_points) {
    return "a key has fewer points than corners, or too many";
  }
  const auto expected = header_.corners();
  std::vector<Place> places;
  for (std::size_t i = 0; i < key.points.size(); ++i) {
    if (auto problem = problem_of_node(key.points[i]); !problem.empty()) return problem;
    places.push_back(key.points[i].place);
    if (i < number_of_corners && places[i] != expected[i]) {
      return "a corner is not where it should be";
    }
  }
  if (!are_distinct(std::move(places))) return "two points are at one place";
  return {};
}

std::string Present_points::problem_of(const Group& group) const {
  if (!has_begun_) return "a group comes before the first key";
  if (group.first != time_) return "a group does not begin where the block before it ends";
  if (!std::has_single_bit(group.frames) || group.frames > most_group_frames) {
    return "the length of a group is no power of two, or too large";
  }
  if (group.first > UINT32_MAX - group.frames) return "time has no end";
  std::size_t found = 0;
  for (const Point& point : points_) {
    if (found < group.erased.size() && group.erased[found] == point.id) ++found;
  }
  if (found != group.erased.size() || (found > 0 && group.erased.front() < number_of_corners)) {
    return "a point is erased that is not there, or is a corner";
  }
  const std::size_t staying = points_.size() - found;
  if (group.inserted.size() > most_points - std::min<std::size_t>(staying, most_points) ||
      group.inserted.size() > no_point - next_id_ - 1) {
    return "there are too many points";
  }
  for (const Node& node : group.inserted) {
    if (auto problem = problem_of_node(node); !problem.empty()) return problem;
  }
  const std::vector<Point> points = at_begin_of(group);
  if (points.size() != group.targets.size()) return "there are not as many targets as points";
  std::vector<Place> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (auto problem = problem_of_node(group.targets[i]); !problem.empty()) return problem;
    places.push_back(points[i].node.place);
    if (i < number_of_corners && group.targets[i].place != points[i].node.place)
      return "a corner moves";
  }
  if (!are_distinct(std::move(places))) return "two points are at one place";
  return {};
}

std::string Present_points::problem_of(const End& end) const {
  if (!has_begun_) return "there is no key";
  if (end.frames <= time_) return "the end comes before that of the last group";
  return {};
}

std::vector<Point> Present_points::at_begin_of(const Group& group) const {
  std::vector<Point> result;
  result.reserve(points_.size() + group.inserted.size());
  std::size_t next_erased = 0;
  for (const Point& point : points_) {
    if (next_erased < group.erased.size() && group.erased[next_erased] == point.id) {
      ++next_erased;
    } else {
      result.push_back(point);
    }
  }
  Point_id id = next_id_;
  for (const Node& node : group.inserted) result.push_back({id++, node, {}, 0});
  return result;
}

void Present_points::follow(const Block& block) {
  if (const Key* key = std::get_if<Key>(&block)) {
    points_.clear();
    next_id_ = 0;
    for (const Node& node : key->points) points_.push_back({next_id_++, node, {}, 0});
    time_ = key->frame;
    has_begun_ = true;
  } else if (const Group* group = std::get_if<Group>(&block)) {
    points_ = at_begin_of(*group);
    next_id_ += static_cast<Point_id>(group->inserted.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Place from = points_[i].node.place;
      const Place to = group->targets[i].place;
      points_[i].step = {to.x - from.x, to.y - from.y};
      points_[i].frames = group->frames;
      points_[i].node = group->targets[i];
    }
    time_ = group->last();
  } else {
    has_ended_ = true;
  }
}

void Present_points::set_colors(const std::vector<Node>& targets) {
  for (std::size_t i = 0; i < points_.size(); ++i) points_[i].node.colors = targets[i].colors;
}

Place Present_points::expected_place(const Point& point, std::uint32_t frames, const Place& shift) {
  const Place& from = point.node.place;
  if (point.id < number_of_corners) return from;
  if (point.frames == 0) return {from.x + shift.x, from.y + shift.y};
  // Both lengths are at most 2^10, a step is less than 2^23.
  const auto moved = [&](std::int32_t coordinate, std::int32_t step) {
    constexpr std::int64_t limit = 1 << 30;
    const std::int64_t result = coordinate + std::int64_t{step} * frames / point.frames;
    return static_cast<std::int32_t>(std::clamp(result, -limit, limit));
  };
  return {moved(from.x, point.step.x), moved(from.y, point.step.y)};
}

}  // namespace kinetri::video
