// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangulation of the flat torus, the plane modulo a lattice, from one vertex on: Delaunay or,
// if points have weights, regular. CGAL's data structure stores it but does not change or search
// it, since CGAL finds edges by their vertices: here an edge may be a loop, and two faces may share
// several edges.
#ifndef KINETRI_IMPL_TRIANGULATION_TORUS_TRIANGULATION_H
#define KINETRI_IMPL_TRIANGULATION_TORUS_TRIANGULATION_H

#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/enum.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/impl/events/basic_event.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/kinetic_triangulation_data_structure_2.h"

namespace kinetri::detail {

/// The offset, none if it is 2^31 or more. The smallest integer is none, so that the reverse edge
/// has an offset.
inline std::optional<Lattice_offset_2> to_offset(std::int64_t x, std::int64_t y) {
  constexpr std::int64_t greatest = std::numeric_limits<std::int32_t>::max();
  if (x < -greatest || x > greatest || y < -greatest || y > greatest) return std::nullopt;
  return Lattice_offset_2{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
}

/// A face whose corners are images of points. It stores their offsets against corner 0, so that
/// they are those of edges, and the index that each edge has in the neighbor.
template <class InstantaneousTraits, class FaceBase = Kinetic_face_base_2<InstantaneousTraits>>
class Periodic_face_base_2 : public FaceBase {
 public:
  /// As CGAL requires.
  template <class Tds2>
  struct Rebind_TDS {
    /// The face of the data structure Tds2.
    using Other = Periodic_face_base_2<InstantaneousTraits,
                                       typename FaceBase::template Rebind_TDS<Tds2>::Other>;
  };

  using FaceBase::FaceBase;

  /// The offset of corner i against corner 0. Precondition: 0 <= i < 3.
  Lattice_offset_2 offset(int i) const {
    return i == 0 ? Lattice_offset_2{} : offsets_[static_cast<std::size_t>(i - 1)];
  }
  /// Sets the offsets of corners 1 and 2 against corner 0.
  void set_offsets(Lattice_offset_2 first, Lattice_offset_2 second) { offsets_ = {first, second}; }

  /// The index of edge i in neighbor i. Precondition: 0 <= i < 3.
  int mirror(int i) const { return mirrors_[static_cast<std::size_t>(i)]; }
  /// Stores that index.
  void set_mirror(int i, int mirror) {
    mirrors_[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(mirror);
  }

 private:
  std::array<Lattice_offset_2, 2> offsets_;
  std::array<std::uint8_t, 3> mirrors_ = {0, 0, 0};
};

/// A vertex that, while it is hidden, stores the offset of its image in the face that hides it,
/// against corner 0 of that.
template <class InstantaneousTraits,
          class VertexBase = Kinetic_regular_vertex_base_2<InstantaneousTraits>>
class Periodic_vertex_base_2 : public VertexBase {
 public:
  /// As CGAL requires.
  template <class Tds2>
  struct Rebind_TDS {
    /// The vertex of the data structure Tds2.
    using Other = Periodic_vertex_base_2<InstantaneousTraits,
                                         typename VertexBase::template Rebind_TDS<Tds2>::Other>;
  };

  using VertexBase::VertexBase;

  /// The offset of the hidden image.
  const Lattice_offset_2& offset() const { return offset_; }
  /// Stores it.
  void set_offset(const Lattice_offset_2& offset) { offset_ = offset; }

 private:
  Lattice_offset_2 offset_;
};

/// Predicates of images of points, at one instant. The lattice turns left there: the second vector
/// is to the left of the first one. Of four images, some of one point too, one is always inside or
/// outside of the circle of the others, by a perturbation if necessary (docs/MATH.md, section 4).
template <class T>
concept TorusTraits_2 = requires(const T& traits, const typename T::Point_2& point,
                                 const Lattice_offset_2& offset, const typename T::Image_2& p) {
  { point.id() } -> std::convertible_to<Point_id>;
  { traits.image(point, offset) } -> std::same_as<typename T::Image_2>;
  { traits.orientation_2_object()(p, p, p) } -> std::same_as<CGAL::Orientation>;
  { traits.side_of_oriented_circle_2_object()(p, p, p, p) } -> std::same_as<CGAL::Oriented_side>;
};

/// The same with weights: the circle is the power circle.
template <class T>
concept WeightedTorusTraits_2 = TorusTraits_2<T> &&
    requires(const T& traits, const typename T::Image_2& p) {
  { traits.compare_weight_2_object()(p, p) } -> std::same_as<CGAL::Comparison_result>;
};

/// CGAL's data structure with such faces and, with weights, such vertices.
template <TorusTraits_2 Traits>
struct Torus_data_structure {
  using type = CGAL::Triangulation_data_structure_2<Kinetic_vertex_base_2<Traits>,
                                                    Periodic_face_base_2<Traits>>;
};
template <WeightedTorusTraits_2 Traits>
struct Torus_data_structure<Traits> {
  using type = CGAL::Triangulation_data_structure_2<
      Periodic_vertex_base_2<Traits>,
      Periodic_face_base_2<
          Traits, CGAL::Regular_triangulation_face_base_2<Traits, Kinetic_face_base_2<Traits>>>>;
};

/// An edge would get an offset of 2^31 or more.
class Offset_overflow : public Error {
 public:
  /// Of an image of the point `of` against the point `against`, with the message of what().
  Offset_overflow(Point_id of, Point_id against, const std::string& message)
      : Error(message), of_(of), against_(against) {}
  /// @{
  /// As given to the constructor.
  Point_id of() const noexcept { return of_; }
  Point_id against() const noexcept { return against_; }
  /// @}

 private:
  Point_id of_;
  Point_id against_;
};

/// Vertices, faces, and the links between them.
///
/// With weights, read "regular" for "Delaunay". A point without a power cell is a hidden vertex:
/// `is_hidden()` is true, `face()` is a triangle that an image of it is above, with the `offset()`
/// of that image against corner 0, and it is in the `vertex_list()` of that triangle. Changes of
/// faces do not move hidden vertices: the caller takes them out and hides them again.
///
/// Invariants: the corners of each face are images that turn left, and the faces cover the torus
/// once (problem() checks these). So n vertices have 2n faces and 3n edges, and no face is its own
/// neighbor. The offset of one end of an edge against the other is less than 2^31 in each
/// direction. Only differences of offsets have a meaning: each face sees the lattice from its
/// corner 0.
///
/// An Offset_overflow says that an edge would get a greater offset; the triangulation then keeps
/// its invariants, but may not be Delaunay (except in remove_from_faces, restore_regular, replace).
/// If memory is missing, it can only be destroyed.
template <TorusTraits_2 Traits>
class Torus_triangulation {
 public:
  /// @{
  /// As in CGAL's triangulations.
  using Geom_traits = Traits;
  using Point_2 = typename Traits::Point_2;
  using Triangulation_data_structure = typename Torus_data_structure<Traits>::type;
  using Vertex_handle = typename Triangulation_data_structure::Vertex_handle;
  using Face_handle = typename Triangulation_data_structure::Face_handle;
  using Edge = typename Triangulation_data_structure::Edge;
  enum Locate_type { VERTEX, EDGE, FACE };
  /// @}
  using Image_2 = typename Traits::Image_2;                           ///< a point with an offset
  static constexpr bool is_weighted = WeightedTorusTraits_2<Traits>;  ///< regular, not Delaunay
  /// Two vectors of the lattice, by their offsets.
  using Basis = std::array<Lattice_offset_2, 2>;

  /// The face, edge or vertex at a position.
  struct Location {
    Face_handle face;
    Lattice_offset_2 offset;  ///< of the image that is there, against corner 0 of the face
    Locate_type locus = FACE;
    int index = 0;  ///< of the edge or vertex, if the position is on one
  };

  /// Without vertices.
  explicit Torus_triangulation(const Traits& traits = Traits()) : traits_(traits) {
    tds_.set_dimension(2);
  }
  ~Torus_triangulation() = default;
  Torus_triangulation(const Torus_triangulation&) = delete;
  Torus_triangulation& operator=(const Torus_triangulation&) = delete;
  /// @{
  /// Moves the other triangulation, which must not be used any more. Handles stay valid.
  Torus_triangulation(Torus_triangulation&&) = default;
  Torus_triangulation& operator=(Torus_triangulation&&) = default;
  /// @}

  // ---- structure ----

  const Traits& geom_traits() const { return traits_; }
  /// Sets the predicates.
  void set_geom_traits(const Traits& traits) { traits_ = traits; }
  const Triangulation_data_structure& tds() const { return tds_; }
  /// To create and delete vertices that are in no face, and to store data in faces.
  Triangulation_data_structure& tds() { return tds_; }

  /// 2, or -1 without vertices.
  int dimension() const { return tds_.faces().empty() ? -1 : 2; }
  /// Of those in faces.
  std::size_t number_of_vertices() const { return tds_.faces().size() / 2; }
  /// The number of hidden vertices. O(1).
  std::size_t number_of_hidden_vertices() const { return hidden_; }

  /// @{
  /// As in CGAL's triangulations; there is no infinite vertex.
  static constexpr bool is_infinite(Vertex_handle) { return false; }
  static constexpr bool is_infinite(Face_handle) { return false; }
  static constexpr bool is_infinite(const Edge&) { return false; }
  auto finite_vertex_handles() const {
    if constexpr (is_weighted) {
      return vertex_handles(false);
    } else {
      return tds_.vertex_handles();
    }
  }
  std::vector<Vertex_handle> hidden_vertex_handles() const { return vertex_handles(true); }
  auto finite_face_handles() const { return tds_.face_handles(); }
  auto all_face_handles() const { return tds_.face_handles(); }
  auto all_edges() const { return tds_.edges(); }
  auto finite_edges() const { return tds_.edges(); }
  /// @}

  static int ccw(int i) { return Triangulation_data_structure::ccw(i); }
  static int cw(int i) { return Triangulation_data_structure::cw(i); }

  /// The same edge in its other face.
  static Edge mirror(const Edge& edge) {
    const auto& [face, i] = edge;
    return Edge(face->neighbor(i), face->mirror(i));
  }
  /// The offset of corner i against corner 0 of the face.
  static Lattice_offset_2 offset(Face_handle face, int i) { return face->offset(i); }
  /// The offset of corner `to` against corner `from` of the face.
  static Lattice_offset_2 offset(Face_handle face, int from, int to) {
    return difference(face->offset(to), face->offset(from));
  }

  /// The offset of the corner opposite the edge in its other face against the one in this face.
  static Lattice_offset_2 offset_across(const Edge& edge);
  /// The offset of the corner opposite the edge in its other face against corner `from` of this
  /// face; none if it is 2^31 or more.
  static std::optional<Lattice_offset_2> offset_beyond(const Edge& edge, int from);
  /// The edges opposite `v` in the faces at it. `v` is in faces.
  std::vector<Edge> edges_opposite(Vertex_handle v) const;

  // ---- predicates ----

  /// The corners of the edge's quadrilateral, counterclockwise from corner i of the face on. Their
  /// offsets are against the corner cw(i), which has an edge to all others.
  std::array<Image_2, 4> quadrilateral(const Edge& edge) const;
  /// The corner of the face, with its offset against another corner.
  Image_2 corner(Face_handle face, int i, int against) const {
    return image(face, i, offset(face, against, i));
  }
  CGAL::Orientation orientation(Face_handle face) const {
    return orientation(corner(face, 0, 0), corner(face, 1, 0), corner(face, 2, 0));
  }
  /// Whether the opposite corner beyond the edge is in the circle of the face.
  bool is_violated(const Edge& edge) const;
  /// The image of a point at a location, against corner 0 of its face.
  Image_2 image(const Point_2& point, const Location& location) const {
    return traits_.image(point, location.offset);
  }
  /// Calls function(v, image, image of the point) with each vertex, visible or hidden, that may be
  /// at the location of a point.
  template <class Function>
  void for_each_near(const Point_2& point, const Location& location,
                     const Function& function) const;
  /// Whether the face at the location hides the point there. Precondition: it is not at a vertex.
  bool hides(const Point_2& point, const Location& location) const {
    const Face_handle face = location.face;
    return traits_.side_of_oriented_circle_2_object()(corner(face, 0, 0), corner(face, 1, 0),
                                                      corner(face, 2, 0), image(point, location)) !=
           CGAL::ON_POSITIVE_SIDE;
  }

  /// The location of an image of a point, which is given by its offset against corner 0 of `start`;
  /// of the point itself against corner 0 of some face if `start` is null. The walk passes the
  /// triangles between, whose number grows with the distance. Precondition: there are vertices, and
  /// the triangulation is Delaunay, since the walk may not end else [Devillers, Pion and Teillaud
  /// 2002]; or it ends after `most_steps`, perhaps in another face.
  Location locate(const Point_2& point, Face_handle start = {}, Lattice_offset_2 offset = {},
                  std::size_t most_steps = std::numeric_limits<std::size_t>::max()) const;
  /// The location in a face of the image with that offset against corner i.
  static Location location_near(const Point_2& point, Face_handle face, int i,
                                Lattice_offset_2 against_corner);
  /// a - b. Throws an Error, about these points, if that is 2^31 or more.
  static Lattice_offset_2 checked_difference(Lattice_offset_2 a, Lattice_offset_2 b,
                                             const Point_2& of, const Point_2& against);
  /// The offset of the image at a location against corner i of its face.
  static Lattice_offset_2 offset_against(const Point_2& point, const Location& location, int i) {
    return checked_difference(location.offset, offset(location.face, i), point,
                              location.face->vertex(i)->point());
  }
  /// The same place in the face beyond a side of its face.
  static Location beyond(const Point_2& point, const Location& location, int side);

  // ---- changes ----
  //
  // Defined in src/triangulation/torus_triangulation_impl.h, for the library's own predicates.

  /// What follows the changes of faces. This one does nothing.
  class Journal {
   public:
    virtual ~Journal() = default;
    /// Called before a face changes, if it is not a new one.
    virtual void before_change(Face_handle) {}
    /// Called after a face has been created.
    virtual void created(Face_handle) {}
    /// Called before a face is deleted.
    virtual void deleted(Face_handle) {}
    /// As an argument by default.
    Journal& itself() { return *this; }
  };

  /// Makes the triangulation with one vertex, which is Delaunay. It begins with the diagonals of
  /// the parallelogram of two vectors that span the lattice. The number of flips is that of the
  /// subtractions by which these become shortest vectors. Precondition: the triangulation is empty,
  /// and the determinant of the vectors is 1.
  void insert_first(Vertex_handle v, const Basis& basis = {{{1, 0}, {0, 1}}});
  /// Inserts a vertex without faces into the face or edge of the location. Flips no edge, except
  /// that at the location. Only the edges opposite the vertex may then be violated, if none was.
  void insert_in_faces(Vertex_handle v, const Location& location,
                       Journal& journal = Journal().itself());
  /// Inserts a point, located as by locate(), and makes the triangulation Delaunay. Returns its
  /// vertex, or that of the point with an image in the same place, whose id is another.
  Vertex_handle insert(const Point_2& point, Face_handle start = {}, Lattice_offset_2 offset = {});
  /// The image of a point with the first offset, as if it were in a face at the image of the vertex
  /// with the second one, both against the positions as they were given: where insert() and
  /// locate() may begin.
  static Location start_near(const Point_2& point, Lattice_offset_2 offset, Vertex_handle near,
                             Lattice_offset_2 offset_of_near);

  /// Replaces an edge, (face, i) with the mirror edge (neighbor, j), by the other diagonal of its
  /// quadrilateral, (face, ccw(i)) with the mirror edge (neighbor, ccw(j)). Returns that. Of the
  /// outer edges, (face, ccw(i)) becomes (neighbor, j), and (neighbor, ccw(j)) becomes (face, i).
  /// Does not examine how the faces turn.
  Edge flip(const Edge& edge, Journal& journal = Journal().itself());
  /// Undoes the flip of an edge, which is given as it was before, from both sides. Leaves the faces
  /// that the vertices name. Precondition: the sides of the quadrilateral are four edges.
  static void flip_back(const Edge& edge, const Edge& mirror_edge);
  /// Flips edges until the triangulation is Delaunay. Precondition: all violated edges are among
  /// the given ones. [Lawson 1977] Returns false if that would take more than `most_flips`.
  bool restore_delaunay(std::vector<Edge> edges, Journal& journal = Journal().itself(),
                        std::size_t most_flips = std::numeric_limits<std::size_t>::max());

  /// Removes a vertex from its faces by flips, and makes the triangulation Delaunay. The vertex
  /// stays, in no face. If no flip leads on, the result is false: then, as after an
  /// Offset_overflow, `v` may still be in faces, some of which may be flat, and the triangulation
  /// must be constructed anew.
  bool remove_from_faces(Vertex_handle v, Journal& journal = Journal().itself());
  /// The same without the last step: appends the edges that may be violated to `edges`, and removes
  /// from these those of faces that have been deleted. If the vertex has degree 3, its present
  /// face() is what is left. Precondition: there is another vertex.
  bool take_from_faces(Vertex_handle v, std::vector<Edge>& edges,
                       Journal& journal = Journal().itself());

  /// Removes a vertex of degree 3 from its faces. The vertex stays, in no face. Returns the face
  /// that is left, and the two others, which have no vertices and are to be deleted.
  std::array<Face_handle, 3> remove_degree_3(Vertex_handle v) {
    return remove_degree_3(corner_at(v), Journal().itself());
  }
  /// By how much fewer edges a vertex has after a flip; a loop has two ends.
  static int ends_lost_by_flip(const Edge& edge, Vertex_handle v);

  // With weights:

  /// Restores a triangulation as restore_delaunay; takes out vertices that are hidden, and appends
  /// them to `hidden`, without faces. Where the quadrilateral of a violated edge is not convex, its
  /// corner is above the lifted triangle of the three others. Returns false if the last of these
  /// could not be taken out, as remove_from_faces says.
  bool restore_regular(std::vector<Edge> edges, std::vector<Vertex_handle>& hidden);
  /// Replaces the point of a vertex at the location, whose faces hide none, by another one there.
  void replace(const Location& location, const Point_2& point);
  /// Hides a vertex that has no faces, or that is hidden and in no list, at the location.
  void hide(Vertex_handle v, const Location& location) requires is_weighted {
    if constexpr (is_weighted) {  // See Topology::set_traits.
      if (!v->is_hidden()) ++hidden_;
      v->set_hidden(true);
      v->set_face(location.face);
      v->set_offset(location.offset);
      location.face->vertex_list().push_back(v);
    }
  }
  /// Removes a hidden vertex from the list of its face. It stays hidden. Linear in the length of
  /// the list.
  void take_from_face(Vertex_handle v) requires is_weighted {
    if constexpr (is_weighted) v->face()->vertex_list().remove(v);
  }
  /// Makes a hidden vertex in no list visible. It has no faces yet.
  void show(Vertex_handle v) requires is_weighted {
    if constexpr (is_weighted) {
      --hidden_;
      v->set_hidden(false);
    }
  }
  /// Counts the hidden vertices, after the data structure has been changed as a whole. O(n).
  void count_hidden_vertices() requires is_weighted { hidden_ = hidden_vertex_handles().size(); }

  // ---- checks ----

  /// The first invariant that does not hold, in words; empty if all hold. O(n).
  std::string problem() const;
  /// Whether no edge is violated. O(n).
  bool is_delaunay() const;

 private:
  // Exact where both are offsets of edges with a common end whose other ends have an edge.
  static Lattice_offset_2 difference(Lattice_offset_2 a, Lattice_offset_2 b) {
    return {a.x - b.x, a.y - b.y};
  }
  static void set_offsets(Face_handle face, int i, const std::array<Lattice_offset_2, 3>& offsets);
  static void link(const Edge& here, const Edge& there);
  // Corners are stored as edges: a face, and the index of the corner in it.
  static Edge corner_at(Vertex_handle v) { return Edge(v->face(), v->face()->index(v)); }
  static Edge next_corner(const Edge& corner) {
    const Edge there = mirror(Edge(corner.first, ccw(corner.second)));
    return Edge(there.first, ccw(there.second));
  }
  Image_2 image(Face_handle face, int i, Lattice_offset_2 offset) const {
    return traits_.image(face->vertex(i)->point(), offset);
  }
  CGAL::Orientation orientation(const Image_2& p, const Image_2& q, const Image_2& r) const {
    return traits_.orientation_2_object()(p, q, r);
  }
  void check_new_edges(const Point_2& point, const Location& location) const;
  static bool is_hidden(Vertex_handle v) {
    if constexpr (is_weighted) return v->is_hidden();
    return false;
  }
  std::vector<Vertex_handle> vertex_handles(bool are_hidden) const;
  bool is_flip_away_possible(const Edge& edge, Vertex_handle v, bool may_be_flat) const;
  static std::array<Face_handle, 3> remove_degree_3(const Edge& corner, Journal& journal);
  std::string problem_of_face(Face_handle face) const;
  std::string problem_of_vertices() const;

  Traits traits_;
  Triangulation_data_structure tds_;
  std::size_t hidden_ = 0;
};

/// The triangulation of points at the instant of the predicates, which is near `time`. If points
/// have the same trajectory, modulo the lattice, appends some pairs of them to `coincident`, at
/// least one. Expected O(n log n). Defined in src/triangulation/torus_construction.h, for the
/// library's own predicates.
template <TorusTraits_2 Traits>
Torus_triangulation<Traits> triangulation_of_torus(std::span<const typename Traits::Point_2> points,
                                                   double time, const Traits& now,
                                                   std::vector<Edge_ids>& coincident);

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_TORUS_TRIANGULATION_H
