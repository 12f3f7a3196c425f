// SPDX-License-Identifier: GPL-3.0-or-later
//
// The definitions of Torus_triangulation.
#ifndef KINETRI_SRC_TRIANGULATION_TORUS_TRIANGULATION_IMPL_H
#define KINETRI_SRC_TRIANGULATION_TORUS_TRIANGULATION_IMPL_H

#include "kinetri/algebra/number_types.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/torus_triangulation.h"

namespace kinetri::detail {

// ---- offsets and links ----

template <TorusTraits_2 Traits>
Lattice_offset_2 Torus_triangulation<Traits>::checked_difference(Lattice_offset_2 a,
                                                                 Lattice_offset_2 b,
                                                                 const Point_2& of,
                                                                 const Point_2& against) {
  const std::int64_t x = std::int64_t{a.x} - b.x;
  const std::int64_t y = std::int64_t{a.y} - b.y;
  if (const auto offset = to_offset(x, y)) return *offset;
  throw Offset_overflow(
      of.id(), against.id(),
      "the image of point " + std::to_string(of.id()) + " next to point " +
          std::to_string(against.id()) + " is moved by (" + std::to_string(x) + ", " +
          std::to_string(y) +
          ") vectors of the box; expected less than 2^31 of each: give positions that are closer "
          "together, or stop before the points or the box have moved so far");
}

// Sets the offsets of the corners i, ccw(i), cw(i), which are all against the same image.
template <TorusTraits_2 Traits>
void Torus_triangulation<Traits>::set_offsets(Face_handle face, int i,
                                              const std::array<Lattice_offset_2, 3>& offsets) {
  std::array<Lattice_offset_2, 3> of_corner;
  for (const Lattice_offset_2& o : offsets) {
    of_corner[static_cast<std::size_t>(i)] = o;
    i = ccw(i);
  }
  face->set_offsets(difference(of_corner[1], of_corner[0]), difference(of_corner[2], of_corner[0]));
}

template <TorusTraits_2 Traits>
inline void Torus_triangulation<Traits>::link(const Edge& here, const Edge& there) {
  here.first->set_neighbor(here.second, there.first);
  here.first->set_mirror(here.second, there.second);
  there.first->set_neighbor(there.second, here.first);
  there.first->set_mirror(there.second, here.second);
}

// Less than 2^31 by way of a common neighbor, unless the sum of two offsets is more.
template <TorusTraits_2 Traits>
std::optional<Lattice_offset_2> Torus_triangulation<Traits>::offset_beyond(const Edge& edge,
                                                                           int from) {
  const auto& [face, i] = edge;
  const auto [neighbor, j] = mirror(edge);
  const Lattice_offset_2 to_left = offset(face, from, cw(i));
  const Lattice_offset_2 left_to_opposite = offset(neighbor, ccw(j), j);
  const std::int64_t x = std::int64_t{to_left.x} + left_to_opposite.x;
  const std::int64_t y = std::int64_t{to_left.y} + left_to_opposite.y;
  return to_offset(x, y);
}

// Throws an Offset_overflow if it is too great.
template <TorusTraits_2 Traits>
inline Lattice_offset_2 Torus_triangulation<Traits>::offset_across(const Edge& edge) {
  const auto& [face, i] = edge;
  const auto [neighbor, j] = mirror(edge);
  return checked_difference(offset(neighbor, ccw(j), j), offset(face, cw(i), i),
                            neighbor->vertex(j)->point(), face->vertex(i)->point());
}

template <TorusTraits_2 Traits>
auto Torus_triangulation<Traits>::edges_opposite(Vertex_handle v) const -> std::vector<Edge> {
  std::vector<Edge> result;
  detail::for_each_face_at(*this, v,
                           [&](Face_handle face, int i) { result.emplace_back(face, i); });
  return result;
}

template <TorusTraits_2 Traits>
auto Torus_triangulation<Traits>::vertex_handles(bool are_hidden) const
    -> std::vector<Vertex_handle> {
  std::vector<Vertex_handle> result;
  for (const Vertex_handle v : tds_.vertex_handles()) {
    if (is_hidden(v) == are_hidden) result.push_back(v);
  }
  return result;
}

// ---- predicates ----

template <TorusTraits_2 Traits>
inline auto Torus_triangulation<Traits>::quadrilateral(const Edge& edge) const
    -> std::array<Image_2, 4> {
  const auto& [face, i] = edge;
  const auto [neighbor, j] = mirror(edge);
  return {image(face, i, offset(face, cw(i), i)), image(face, ccw(i), offset(face, cw(i), ccw(i))),
          image(neighbor, j, offset(neighbor, ccw(j), j)), image(face, cw(i), {})};
}

template <TorusTraits_2 Traits>
inline bool Torus_triangulation<Traits>::is_violated(const Edge& edge) const {
  const auto corners = quadrilateral(edge);
  return traits_.side_of_oriented_circle_2_object()(corners[0], corners[1], corners[3],
                                                    corners[2]) == CGAL::ON_POSITIVE_SIDE;
}

template <TorusTraits_2 Traits>
inline auto Torus_triangulation<Traits>::location_near(const Point_2& point, Face_handle face,
                                                       int i, Lattice_offset_2 against_corner)
    -> Location {
  const Lattice_offset_2 back = offset(face, i, 0);
  return {face, checked_difference(against_corner, back, point, face->vertex(0)->point())};
}

template <TorusTraits_2 Traits>
inline auto Torus_triangulation<Traits>::beyond(const Point_2& point, const Location& location,
                                                int side) -> Location {
  const Face_handle face = location.face;
  const auto [neighbor, j] = mirror(Edge(face, side));
  return location_near(point, neighbor, cw(j), offset_against(point, location, ccw(side)));
}

template <TorusTraits_2 Traits>
template <class Function>
void Torus_triangulation<Traits>::for_each_near(const Point_2& point, const Location& location,
                                                const Function& function) const {
  const auto visit = [&](const Location& there, Vertex_handle v, Lattice_offset_2 offset) {
    function(v, traits_.image(v->point(), offset), image(point, there));
  };
  const auto visit_hidden = [&](const Location& there) {
    if constexpr (is_weighted) {
      for (const Vertex_handle v : there.face->vertex_list()) visit(there, v, v->offset());
    }
  };
  const auto& [face, to_point, locus, index] = location;
  visit_hidden(location);
  if (locus == EDGE) visit_hidden(beyond(point, location, index));
  if (locus != VERTEX) return;
  visit(location, face->vertex(index), offset(face, index));
  const Lattice_offset_2 against_vertex = offset_against(point, location, index);
  detail::for_each_face_at(*this, face->vertex(index), [&](Face_handle at, int i) {
    // The face of the location may have other corners at the vertex.
    if (at != location.face || i != location.index) {
      visit_hidden(location_near(point, at, i, against_vertex));
    }
  });
}

template <TorusTraits_2 Traits>
auto Torus_triangulation<Traits>::locate(const Point_2& point, Face_handle start,
                                         Lattice_offset_2 offset_at_start,
                                         std::size_t most_steps) const -> Location {
  KINETRI_PRECONDITION(dimension() == 2, "there are no points; expected at least one");
  Location at;
  at.face = start != Face_handle() ? start : tds_.faces().begin();
  at.offset = offset_at_start;
  for (int entered = -1;;) {  // the edge that the walk has crossed; it is on its left
    const Face_handle face = at.face;
    const Image_2 place = traits_.image(point, at.offset);
    const std::array<Image_2, 3> corners = {image(face, 0, offset(face, 0)),
                                            image(face, 1, offset(face, 1)),
                                            image(face, 2, offset(face, 2))};
    const auto corner = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
    int zeros = 0;
    int sum_of_zeros = 0;
    int crossed = -1;
    for (int k = 1; k <= 3 && crossed < 0; ++k) {
      const int i = (entered + k) % 3;
      if (i == entered) continue;
      const CGAL::Orientation side = orientation(corner(ccw(i)), corner(cw(i)), place);
      if (side == CGAL::RIGHT_TURN) crossed = i;
      if (side != CGAL::COLLINEAR) continue;
      ++zeros;
      sum_of_zeros += i;
    }
    if (crossed < 0) {
      at.locus = zeros == 0 ? FACE : zeros == 1 ? EDGE : VERTEX;
      at.index = zeros == 2 ? 3 - sum_of_zeros : sum_of_zeros;
      return at;
    }
    if (most_steps-- == 0) return at;
    at = beyond(point, at, crossed);
    entered = face->mirror(crossed);
  }
}

// ---- insertion ----

template <TorusTraits_2 Traits>
void Torus_triangulation<Traits>::insert_first(Vertex_handle v, const Basis& basis) {
  KINETRI_PRECONDITION(dimension() < 2, "the triangulation is not empty; expected no vertices");
  const auto checked = [&](Lattice_offset_2 a, Lattice_offset_2 b) {
    return checked_difference(a, b, v->point(), v->point());
  };
  const Lattice_offset_2 first = checked(basis[0], {});
  const Lattice_offset_2 second = checked(basis[1], {});
  const Lattice_offset_2 diagonal = checked(first, {-second.x, -second.y});
  KINETRI_PRECONDITION(
      std::int64_t{first.x} * second.y - std::int64_t{first.y} * second.x == 1,
      "the two vectors do not span the lattice; expected offsets whose determinant is 1");
  const Face_handle right = tds_.create_face(v, v, v);
  const Face_handle left = tds_.create_face(v, v, v);
  right->set_offsets(first, diagonal);
  left->set_offsets(diagonal, second);
  link(Edge(right, 0), Edge(left, 1));
  link(Edge(right, 1), Edge(left, 2));
  link(Edge(right, 2), Edge(left, 0));
  v->set_face(right);
  restore_delaunay(edges_opposite(v));
}

// Throws an Error if one of the edges from the location to the corners around it is too long.
template <TorusTraits_2 Traits>
void Torus_triangulation<Traits>::check_new_edges(const Point_2& point,
                                                  const Location& location) const {
  const auto& [face, to_point, locus, index] = location;
  for (int i = 0; i < 3; ++i) {
    checked_difference(to_point, offset(face, i), point, face->vertex(i)->point());
  }
  if (locus != EDGE) return;
  const auto [neighbor, j] = mirror(Edge(face, index));
  checked_difference(difference(to_point, offset(face, ccw(index))), offset(neighbor, cw(j), j),
                     point, neighbor->vertex(j)->point());
}

//            2
//          / | \              The face keeps the corners 1 and 2, and the others get two new faces.
//        /   v   \            No two sides of the face are one edge, so that each side moves alone.
//      /  /     \  \          A vertex on an edge makes one of the three flat, until that edge is
//     0 ----------- 1         flipped.
template <TorusTraits_2 Traits>
void Torus_triangulation<Traits>::insert_in_faces(Vertex_handle v, const Location& location,
                                                  Journal& journal) {
  const Face_handle face = location.face;
  KINETRI_PRECONDITION(location.locus != VERTEX,
                       "there is a vertex at the location; expected a face or an edge");
  const std::array<Vertex_handle, 3> corner = {face->vertex(0), face->vertex(1), face->vertex(2)};
  const Lattice_offset_2 first = offset(face, 1);
  const Lattice_offset_2 second = offset(face, 2);
  check_new_edges(v->point(), location);
  journal.before_change(face);
  const std::array<Face_handle, 3> faces = {face, tds_.create_face(corner[0], v, corner[2]),
                                            tds_.create_face(corner[0], corner[1], v)};
  journal.created(faces[1]);
  journal.created(faces[2]);
  link(Edge(faces[1], 1), mirror(Edge(face, 1)));
  link(Edge(faces[2], 2), mirror(Edge(face, 2)));
  face->set_vertex(0, v);
  set_offsets(face, 0, {location.offset, first, second});
  faces[1]->set_offsets(location.offset, second);
  faces[2]->set_offsets(first, location.offset);
  link(Edge(face, 1), Edge(faces[1], 0));
  link(Edge(face, 2), Edge(faces[2], 0));
  link(Edge(faces[1], 2), Edge(faces[2], 1));
  corner[0]->set_face(faces[1]);
  corner[1]->set_face(face);
  corner[2]->set_face(face);
  v->set_face(face);
  if (location.locus == EDGE) {
    flip(Edge(faces[static_cast<std::size_t>(location.index)], location.index), journal);
  }
}

template <TorusTraits_2 Traits>
auto Torus_triangulation<Traits>::insert(const Point_2& point, Face_handle start,
                                         Lattice_offset_2 offset) -> Vertex_handle {
  Location location;
  if (dimension() == 2) {
    location = locate(point, start, offset);
    if (location.locus == VERTEX) return location.face->vertex(location.index);
  }
  const Vertex_handle v = tds_.create_vertex();
  v->set_point(point);
  if (dimension() < 2) {
    insert_first(v);
    return v;
  }
  try {
    insert_in_faces(v, location);
  } catch (...) {
    tds_.delete_vertex(v);
    throw;
  }
  restore_delaunay(edges_opposite(v));
  return v;
}

template <TorusTraits_2 Traits>
auto Torus_triangulation<Traits>::start_near(const Point_2& point, Lattice_offset_2 offset,
                                             Vertex_handle near, Lattice_offset_2 offset_of_near)
    -> Location {
  const Face_handle face = near->face();
  return location_near(point, face, face->index(near),
                       checked_difference(offset, offset_of_near, point, near->point()));
}

// ---- flips ----

//         c                  c
//       / | \              /   \           The sides a c and b d go to the other face. These two,
//       as
//      a  |  b    ==>     a --- b          any opposite sides, may be one edge: of a parallelogram
//       \ | /              \   /           that covers the torus, both pairs are.
//         d                  d
template <TorusTraits_2 Traits>
auto Torus_triangulation<Traits>::flip(const Edge& edge, Journal& journal) -> Edge {
  const auto [face, i] = edge;
  const auto [neighbor, j] = mirror(edge);
  const Vertex_handle here = face->vertex(i);        // a
  const Vertex_handle there = neighbor->vertex(j);   // b
  const Vertex_handle right = face->vertex(ccw(i));  // d
  const Vertex_handle left = face->vertex(cw(i));    // c
  // All offsets against `left`.
  const Lattice_offset_2 to_here = offset(face, cw(i), i);
  const Lattice_offset_2 to_there = offset(neighbor, ccw(j), j);
  const Lattice_offset_2 to_right = offset(face, cw(i), ccw(i));
  offset_across(edge);  // throws if that is too great
  journal.before_change(face);
  journal.before_change(neighbor);

  // Two sides move from one face to the other. If they are one edge, the mirror edges move, too.
  const Edge left_side(face, ccw(i));
  const Edge right_side(neighbor, ccw(j));
  const Edge left_side_after(neighbor, j);
  const Edge right_side_after(face, i);
  const auto moved = [&](const Edge& side) {
    return side == left_side ? left_side_after : side == right_side ? right_side_after : side;
  };
  const Edge beyond_left = moved(mirror(left_side));
  const Edge beyond_right = moved(mirror(right_side));

  face->set_vertex(cw(i), there);
  neighbor->set_vertex(cw(j), here);
  set_offsets(face, i, {to_here, to_right, to_there});
  set_offsets(neighbor, j, {to_there, {}, to_here});
  link(left_side_after, beyond_left);
  link(right_side_after, beyond_right);
  link(left_side, right_side);
  if (left->face() == face) left->set_face(neighbor);
  if (right->face() == neighbor) right->set_face(face);
  return left_side;
}

// See the figure of flip().
template <TorusTraits_2 Traits>
void Torus_triangulation<Traits>::flip_back(const Edge& edge, const Edge& mirror_edge) {
  const auto [face, i] = edge;
  const auto [neighbor, j] = mirror_edge;
  const Vertex_handle right = face->vertex(ccw(i));     // d
  const Vertex_handle left = neighbor->vertex(ccw(j));  // c
  // All offsets against `left`.
  const Lattice_offset_2 to_here = offset(neighbor, ccw(j), cw(j));
  const Lattice_offset_2 to_there = offset(neighbor, ccw(j), j);
  const Lattice_offset_2 to_right = difference(to_here, offset(face, ccw(i), i));
  const Edge beyond_left = mirror(Edge(neighbor, j));
  const Edge beyond_right = mirror(Edge(face, i));

  face->set_vertex(cw(i), left);
  neighbor->set_vertex(cw(j), right);
  set_offsets(face, i, {to_here, to_right, {}});
  set_offsets(neighbor, j, {to_there, {}, to_right});
  link(edge, mirror_edge);
  link(Edge(face, ccw(i)), beyond_left);
  link(Edge(neighbor, ccw(j)), beyond_right);
}

// A flip stores its four outer edges again, so that an edge on the stack that has moved since is
// there a second time.
template <TorusTraits_2 Traits>
bool Torus_triangulation<Traits>::restore_delaunay(std::vector<Edge> edges, Journal& journal,
                                                   std::size_t most_flips) {
  while (!edges.empty()) {
    const Edge edge = edges.back();
    edges.pop_back();
    if (!is_violated(edge)) continue;
    if (most_flips-- == 0) return false;
    const auto [face, i] = flip(edge, journal);
    const auto [neighbor, j] = mirror(Edge(face, i));
    edges.insert(edges.end(), {Edge(face, cw(i)), Edge(face, ccw(i)), Edge(neighbor, cw(j)),
                               Edge(neighbor, ccw(j))});
  }
  return true;
}

// ---- removal ----

template <TorusTraits_2 Traits>
int Torus_triangulation<Traits>::ends_lost_by_flip(const Edge& edge, Vertex_handle v) {
  const auto& [face, i] = edge;
  const auto [neighbor, j] = mirror(edge);
  const auto is_at = [v](Vertex_handle corner) { return corner == v ? 1 : 0; };
  return is_at(face->vertex(cw(i))) + is_at(face->vertex(ccw(i))) - is_at(face->vertex(i)) -
         is_at(neighbor->vertex(j));
}

// Whether the two faces after a flip turn left, or are flat at `v` if that is allowed.
template <TorusTraits_2 Traits>
bool Torus_triangulation<Traits>::is_flip_away_possible(const Edge& edge, Vertex_handle v,
                                                        bool may_be_flat) const {
  const auto& [face, i] = edge;
  const auto corners = quadrilateral(edge);
  const auto is_allowed = [&](CGAL::Orientation turn, Vertex_handle at) {
    return turn == CGAL::LEFT_TURN || (turn == CGAL::COLLINEAR && may_be_flat && at == v);
  };
  return is_allowed(orientation(corners[0], corners[1], corners[2]), face->vertex(ccw(i))) &&
         is_allowed(orientation(corners[2], corners[3], corners[0]), face->vertex(cw(i)));
}

template <TorusTraits_2 Traits>
bool Torus_triangulation<Traits>::remove_from_faces(Vertex_handle v, Journal& journal) {
  if (number_of_vertices() == 1) {
    for (const Face_handle face : tds_.face_handles()) {
      journal.before_change(face);
      journal.deleted(face);
    }
    tds_.faces().clear();
    v->set_face(Face_handle());
    return true;
  }
  std::vector<Edge> edges;
  if (!take_from_faces(v, edges, journal)) return false;
  restore_delaunay(std::move(edges), journal);
  return true;
}

// Flips edges away from the vertex until it has three. Faces that are flat at the vertex are needed
// if it is on a diagonal of its neighbors, as in the middle of a square.
template <TorusTraits_2 Traits>
bool Torus_triangulation<Traits>::take_from_faces(Vertex_handle v, std::vector<Edge>& edges,
                                                  Journal& journal) {
  std::vector<Face_handle> changed;  // Each flip is within the faces at the vertex.
  int degree = 0;
  detail::for_each_face_at(*this, v, [&](Face_handle face, int) {
    changed.push_back(face);
    ++degree;
  });

  Edge corner = corner_at(v);
  bool may_be_flat = false;
  for (int refused = 0; degree > 3;) {
    const Edge edge(corner.first, cw(corner.second));
    const int lost = ends_lost_by_flip(edge, v);
    if (lost > 0 && degree - lost >= 3 && is_flip_away_possible(edge, v, may_be_flat)) {
      flip(edge, journal);
      degree -= lost;
      refused = 0;
      may_be_flat = false;
      continue;
    }
    corner = next_corner(corner);
    if (++refused < degree) continue;
    if (may_be_flat) return false;
    may_be_flat = true;
    refused = 0;
  }

  const auto [kept, second, third] = remove_degree_3(corner, journal);
  const std::array deleted = {second, third};
  std::erase_if(edges,
                [&](const Edge& e) { return e.first == deleted[0] || e.first == deleted[1]; });
  for (const Face_handle f : changed) {
    if (f == deleted[0] || f == deleted[1]) continue;
    for (int side = 0; side < 3; ++side) edges.emplace_back(f, side);
  }
  for (const Face_handle left_over : deleted) tds_.delete_face(left_over);
  return true;
}

// Three faces: one with two corners at the vertex would have a loop, beyond which is another one.
template <TorusTraits_2 Traits>
auto Torus_triangulation<Traits>::remove_degree_3(const Edge& corner, Journal& journal)
    -> std::array<Face_handle, 3> {
  const auto [face, i] = corner;
  const Vertex_handle v = face->vertex(i);
  const auto [second, j] = next_corner(corner);
  const auto [third, k] = next_corner(Edge(second, j));
  // Against the corner that the first two faces share with v.
  const Lattice_offset_2 to_apex = offset(second, ccw(j), cw(j));
  const Lattice_offset_2 to_right = offset(face, cw(i), ccw(i));
  const Edge beyond_second = mirror(Edge(second, j));
  const Edge beyond_third = mirror(Edge(third, k));
  for (const Face_handle at_vertex : {face, second, third}) journal.before_change(at_vertex);
  face->set_vertex(i, second->vertex(cw(j)));
  set_offsets(face, i, {to_apex, to_right, {}});
  link(Edge(face, ccw(i)), beyond_second);
  link(Edge(face, cw(i)), beyond_third);
  for (int corner_left = 0; corner_left < 3; ++corner_left) {
    face->vertex(corner_left)->set_face(face);
  }
  v->set_face(Face_handle());
  for (const Face_handle left_over : {second, third}) {
    journal.deleted(left_over);
    left_over->set_vertices();
  }
  return {face, second, third};
}

// ---- weights ----

template <TorusTraits_2 Traits>
bool Torus_triangulation<Traits>::restore_regular(std::vector<Edge> edges,
                                                  std::vector<Vertex_handle>& hidden) {
  while (!edges.empty()) {
    const Edge edge = edges.back();
    edges.pop_back();
    if (!is_violated(edge)) continue;
    const auto corners = quadrilateral(edge);
    const auto turns_left = [&](std::size_t p, std::size_t q, std::size_t r) {
      return orientation(corners[p], corners[q], corners[r]) == CGAL::LEFT_TURN;
    };
    const bool is_right_convex = turns_left(0, 1, 2);
    if (is_right_convex && turns_left(2, 3, 0)) {
      const auto [face, i] = flip(edge);
      const auto [neighbor, j] = mirror(Edge(face, i));
      edges.insert(edges.end(), {Edge(face, cw(i)), Edge(face, ccw(i)), Edge(neighbor, cw(j)),
                                 Edge(neighbor, ccw(j))});
    } else {
      const auto& [face, i] = edge;
      hidden.push_back(face->vertex(is_right_convex ? cw(i) : ccw(i)));
      if (!take_from_faces(hidden.back(), edges)) return false;
    }
  }
  return true;
}

// The image of the new point with an offset is that of the old one with another one.
template <TorusTraits_2 Traits>
void Torus_triangulation<Traits>::replace(const Location& location, const Point_2& point) {
  const auto& [face_there, to_point, locus, index] = location;
  const Vertex_handle v = face_there->vertex(index);
  const Lattice_offset_2 to_vertex = offset(face_there, index);
  const auto checked = [&](Lattice_offset_2 a, Lattice_offset_2 b) {
    return checked_difference(a, b, point, v->point());
  };
  const Lattice_offset_2 back = checked(to_vertex, to_point);
  std::vector<Face_handle> faces;  // each once
  detail::for_each_face_at(*this, v, [&](Face_handle face, int i) {
    if (face->index(v) == i) faces.push_back(face);
  });
  for (const Face_handle face : faces) {
    std::array<Lattice_offset_2, 3> offsets;
    for (int i = 0; i < 3; ++i) {
      auto& to_corner = offsets[static_cast<std::size_t>(i)];
      to_corner = offset(face, i);
      if (face->vertex(i) == v) to_corner = checked(to_corner, back);
    }
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
      offsets[i] = checked(offsets[i], offsets[0]);
    }
    face->set_offsets(offsets[1], offsets[2]);
  }
  v->set_point(point);
}

