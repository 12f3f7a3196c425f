// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order in which points are inserted into a CGAL triangulation.
//
// CGAL inserts many points in the order of a spatial sort, and begins each search at the point
// before. But while all points are collinear it examines all edges, unless the point is beyond one
// of the two ends: n collinear points, in CGAL's order, take O(n^2).
#ifndef KINETRI_IMPL_TRIANGULATION_INSERTION_ORDER_H
#define KINETRI_IMPL_TRIANGULATION_INSERTION_ORDER_H

#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/enum.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// The end of the longest run of elements, from the first one on, whose points are all on one line.
/// The point of an element is point_of(element). Linear in the length of the run.
template <class Traits, class Iterator, class Point_of>
Iterator end_of_line(Iterator first, Iterator last, const Traits& traits,
                     const Point_of& point_of) {
  const auto compare = traits.compare_xy_2_object();
  const auto orientation = traits.orientation_2_object();
  const auto other = std::find_if(first, last, [&](const auto& element) {
    return compare(point_of(element), point_of(*first)) != CGAL::EQUAL;
  });
  return std::find_if(other, last, [&](const auto& element) {
    return orientation(point_of(*first), point_of(*other), point_of(element)) != CGAL::COLLINEAR;
  });
}

/// The points of elements, as a property map for CGAL.
template <class Element, class Point_of>
struct Points_of_elements {
  /// @{
  /// As property maps have them.
  using key_type = Element;
  using reference = std::invoke_result_t<const Point_of&, const Element&>;
  using value_type = std::remove_cvref_t<reference>;
  using category = boost::readable_property_map_tag;
  /// @}
  Point_of point_of;  ///< the point of an element

  /// The point of an element.
  friend reference get(const Points_of_elements& map, const Element& element) {
    return map.point_of(element);
  }
};

/// Sorts elements so that their points, `point_of(element)`, can be inserted one after the other,
/// with each search from a face at the point before, in expected O(n log n) for well distributed
/// points:
///   - along the line, if all are collinear, so that each point is at or beyond the last end;
///   - else in CGAL's order; but if many of its first points are collinear, one that is not on
///     their line comes early.
/// Returns whether all are collinear. O(n log n) predicates.
template <class Element, class Traits, class Point_of = std::identity>
bool sort_for_insertion(std::vector<Element>& elements, const Traits& traits,
                        const Point_of& point_of = Point_of()) {
  if (elements.empty()) return true;
  if (end_of_line(elements.begin(), elements.end(), traits, point_of) == elements.end()) {
    const auto compare = traits.compare_xy_2_object();
    std::ranges::sort(elements, [&](const Element& a, const Element& b) {
      return compare(point_of(a), point_of(b)) == CGAL::SMALLER;
    });
    return true;
  }
  using Map = Points_of_elements<Element, Point_of>;
  CGAL::spatial_sort(elements.begin(), elements.end(),
                     CGAL::Spatial_sort_traits_adapter_2<Traits, Map>(Map{point_of}, traits));
  constexpr std::ptrdiff_t few = 64;
  const auto off_line = end_of_line(elements.begin(), elements.end(), traits, point_of);
  if (off_line - elements.begin() > few) {
    std::rotate(elements.begin() + 1, off_line, off_line + 1);
  }
  return false;
}

/// Inserts the points of elements in their order; each search begins at the point before. Calls
/// note(vertex, element) with the vertex of the point, which may be that of an earlier element at
/// the same position.
template <class Triangulation, class Element, class Point_of, class Note>
void insert_in_order(Triangulation& triangulation, const std::vector<Element>& elements,
                     const Point_of& point_of, const Note& note) {
  typename Triangulation::Face_handle near;
  for (const Element& element : elements) {
    const typename Triangulation::Vertex_handle v = triangulation.insert(point_of(element), near);
    note(v, element);
    near = v->face();
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_INSERTION_ORDER_H
