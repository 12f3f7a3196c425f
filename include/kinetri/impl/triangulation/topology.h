// SPDX-License-Identifier: GPL-3.0-or-later
//
// The topology of a kinetic triangulation: CGAL's triangulation, and the vertex of each point. It
// stores queue handles in faces and hidden vertices, but does not use the queue.
#ifndef KINETRI_IMPL_TRIANGULATION_TOPOLOGY_H
#define KINETRI_IMPL_TRIANGULATION_TOPOLOGY_H

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/events/event.h"
#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/events/queue_handle.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/kinetic_types.h"
#include "kinetri/impl/triangulation/twins.h"
#include "kinetri/kinetic/instant.h"

namespace kinetri::detail {

/// Vertices, faces, and the points at the vertices.
///
/// Invariant: each point has one vertex, which is in faces, or hidden in the list of one face, or
/// temporarily removed within an event; or it is a twin, hidden by a point with a vertex. The
/// handle of a vertex stays valid until its point is erased or becomes a twin.
///
/// Derives from Kinetic_types, so that users of the topology alone have the types of the
/// triangulation. Traits with points and predicates of the library have the library's topology.
template <class Traits>
class Kinetic_types<Traits>::Own_topology : public Kinetic_types<Traits> {
 public:
  /// No points; predicates are those of the given instant.
  explicit Own_topology(const Instant& instant) : clock_(instant) {}

  /// Takes a triangulation of points whose ids are less than `ids`, and whose predicates follow
  /// clock(). Precondition: there are no points yet.
  void start(Triangulation made, std::size_t ids);

  // ---- points ----

  const Triangulation& triangulation() const { return triangulation_; }
  Triangulation& triangulation() { return triangulation_; }

  /// Of points with a vertex of their own.
  std::size_t number_of_vertices() const noexcept { return number_of_vertices_; }
  /// By point id; null for twins, and if the point has been erased or not yet inserted.
  const std::vector<Vertex_handle>& vertices() const noexcept { return vertices_; }
  Vertex_handle vertex(Point_id id) const { return vertices_[id]; }
  bool has_vertex(Point_id id) const noexcept {
    return id < vertices_.size() && vertices_[id] != Vertex_handle();
  }
  /// Whether the point, which has a vertex, is hidden in a face.
  bool is_hidden(Point_id id) const {
    if constexpr (is_weighted) return vertices_[id]->is_hidden();
    return false;
  }
  std::size_t number_of_hidden_vertices() const {
    if constexpr (is_weighted) return triangulation_.number_of_hidden_vertices();
    return 0;
  }
  /// The points without a vertex.
  const Twins& twins() const noexcept { return twins_; }
  Twins& twins() noexcept { return twins_; }
  const Point_2& point(Point_id id) const {
    return has_vertex(id) ? vertices_[id]->point() : twins_.twin(id).point;
  }
  /// From now on, no two points may have the same trajectory (and weight).
  void refuse_twins() noexcept { refuses_twins_ = true; }
  bool refuses_twins() const noexcept { return refuses_twins_; }
  /// Makes points twins that coincide with others, and takes them out of `points`, which is sorted
  /// by id. Precondition: there are no vertices yet.
  void take_twins(std::vector<Point_2>& points, std::span<const Edge_ids> coincident);
  /// Throws Coincident_trajectories_error, which names one of the pairs, if twins are refused.
  void check_may_coincide(std::span<const Edge_ids> pairs) const;
  bool contains(Point_id id) const { return has_vertex(id) || twins_.contains(id); }
  /// The point that has the vertex of the point: itself, unless it is a twin.
  Point_id shown(Point_id id) const { return has_vertex(id) ? id : twins_.twin(id).shown; }
  /// Reserves ids for `count` points, and returns the first one. Precondition: there are as many
  /// left.
  Point_id give_ids(std::size_t count);
  /// Takes back the ids from `first` on, which no point has.
  void take_back_ids(Point_id first) { vertices_.resize(first); }
  /// Gives a vertex the motion of the change; creates or deletes the vertex if the point is
  /// inserted or erased. That vertex is in no face.
  void set_point(const Change& change);

  /// Whether all weights are equal at all times, as without weights: then the triangulation is the
  /// Delaunay triangulation, and no point is hidden.
  bool are_weights_equal() const { return are_weights_equal_; }
  void set_weights_equal(bool are_equal) { are_weights_equal_ = are_equal; }
  static bool have_equal_weights(std::span<const Point_2> points);

  /// Those with a vertex.
  std::vector<Point_2> points() const;

  // ---- the instant of the predicates ----