// ---- checks ----

template <TorusTraits_2 Traits>
bool Torus_triangulation<Traits>::is_delaunay() const {
  for (const Face_handle face : tds_.face_handles()) {
    for (int i = 0; i < 3; ++i) {
      if (is_violated(Edge(face, i))) return false;
    }
  }
  return true;
}

// Faces that turn left and fit together have angles of pi each. Each of n vertices has one or more
// walks around it, with angles of a multiple of 2 pi, not zero. So if there are 2n faces, each has
// one walk with 2 pi, and the faces cover the torus. How often, the sum of their areas says, which
// stays the same while all points are moved to one: then it is an integer.
template <TorusTraits_2 Traits>
std::string Torus_triangulation<Traits>::problem() const {
  Integer doubled_area = 0;
  for (const Face_handle face : tds_.face_handles()) {
    if (std::string problem = problem_of_face(face); !problem.empty()) return problem;
    const Lattice_offset_2 a = offset(face, 1);
    const Lattice_offset_2 b = offset(face, 2);
    doubled_area += Integer(a.x) * b.y - Integer(a.y) * b.x;
  }
  if (std::string problem = problem_of_vertices(); !problem.empty()) return problem;
  if (dimension() == 2 && doubled_area != 2) {
    return "the faces have " + doubled_area.str() + " times half the area of the box; expected 2";
  }
  return "";
}

