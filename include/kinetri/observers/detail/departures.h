// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that go at the time at which others come: both are there at that time, but never in one
// triangulation.
#ifndef KINETRI_OBSERVERS_DETAIL_DEPARTURES_H
#define KINETRI_OBSERVERS_DETAIL_DEPARTURES_H

#include <CGAL/box_intersection_d.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "kinetri/observers/detail/gap_of_pair.h"
#include "kinetri/simulation/detail/disc_boxes.h"

namespace kinetri::detail {

/// The points that have gone at one time.
template <class Point_2>
class Departures {
 public:
  /// Some points have changed at `time`, as Edge_follower::change tells. Calls `meet` with each
  /// point that has gone at that time, so far, and each that comes, if their boxes meet: all pairs
  /// that are in range of each other then, and perhaps others. Points without radii of their own
  /// have `radius`. Cost: O(k log k) for k such points and as many pairs.
  template <class Changed_points, class Graph, class Meet>
  void change(const Algebraic_number& time, const Changed_points& changed, const Graph& graph,
              double range, double radius, const Meet& meet) {
    if (changed.empty()) return;
    if (time_ != time) gone_.clear();
    time_ = time;
    std::vector<Point_id> come;
    for (const auto& [id, before] : changed) {
      const bool is_there = graph.contains(id);
      if (before && !is_there) gone_.push_back(*before);
      if (!before && is_there) come.push_back(id);
    }
    if (gone_.empty() || come.empty()) return;
    const Double_interval times = time.tight_interval();
    const auto box = [&](const Point_2& point, double reach, std::size_t index) {
      auto disc = disc_about(point.motion(), radius);
      disc.radius = std::nextafter(disc.radius + reach, std::numeric_limits<double>::infinity());
      return box_around(disc, static_cast<Point_id>(index), times.lower, times);
    };
    std::vector<Disc_box> boxes_gone;
    for (std::size_t i = 0; i < gone_.size(); ++i) boxes_gone.push_back(box(gone_[i], range, i));
    std::vector<Disc_box> boxes_come;
    for (const Point_id id : come) boxes_come.push_back(box(graph.point(id), 0, id));
    std::vector<std::pair<Point_id, Point_id>> close;
    CGAL::box_intersection_d(
        boxes_gone.begin(), boxes_gone.end(), boxes_come.begin(), boxes_come.end(),
        [&](const auto& p, const auto& q) { close.emplace_back(p.info(), q.info()); });
    for (const auto& [index, id] : close) meet(gone_[index], graph.point(id));
  }

 private:
  std::vector<Point_2> gone_;
  Algebraic_number time_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_OBSERVERS_DETAIL_DEPARTURES_H
