// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points that coincide until one of them gets another motion: one of them has the vertex.
#ifndef KINETRI_IMPL_TRIANGULATION_TWINS_H
#define KINETRI_IMPL_TRIANGULATION_TWINS_H

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/impl/events/basic_event.h"
#include "kinetri/impl/triangulation/kinetic_types.h"

namespace kinetri::detail {

/// Groups of points that coincide: a union-find forest, of which each root is the least id of its
/// group.
class Coincident_groups {
 public:
  void link(Point_id a, Point_id b) {
    parents_.emplace(a, a);
    parents_.emplace(b, b);
    const Edge_ids roots = edge_ids(least(a), least(b));
    parents_[roots[1]] = roots[0];
  }
  /// The least id of the group of a point. Precondition: the point was linked.
  Point_id least(Point_id id) const {
    while (parents_.at(id) != id) id = parents_.at(id);
    return id;
  }
  std::size_t number_of_points() const noexcept { return parents_.size(); }
  /// For each point that is not the least of its group, by id: the least, and the point.
  std::vector<Edge_ids> others() const {
    std::vector<Edge_ids> result;
    for (const auto& [id, parent] : parents_) {
      if (id != parent) result.push_back({least(id), id});
    }
    return result;
  }

 private:
  std::map<Point_id, Point_id> parents_;
};

/// The points without a vertex of their own: each has the trajectory (and weight) of a point of
/// lesser id, which hides it. Of points with the same height x^2 + y^2 - w the one with the least
/// id is on the lower hull: docs/MATH.md, section 4, takes heights by id where nothing else
/// decides.
///
/// Invariant: a point that hides others is hidden by none. A change costs O(log k) for k twins and,
/// if the point belongs to a group, as much as the group has points; nothing if there are none.
template <class Traits>
class Kinetic_types<Traits>::Twins {
 public:
  struct Twin {
    Point_id shown;  ///< the point that hides it
    Point_2 point;   ///< with its own motion, of which the representation may differ
  };

  bool empty() const noexcept { return twins_.empty(); }
  std::size_t size() const noexcept { return twins_.size(); }
  bool contains(Point_id id) const { return twins_.contains(id); }
  /// Precondition: contains(id).
  const Twin& twin(Point_id id) const { return twins_.at(id); }
  /// By id.
  const std::map<Point_id, Twin>& all() const noexcept { return twins_; }
  /// The ids of the points that the point hides, sorted.
  const std::vector<Point_id>& hidden_by(Point_id shown) const {
    static const std::vector<Point_id> none;
    const auto found = hidden_.find(shown);
    return found == hidden_.end() ? none : found->second;
  }

  /// A point that is no twin becomes one; those that it hides become twins of `shown`.
  /// Precondition: `shown` is no twin, and is less than the id of the point.
  void hide(const Point_2& point, Point_id shown) {
    const Point_id id = point.id();
    auto& list = hidden_[shown];
    insert(list, id);
    twins_.insert_or_assign(id, Twin{shown, point});
    const auto own = hidden_.find(id);
    if (own == hidden_.end()) return;
    for (const Point_id other : own->second) {
      insert(list, other);
      twins_.at(other).shown = shown;
    }
    hidden_.erase(own);
  }
  /// A twin gets a vertex or is erased.
  void take_out(Point_id id) {
    const auto twin = twins_.find(id);
    const auto list = hidden_.find(twin->second.shown);
    std::erase(list->second, id);
    if (list->second.empty()) hidden_.erase(list);
    twins_.erase(twin);
  }
  /// A twin gets the vertex of the point that hides it, and hides the others. Precondition: of
  /// all points hidden by that one, it has the least id.
  void show(Point_id id) {
    const Point_id before = twins_.at(id).shown;
    take_out(id);
    const auto list = hidden_.find(before);
    if (list == hidden_.end()) return;
    for (const Point_id other : list->second) twins_.at(other).shown = id;
    hidden_.insert_or_assign(id, std::move(list->second));
    hidden_.erase(before);
  }
  /// Replaces each motion by change(motion), which keeps equal trajectories equal.
  template <class Change>
  void for_each_motion(const Change& change) {
    for (auto& [id, twin] : twins_) twin.point = Point_2(change(twin.point.motion()), id);
  }

 private:
  static void insert(std::vector<Point_id>& sorted, Point_id id) {
    sorted.insert(std::ranges::lower_bound(sorted, id), id);
  }

  std::map<Point_id, Twin> twins_;
  std::map<Point_id, std::vector<Point_id>> hidden_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_TWINS_H
