// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that are erased at the time at which others are inserted: both exist at that time, but
// never in one triangulation.
#ifndef KINETRI_SRC_OBSERVERS_DEPARTURES_H
#define KINETRI_SRC_OBSERVERS_DEPARTURES_H

#include <CGAL/box_intersection_d.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "observers/gap_of_pair.h"
#include "simulation/disc_boxes.h"

namespace kinetri::detail {

/// Calls `function` with the indices of each disc of `gone` and each of `come` with a gap of at
/// most `range` at the time, and perhaps of others. Cost: O(k log k) for k discs, and the number of
/// pairs. Precondition: range >= 0.
template <class Disc, class Function>
void for_each_pair_in_range(const std::vector<Disc>& gone, const std::vector<Disc>& come,
                            double range, const Algebraic_number& time, Function function) {
  const Double_interval times = time.tight_interval();
  const auto boxes = [&](const std::vector<Disc>& discs, double reach) {
    std::vector<Disc_box> result;
    for (Disc disc : discs) {
      disc.radius = std::nextafter(disc.radius + reach, std::numeric_limits<double>::infinity());
      const auto index = static_cast<Point_id>(result.size());
      result.push_back(box_around(disc, index, times.lower, times));
    }
    return result;
  };
  std::vector<Disc_box> boxes_gone = boxes(gone, range);
  std::vector<Disc_box> boxes_come = boxes(come, 0);
  for_each_pair_of_boxes(boxes_gone, boxes_come, function);
}

/// The points that have been erased at one time.
template <class Point_2>
class Departures {
 public:
  /// Called with the changes of Edge_follower::change. Calls `meet` with each erased and inserted
  /// point of that time that are in range of each other, and perhaps with others. `radius` is that
  /// of points without radii of their own. Cost: O(k log k) for k such points, and the number of
  /// pairs.
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
    using Disc = decltype(disc_about(gone_.front().motion(), radius));
    std::vector<Disc> discs_gone;
    for (const Point_2& point : gone_) discs_gone.push_back(disc_about(point.motion(), radius));
    std::vector<Disc> discs_come;
    for (const Point_id id : come) {
      discs_come.push_back(disc_about(graph.point(id).motion(), radius));
    }
    for_each_pair_in_range(discs_gone, discs_come, range, time, [&](std::size_t i, std::size_t k) {
      meet(gone_[i], graph.point(come[k]));
    });
  }

 private:
  std::vector<Point_2> gone_;
  Algebraic_number time_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_OBSERVERS_DEPARTURES_H