template <TorusTraits_2 Traits>
std::string Torus_triangulation<Traits>::problem_of_face(Face_handle face) const {
  const auto name = [&] {
    std::string result = "the face";
    for (int i = 0; i < 3; ++i) {
      result += ' ';
      result += std::to_string(face->vertex(i)->point().id());
      result += " (" + std::to_string(offset(face, i).x);
      result += ", " + std::to_string(offset(face, i).y) + ")";
    }
    return result;
  };
  for (int i = 0; i < 3; ++i) {
    const Edge edge(face, i);
    const auto [neighbor, j] = mirror(edge);
    if (mirror(Edge(neighbor, j)) != edge || face->vertex(cw(i)) != neighbor->vertex(ccw(j)) ||
        face->vertex(ccw(i)) != neighbor->vertex(cw(j)) ||
        offset(face, cw(i), ccw(i)) != offset(neighbor, ccw(j), cw(j))) {
      return name() + " does not fit its neighbor at edge " + std::to_string(i);
    }
  }
  if (orientation(face) != CGAL::LEFT_TURN) {
    return name() + " does not turn left";
  }
  return "";
}

template <TorusTraits_2 Traits>
std::string Torus_triangulation<Traits>::problem_of_vertices() const {
  std::size_t vertices = 0;
  for (const Vertex_handle v : tds_.vertex_handles()) {
    if (v->face() == Face_handle() || is_hidden(v)) continue;
    ++vertices;
    if (!v->face()->has_vertex(v)) {
      return "the face of point " + std::to_string(v->point().id()) + " has no such corner";
    }
  }
  if (tds_.faces().size() != 2 * vertices) {
    return std::to_string(vertices) + " vertices have " + std::to_string(tds_.faces().size()) +
           " faces; expected twice as many as vertices";
  }
  return "";
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_TORUS_TRIANGULATION_IMPL_H
