// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which points are connected at a range, over time.
#ifndef KINETRI_OBSERVERS_CONNECTED_COMPONENTS_H
#define KINETRI_OBSERVERS_CONNECTED_COMPONENTS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "kinetri/impl/observers/dynamic_connectivity.h"
#include "kinetri/impl/observers/edge_follower.h"

namespace kinetri {

/// What a Component_event tells. Each but `start` changes the number of components by one.
enum class Component_event_kind : std::uint8_t {
  start,   ///< what the components are at the start; the first event, and no other one
  merge,   ///< two components become one
  split,   ///< a component becomes two
  insert,  ///< a point comes, as a component of its own; what it joins then is told by merges
  erase,   ///< a point goes that is a component of its own; what it left is told by splits before
};

/// The number of kinds.
inline constexpr std::size_t component_event_kinds = 5;

/// The kind's name in files: "start", "merge", ...
std::string_view name(Component_event_kind kind);

/// A change of the components at one exact time.
struct Component_event {
  Algebraic_number time;                                    ///< exact
  Component_event_kind kind = Component_event_kind::start;  ///< what happens
  /// Of a merge or split, the pair of points whose link joins the two components, or joined them:
  /// they are at the distance of the range exactly, unless one of them has come, goes, or jumps at
  /// that time; then they are within the range on the one side of the time on which both are there.
  /// Of an insert or erase, the point and no_point. Of a start none.
  Edge_ids points = {no_point, no_point};
  /// The numbers of points in the component of either: of a merge, before it; of a split, after it.
  std::array<std::size_t, 2> sizes = {0, 0};
  std::size_t components = 0;  ///< the number of components after the event
  std::size_t largest = 0;     ///< the number of points in the largest one after it
};

/// Times from the first to the last, both included.
struct Time_interval {
  Algebraic_number begin;  ///< the first one
  Algebraic_number end;    ///< the last one; not before `begin`
};

namespace detail {
template <ContactKineticTraits_2 Traits>
class Component_tracker;
}  // namespace detail

/// An observer that keeps the connected components of the graph in which two points are linked
/// while they are at most `range` apart, and tells every merge and split with its exact time.
///
/// All of it is closed. Two points are linked also at the moment at which they touch the range from
/// outside: then a merge and a split have the same time. A point that comes or goes at a time is
/// there at that time, and one that jumps is there at both of its places. (Of a point that jumps
/// and one that jumps, comes or goes at the same time, the places before it are looked at, and
/// those after it, but not one of each.) So at each time there are first the inserts and merges,
/// then the splits and erasures, and between them the components are those of the time itself.
/// Which link it is that joins or splits, if several begin or end at one time, follows from their
/// ids.
///
/// The links of edges of the triangulation have the same components as all links (docs/MATH.md,
/// section 12). Cost: for each edge that comes, and each edge of a point that gets another motion,
/// a certificate; for each time at which an edge crosses the range, an event of a queue and a
/// change of Dynamic_connectivity. A flip changes no component. Memory: O(n + events).
///
/// A question is answered for just after the current time, with what has happened so far: what
/// changes afterwards at the same time comes later in the order.
template <ContactKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Connected_components : public Edge_follower<Traits> {
  static_assert(!HasWeight<typename Traits::Motion>, "of points, or discs of one radius");

 public:
  using typename Edge_follower<Traits>::Triangulation;
  using typename Edge_follower<Traits>::Time;
  using Component = Dynamic_connectivity::Component;  ///< names one until the next event

  /// @{
  /// Observes from the current time on; the object must not outlive what it observes.
  /// Precondition: the range is at least 0 and finite.
  Connected_components(Simulation_2<Traits>& simulation, double range);
  Connected_components(Triangulation& triangulation, double range);
  /// @}

  /// The range.
  double range() const { return range_; }

  /// All events up to the current time, in their order. The reference is valid, and refers to the
  /// same events, until this object is used again after the triangulation has gone on.
  const std::vector<Component_event>& events();

  /// The components just after the current time.
  const Dynamic_connectivity& components();

  /// @{
  /// The functions of Dynamic_connectivity of these names, just after the current time.
  Component component(Point_id id) { return components().component(id); }
  std::size_t size_of(Point_id id) { return components().size_of(id); }
  bool are_connected(Point_id a, Point_id b) { return components().are_connected(a, b); }
  std::size_t number_of_components() { return components().number_of_components(); }
  std::size_t largest() { return components().largest(); }
  /// @}

  /// Notes from the current time on when the two points are connected. They need not be there yet.
  /// Cost: O(1) for each pair and event. Precondition: they differ.
  void watch(const Edge_ids& points);
  /// The times since watch(points), up to the current one, at which the two were connected, in
  /// their order and disjoint. Precondition: watch() has been called for the pair.
  std::vector<Time_interval> connected_intervals(const Edge_ids& points);

 private:
  using typename Edge_follower<Traits>::Changed_point;
  using Tracker = detail::Component_tracker<Traits>;

  void start();
  const Time& now() const;
  const Tracker& present();
  void advance(const Time& time) override;
  void before_change(std::span<const Edge_ids> removed,
                     std::span<const Changed_point> points) override;
  void change(const Time& time, std::span<const Edge_ids> removed, std::span<const Edge_ids> added,
              std::span<const Changed_point> points) override;

  double range_;
  // Not shared, but of a type that is incomplete here.
  std::shared_ptr<Tracker> tracker_;
};

extern template class Connected_components<Linear_kinetic_traits_2>;
extern template class Connected_components<Polynomial_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_CONNECTED_COMPONENTS_H
