// SPDX-License-Identifier: GPL-3.0-or-later
//
// The types that the parts of a kinetic triangulation share.
#ifndef KINETRI_IMPL_TRIANGULATION_KINETIC_TYPES_H
#define KINETRI_IMPL_TRIANGULATION_KINETIC_TYPES_H

#include <CGAL/Delaunay_triangulation_2.h>

#include <array>
#include <concepts>
#include <optional>
#include <type_traits>

#include "kinetri/base/ids.h"
#include "kinetri/impl/events/basic_event.h"
#include "kinetri/impl/triangulation/kinetic_triangulation_data_structure_2.h"
#include "kinetri/impl/triangulation/regular_triangulation.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"

namespace kinetri::detail {

/// The triangulation of moving points, regular if they have weights, else Delaunay: of CGAL, or of
/// the flat torus, if they are in a periodic box.
template <class Traits>
struct Triangulation_of {
  using type = CGAL::Delaunay_triangulation_2<
      typename Traits::Instantaneous_traits,
      Kinetic_triangulation_data_structure_2<typename Traits::Instantaneous_traits>>;
};
template <WeightedKineticTraits_2 Traits>
requires(!PeriodicKineticTraits_2<Traits>) struct Triangulation_of<Traits> {
  using type = Regular_triangulation<typename Traits::Instantaneous_traits>;
};

template <PeriodicKineticTraits_2 Traits>
struct Triangulation_of<Traits> {
  using type = Torus_triangulation<typename Traits::Instantaneous_traits>;
};

/// The face, edge or vertex at a position.
template <class Triangulation>
struct Location_in {
  typename Triangulation::Face_handle face;  ///< infinite beyond the hull
  typename Triangulation::Locate_type locus = Triangulation::FACE;
  int index = 0;  ///< of the edge or vertex, if the position is on one
};
template <class Traits>
struct Location_in<Torus_triangulation<Traits>> : Torus_triangulation<Traits>::Location {};

/// A point that has been hidden in a face that changes; in a periodic box with a vertex near it.
template <class Vertex_handle>
struct Taken_point {
  Vertex_handle vertex;
  Vertex_handle near = {};       ///< which stays in faces
  Lattice_offset_2 offset = {};  ///< of the hidden image against an image of that
};

/// What an event does to a point: gives it another motion or, with none, erases it.
template <class Motion>
struct Point_change {
  Point_id point;                ///< which one
  std::optional<Motion> motion;  ///< from then on
};

/// An edge with its mirror edge: the edge in each of its two faces. In dimension 1 `there` is
/// `here`.
template <class Edge>
struct Edge_with_mirror {
  Edge here;
  Edge there;
};

/// Whether these are the library's own traits for the plane.
template <class Traits>
inline constexpr bool is_for_plane = std::is_same_v<Traits, Linear_kinetic_traits_2> ||
                                     std::is_same_v<Traits, Polynomial_kinetic_traits_2> ||
                                     std::is_same_v<Traits, Disc_kinetic_traits_2> ||
                                     std::is_same_v<Traits, Polynomial_disc_kinetic_traits_2>;
/// Whether several threads can execute the events of these traits: the library's own.
template <class Traits>
inline constexpr bool has_region_runs =
    is_for_plane<Traits> || std::is_same_v<Traits, Periodic_kinetic_traits_2> ||
    std::is_same_v<Traits, Periodic_disc_kinetic_traits_2>;

/// The library's traits with the motions of other traits.
template <class Traits>
using Library_traits = Basic_kinetic_traits_2<typename Traits::Motion>;

/// Whether the triangulations of both traits have the same points and predicates.
template <class Own, class Traits>
concept HasTriangulationOf = std::same_as < typename Triangulation_of<Own>::type,
typename Triangulation_of<Traits>::type > ;

/// The traits for which parts that know no certificates are compiled: the library's own, if they
/// have the same points and predicates, as most derived traits do, else the given ones.
template <class Traits>
struct Geometry_of {
  using type = Traits;
};
template <class Traits>
requires(is_for_plane<Library_traits<Traits>>&&
             HasTriangulationOf<Traits, Library_traits<Traits>>) struct Geometry_of<Traits> {
  using type = Library_traits<Traits>;
};

/// The types of the traits and of the triangulation, and the parts of a triangulation, which are
/// members so that they can use these types.
template <class Traits>
struct Kinetic_types {
  using Triangulation = typename Triangulation_of<Traits>::type;
  using Vertex_handle = typename Triangulation::Vertex_handle;
  using Face_handle = typename Triangulation::Face_handle;
  using Edge = typename Triangulation::Edge;
  using Edge_with_mirror = detail::Edge_with_mirror<Edge>;
  /// The outer edges of the quadrilateral of an edge, counterclockwise.
  using Outer_edges = std::array<Edge_with_mirror, 4>;
  using Motion = typename Traits::Motion;
  using Point_2 = typename Traits::Point_2;
  using Change = Point_change<Motion>;
  using Time = Algebraic_number;
  using Location = Location_in<Triangulation>;
  using Taken_point = detail::Taken_point<Vertex_handle>;
  using Instantaneous_traits = typename Traits::Instantaneous_traits;

  static constexpr bool is_weighted = WeightedKineticTraits_2<Traits>;
  static constexpr bool is_periodic = PeriodicKineticTraits_2<Traits>;
  using Geometry = typename Geometry_of<Traits>::type;
  /// Whether points and predicates are those of this library, in the plane.
  static constexpr bool has_library_geometry = is_for_plane<Geometry>;

  using Image_2 = Certified_point_2<Traits>;  ///< in the plane: the point
  /// A point of a certificate: that of a vertex or, in a periodic box, an image of it.
  using Corner = std::conditional_t<is_periodic, Image_2, const Point_2*>;
  /// What names an edge.
  using Edge_name = std::conditional_t<is_periodic, Periodic_edge, Edge_ids>;

  // Parameters and results of the parts, each in the header of the first part that has it.
  struct Certificate_points;
  struct Subject;
  struct Entry;

  // The parts, each in the header of its name. A part uses those above it; Point_changes uses all.
  class Twins;
  class Own_topology;
  using Topology = typename Kinetic_types<Geometry>::Own_topology;
  class Static_construction;
  class Rounded_construction;
  class Certification;
  class Schedule;
  class Event_reporter;
  class Decisions;
  class Updates;
  class Moved_points;
  class Repair;
  class Hidden_events;
  class Event_loop;
  class Change_planner;
  class Point_changes;
  struct Kinetic_core;
};

template <class Traits>
using Topology = typename Kinetic_types<Traits>::Topology;
template <class Traits>
using Certification = typename Kinetic_types<Traits>::Certification;
template <class Traits>
using Schedule = typename Kinetic_types<Traits>::Schedule;
template <class Traits>
using Event_reporter = typename Kinetic_types<Traits>::Event_reporter;
template <class Traits>
using Decisions = typename Kinetic_types<Traits>::Decisions;
template <class Traits>
using Kinetic_core = typename Kinetic_types<Traits>::Kinetic_core;

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_KINETIC_TYPES_H
