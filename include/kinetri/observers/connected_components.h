// SPDX-License-Identifier: GPL-3.0-or-later
//
// The connected components of points at a range, over time.
#ifndef KINETRI_OBSERVERS_CONNECTED_COMPONENTS_H
#define KINETRI_OBSERVERS_CONNECTED_COMPONENTS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "kinetri/impl/observers/neighbor_names.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// The kinds of Component_event. Each but `start` changes the number of components by one.
enum class Component_event_kind : std::uint8_t {
  start,   ///< the components when observation starts, 0 without points; the first event only
  merge,   ///< two components become one
  split,   ///< a component becomes two
  insert,  ///< a point is inserted, as a component of its own; merges follow
  erase,   ///< a point is erased that is a component of its own, after splits
  wrap,    ///< in a periodic box: a component begins to wrap around it, in a further direction
  unwrap,  ///< in a periodic box: a component ceases to wrap around it, in a direction
};

/// The number of kinds.
inline constexpr std::size_t component_event_kinds = 7;

/// The kind's name in files: "start", "merge", ...
std::string_view name(Component_event_kind kind);

/// A change of the components at one exact time.
struct Component_event {
  Algebraic_number time;                                    ///< exact
  Component_event_kind kind = Component_event_kind::start;  ///< what happens
  /// Of a merge or split, the ends of the link that joins, or joined, the two components. Their
  /// distance is the range exactly, unless one of them is inserted, erased, or jumps at that time.
  /// Of a wrap or unwrap, the ends of the link that begins or ends. Of an insert or erase, the
  /// point and no_point. Of a start none.
  Edge_ids points = {no_point, no_point};
  /// The sizes of the two components: before a merge, after a split. Of a wrap or unwrap, the size
  /// of the component, and 0.
  std::array<std::size_t, 2> sizes = {0, 0};
  std::size_t components = 0;  ///< the number of components after the event
  std::size_t largest = 0;     ///< the number of points in the largest one after it
  /// In a periodic box, `points` and this are a Periodic_edge: the link is that of the first point
  /// with this image of the second one. Else zero.
  Lattice_offset_2 offset = {};
  /// In a periodic box, in how many directions the two components wrap: before a merge, after a
  /// split. Of a wrap or unwrap, in how many the component does before the event, and after it.
  std::array<int, 2> directions = {0, 0};
  std::size_t wrapping = 0;  ///< the number of components that wrap after the event
};

/// Times from the first to the last, both included.
struct Time_interval {
  Algebraic_number begin;  ///< the first one
  Algebraic_number end;    ///< the last one; not before `begin`
};

namespace detail {
template <DistanceKineticTraits_2 Traits>
class Component_tracker;
}  // namespace detail

/// An observer that maintains the connected components of the graph in which two points are linked
/// while they are at most `range` apart, and reports every merge and split with its exact time.
///
/// Links are closed in time: two points are also linked if they reach the range at one time only,
/// with a merge and a split at that time. A point exists at the times at which it is inserted and
/// erased, and one that jumps is at both of its positions. (For two points that change at the same
/// time, one of which jumps, the positions before and those after are examined, but not one of
/// each.) So at each time inserts and merges come first, then splits and erasures; between them the
/// components are those of the time itself. If several links begin or end at one time, the order of
/// ids decides which of them joins or splits.
///
/// The links of edges of the triangulation have the same components as all links (docs/MATH.md,
/// section 12). Cost: a certificate for each new edge and each edge of a point that gets another
/// motion; for each time at which an edge crosses the range, an event of a queue and a change of
/// the linked graph. That costs O(smaller component) if two are joined or one splits; if a link
/// ends and the component does not split, it costs a search, few steps if the link is on a short
/// cycle and O(component) at worst. Memory: O(n + events).
///
/// Answers are for just after the current time; changes made afterwards at the same time come later
/// in the order.
///
/// *In a periodic box* links are those of images; a point is linked to itself if it is at most the
/// range from an image of itself. A component *wraps* around the box if a path along links leads
/// from a point to another image of that point. The paths of a component lead to images in one
/// direction, or in two independent ones: then it percolates in the whole plane. Events `wrap` and
/// `unwrap` tell when that begins and ends, exactly; merges come with the directions of both
/// components, and the joined one wraps in the greater number of directions, unless a `wrap` at
/// that time follows. If a link of a component that wraps ends, the search costs O(component) more
/// unless the shortest way between its ends is one without a net offset. A point that jumps takes
/// the straight way between its positions as given, which counts as a link at that time, also
/// if it jumps to another image of itself. A point that is erased and one that is inserted at the
/// same time are not linked.
template <DistanceKineticTraits_2 Traits = Linear_kinetic_traits_2>
class Connected_components {
  static_assert(!HasWeight<typename Traits::Motion>, "of points, or discs of one radius");

 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;  ///< what is observed
  using Component = std::uint32_t;  ///< names a component until the next event

  /// @{
  /// Observes from the current time on. What is observed must outlive this object. Precondition:
  /// the range is at least 0 and finite.
  Connected_components(Simulation_2<Traits>& simulation, double range);
  Connected_components(Triangulation& triangulation, double range);
  /// @}
  ~Connected_components();

  /// The range.
  double range() const;

  /// All events up to the current time, in their order. The reference is valid until this object is
  /// used again after the triangulation has advanced.
  const std::vector<Component_event>& events();

  /// Whether there is the point.
  bool contains(Point_id id);
  /// The component of a point. Precondition: contains(id).
  Component component(Point_id id);
  /// The number of points in the component of a point. Precondition: contains(id).
  std::size_t size_of(Point_id id);
  /// Whether both points exist and are in one component.
  bool are_connected(Point_id a, Point_id b);
  /// The number of components.
  std::size_t number_of_components();
  /// The number of points in a component that has the most; 0 if there is none.
  std::size_t largest();
  /// In how many independent directions the component of a point wraps around a periodic box: 0, 1
  /// or 2. Precondition: contains(id).
  int wrapping_directions(Point_id id);
  /// The number of components that wrap around a periodic box; 0 in the plane.
  std::size_t number_of_wrapping_components();

  /// Records from the current time on when the two points are connected. They need not exist yet.
  /// Cost: O(1) for each pair and event. Precondition: they differ.
  void watch(const Edge_ids& points);
  /// The times since watch(points), up to the current one, at which the two were connected, in
  /// their order and disjoint; in a periodic box by a path from one to any image of the other one.
  /// Precondition: watch() has been called for the pair.
  std::vector<Time_interval> connected_intervals(const Edge_ids& points);

 private:
  using Tracker = detail::Component_tracker<Traits>;

  std::unique_ptr<Tracker> tracker_;
};

/// The traits follow from the simulation.
template <ContactKineticTraits_2 Traits>
Connected_components(Simulation_2<Traits>&, double) -> Connected_components<Traits>;

extern template class Connected_components<Linear_kinetic_traits_2>;
extern template class Connected_components<Polynomial_kinetic_traits_2>;
extern template class Connected_components<Periodic_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_OBSERVERS_CONNECTED_COMPONENTS_H