  const Instant_clock& clock() const { return clock_; }
  void set_instant(const Instant& instant) { clock_.set(instant); }
  /// Of a periodic box: sets the predicates to those of other traits, at the instant of clock().
  void set_traits(const Traits& traits) requires is_periodic {
    // clang before 16 instantiates this for other traits as well, in an explicit instantiation.
    if constexpr (is_periodic) {
      triangulation_.set_geom_traits(traits.instantaneous_traits(clock_));
    }
  }

  // ---- edges ----

  /// The ids of the ends. The infinite vertex has the id no_point.
  static Edge_ids ids_of(const Edge& edge) {
    return edge_ids(edge.first->vertex(Triangulation::cw(edge.second))->point().id(),
                    edge.first->vertex(Triangulation::ccw(edge.second))->point().id());
  }
  /// The name: in the plane, the ids.
  static Edge_name name_of(const Edge& edge);
  /// The names of all finite edges, sorted.
  std::vector<Edge_name> finite_edges() const;
  /// The edge of a name, if it is in the triangulation.
  std::optional<Edge> find(const Edge_name& name) const;
  Edge_with_mirror with_mirror(const Edge& edge) const;
  /// The index of edge i of a face in the neighbor. Precondition: dimension 2.
  static int mirror_index(Face_handle face, int i) {
    if constexpr (is_periodic) {
      return face->mirror(i);
    } else {  // Without branches, which would be mispredicted.
      const Vertex_handle right = face->vertex(Triangulation::ccw(i));
      return Triangulation::ccw(index_in(face->neighbor(i), right));
    }
  }
  /// Whether this is the chosen side of an edge: a choice by ids, since addresses differ from run
  /// to run.
  static bool is_chosen_side(const Edge& edge) {
    const auto& [face, i] = edge;
    const Point_id left = face->vertex(Triangulation::cw(i))->point().id();
    const Point_id right = face->vertex(Triangulation::ccw(i))->point().id();
    if constexpr (is_periodic) {
      if (left == right) {
        return Lattice_offset_2() <
               Triangulation::offset(face, Triangulation::cw(i), Triangulation::ccw(i));
      }
    }
    return left < right;
  }
  /// The edge from its chosen side: from the other side, certificates are rounded differently.
  static Edge_with_mirror chosen_side(const Edge_with_mirror& edge) {
    return is_chosen_side(edge.here) ? edge : Edge_with_mirror{edge.there, edge.here};
  }
  /// All faces, infinite ones too; in dimension 1, one for each edge.
  std::vector<Face_handle> faces() const;
  /// Calls `function` with the edges that the face owns: one of the two faces owns each edge.
  template <class Function>
  void for_each_own_edge(Face_handle face, Function function) const {
    if (triangulation_.dimension() == 1) return function(Edge(face, 2));
    for (int i = 0; i < 3; ++i) {
      if (face < face->neighbor(i)) function(Edge(face, i));
    }
  }
  /// The outer edges of an edge's quadrilateral, from the corner ccw(i) of the face on.
  Outer_edges outer_edges(const Edge_with_mirror& edge) const;
  /// For an infinite edge: the previous hull vertex, that of the edge, and the next one,
  /// counterclockwise.
  std::array<Vertex_handle, 3> hull_turn(const Edge_with_mirror& infinite_edge) const;
  /// The finite triangle at a hull edge, seen from that edge.
  Edge hull_triangle(const Edge_with_mirror& hull_edge) const {
    return triangulation_.is_infinite(hull_edge.here.first) ? hull_edge.there : hull_edge.here;
  }
  /// The edge that a flip removes and the one that it adds.
  std::pair<Edge_name, Edge_name> flipped_edges(const Edge_with_mirror& edge) const;

  static void set_event(const Edge_with_mirror& edge, Queue_handle handle) {
    edge.here.first->set_event(edge.here.second, handle);
    edge.there.first->set_event(edge.there.second, handle);
  }

  // ---- positions ----

  /// The location of a point at the instant of the predicates, by a walk from `start` if that is
  /// not null; in a periodic box of the image that is nearest to `start`. Precondition:
  /// dimension 2.
  Location locate(const Point_2& point, Face_handle start) const;
  /// The same from where it has been; in a periodic box of the same image.
  Location locate_from(const Point_2& point, const Location& start) const;
  /// Outside the hull, where a walk may end at any hull edge that the point sees: at that with the
  /// least ids of these. Other locations stay. Precondition: the hull is convex at the instant of
  /// the predicates. Cost: the hull edges that the point sees.
  Location at_least_hull_edge(const Point_2& point, const Location& location) const;
  /// The triangle at the location that hides a point with a weight, which may be on the border of
  /// that; a null face if the point is below it, outside the hull, or at the position of a vertex.
  Location hiding_face(const Point_2& point, const Location& location) const;
  /// Where a hidden point is.
  static Location location_of_hidden(Vertex_handle v);
  /// The same place in the face beyond a side of its face.
  static Location beyond(const Point_2& point, const Location& location, int side);
  /// The point that is at a corner of a face, or at a location; in a periodic box the images of
  /// these, against corner 0.
  decltype(auto) corner(Face_handle face, int i) const {
    if constexpr (is_periodic) {
      return triangulation_.corner(face, i, 0);
    } else {
      return (face->vertex(i)->point());
    }
  }
  decltype(auto) point_at(const Location& location, const Point_2& point) const {
    if constexpr (is_periodic) {
      return triangulation_.image(point, location);
    } else {
      return (point);
    }
  }
  /// Appends pairs of the point and others at its location with its trajectory and weight, if they
  /// are not among `changed`, which is sorted.
  void find_coincident(const Point_2& point, const Location& location,
                       std::span<const Point_id> changed, std::vector<Edge_ids>& coincident) const;
  /// A vertex that is probably near a point at about this time. Precondition: there is a point.
  Vertex_handle vertex_near(const Point_2& point, double time) const;

  // ---- changes ----

  /// Whether the dimension stays 2 without the vertex, which is in faces.
  bool can_take_out(Vertex_handle v) const {
    if constexpr (is_periodic) {
      return triangulation_.number_of_vertices() > 1;
    } else {
      return !triangulation_.test_dim_down(v);
    }
  }

  // flip(), remove_from_faces() and note_edges_at() are for the plane. They call note(ids, change)
  // for each finite edge that is added (1) or removed (-1).

  /// Flips an edge with the outer edges `before`. Returns the new edge; `before` are then the outer
  /// edges as seen from outside, the first two those of the face `here` of the new edge.
  Edge_with_mirror flip(const Edge_with_mirror& edge, Outer_edges& before);
  /// Removes a vertex from its faces; the vertex stays, in no face. The new faces in the hole are
  /// Delaunay (regular) at the instant of the predicates, and are stored in `faces`. Returns the
  /// edges around and in the hole, with the handle `listed` until they are scheduled. If memory is
  /// missing, the faces at the vertex are left inconsistent.
  template <class Note>
  std::vector<Edge_with_mirror> remove_from_faces(Vertex_handle v, std::vector<Face_handle>& faces,
                                                  const Note& note);
  /// Inserts a vertex without faces into the triangle or edge of the location.
  void insert_in_faces(Vertex_handle v, const Location& location);
  /// Removes a vertex of degree 3 from its faces. The vertex stays, in no face. Returns the face
  /// that is left, and the two others, which have no vertices and are to be deleted.
  std::array<Face_handle, 3> remove_degree_3(Vertex_handle v);
  /// Takes the faces of another triangulation of the same points; keeps the vertices. Calls
  /// note_hidden(id, was_hidden, is_hidden) with each point that is or was hidden.
  template <class Note_hidden>
  void adopt(Triangulation rebuilt, const Note_hidden& note_hidden);
  /// Hides the vertex in the face at the location or, if that is infinite, in the finite one beside
  /// it.
  void hide_in(Vertex_handle v, const Location& location);
  /// Removes the hidden points from the lists of faces, and returns them. In a periodic box the
  /// faces keep a corner at each of their vertices, except `leaving`.
  static std::vector<Taken_point> take_hidden(std::span<const Face_handle> faces,
                                              Vertex_handle leaving = {});
  /// In a periodic box: where such a point probably is.
  Location location_of(const Taken_point& taken) const;

  /// Calls note(ids, change) with the finite edges at a vertex.
  template <class Note>
  void note_edges_at(Vertex_handle v, int change, const Note& note) const {
    for_each_neighbor(triangulation_, v, [&](Vertex_handle u) {
      note(edge_ids(v->point().id(), u->point().id()), change);
    });
  }

  /// The handle of edges that are in a list, until they are scheduled.
  static constexpr Queue_handle listed = no_event - 1;

 private:
  // Defined in src/triangulation/torus_topology.h.
  Location locate_on_torus(const Point_2& point, Face_handle start) const;
  Vertex_handle vertex_near_on_torus(const Point_2& point, double time) const;

  template <class Place_of>
  Vertex_handle nearest_of_some(const Point_2& point, const Place_of& place_of) const;
  template <class Note>
  std::vector<Edge_with_mirror> list_inside(std::span<const Edge> polygon,
                                            std::vector<Face_handle>& faces,
                                            const Note& note) const;
  void replace_in_faces(Vertex_handle old, Vertex_handle replacement);

  Instant_clock clock_;
  Triangulation triangulation_;
  std::vector<Vertex_handle> vertices_;
  Twins twins_;
  bool refuses_twins_ = false;
  std::size_t number_of_vertices_ = 0;
  bool are_weights_equal_ = true;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_TOPOLOGY_H
