// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_IMPL_TRIANGULATION_TOPOLOGY_IMPL_H
#define KINETRI_IMPL_TRIANGULATION_TOPOLOGY_IMPL_H

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "kinetri/base/error.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/triangulation/edge_changes.h"
#include "kinetri/impl/triangulation/point_problems.h"
#include "kinetri/impl/triangulation/topology.h"

namespace kinetri::detail {

// ---- points ----

template <class Traits>
void Kinetic_types<Traits>::Own_topology::start(Triangulation made, std::size_t ids) {
  triangulation_ = std::move(made);
  vertices_.resize(ids);
  auto& vertices = triangulation_.tds().vertices();
  for (Vertex_handle v = vertices.begin(); v != vertices.end(); ++v) {
    if (triangulation_.is_infinite(v)) continue;
    vertices_[v->point().id()] = v;
    ++number_of_vertices_;
  }
}

template <class Traits>
Point_id Kinetic_types<Traits>::Own_topology::give_ids(std::size_t count) {
  KINETRI_PRECONDITION(count < no_point - vertices_.size(), too_many_points);
  const auto first = static_cast<Point_id>(vertices_.size());
  vertices_.resize(vertices_.size() + count);
  return first;
}

template <class Traits>
void Kinetic_types<Traits>::Own_topology::set_point(const Change& change) {
  Vertex_handle& v = vertices_[change.point];
  if (!change.motion) {
    if (v == Vertex_handle()) return;
    triangulation_.tds().delete_vertex(v);
    v = Vertex_handle();
    --number_of_vertices_;
    return;
  }
  if (v == Vertex_handle()) {
    v = triangulation_.tds().create_vertex();
    ++number_of_vertices_;
  }
  v->set_point(Point_2(*change.motion, change.point));
}

template <class Traits>
void Kinetic_types<Traits>::Own_topology::take_twins(std::vector<Point_2>& points,
                                                     std::span<const Edge_ids> coincident) {
  Coincident_groups groups;
  for (const auto& [a, b] : coincident) groups.link(a, b);
  const std::vector<Edge_ids> others = groups.others();
  auto next = others.begin();
  std::vector<Point_2> distinct;
  for (const Point_2& point : points) {
    if (next == others.end() || (*next)[1] != point.id()) {
      distinct.push_back(point);
    } else {
      twins_.hide(point, (*next)[0]);
      ++next;
    }
  }
  points = std::move(distinct);
}

// Of the pairs it names the one with the least greater id.
template <class Traits>
void Kinetic_types<Traits>::Own_topology::check_may_coincide(
    std::span<const Edge_ids> pairs) const {
  if (!refuses_twins_ || pairs.empty()) return;
  const auto [a, b] =
      *std::ranges::min_element(pairs, {}, [](const Edge_ids& pair) { return pair[1]; });
  throw Coincident_trajectories_error(a, b);
}

template <class Traits>
bool Kinetic_types<Traits>::Own_topology::have_equal_weights(std::span<const Point_2> points) {
  if constexpr (is_weighted) {
    return std::ranges::all_of(points, [&](const Point_2& point) {
      return kinetri::have_equal_weights(points.front().motion(), point.motion());
    });
  }
  return true;
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::points() const -> std::vector<Point_2> {
  std::vector<Point_2> result;
  result.reserve(number_of_vertices_);
  for (const Vertex_handle v : vertices_) {
    if (v != Vertex_handle()) result.push_back(v->point());
  }
  return result;
}

// ---- edges ----

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::name_of(const Edge& edge) -> Edge_name {
  if constexpr (is_periodic) {
    const auto& [face, i] = edge;
    const int left = Triangulation::cw(i);
    const int right = Triangulation::ccw(i);
    return periodic_edge(face->vertex(left)->point().id(), face->vertex(right)->point().id(),
                         Triangulation::offset(face, left, right));
  } else {
    return ids_of(edge);
  }
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::finite_edges() const -> std::vector<Edge_name> {
  std::vector<Edge_name> edges;
  edges.reserve(3 * number_of_vertices_);
  for (const Face_handle face : faces()) {
    for_each_own_edge(face, [&](const Edge& edge) {
      if (!triangulation_.is_infinite(edge)) edges.push_back(name_of(edge));
    });
  }
  sort_edges(edges);
  return edges;
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::find(const Edge_name& name) const -> std::optional<Edge> {
  const auto& [a, b] = detail::ids_of(name);
  if (!has_vertex(a) || !has_vertex(b) || is_hidden(a) || is_hidden(b)) return std::nullopt;
  std::optional<Edge> result;
  if constexpr (is_periodic) {
    for_each_face_at(triangulation_, vertex(a), [&](Face_handle face, int i) {
      const Edge edge(face, Triangulation::cw(i));
      if (name_of(edge) == name) result = edge;
    });
  } else {
    Edge edge;
    if (triangulation_.is_edge(vertex(a), vertex(b), edge.first, edge.second)) result = edge;
  }
  return result;
}

template <class Traits>
inline auto Kinetic_types<Traits>::Own_topology::with_mirror(const Edge& edge) const
    -> Edge_with_mirror {
  if (!is_periodic && triangulation_.dimension() < 2) return {edge, edge};
  const auto& [face, i] = edge;
  return {edge, Edge(face->neighbor(i), mirror_index(face, i))};
}

template <class Traits>
inline auto Kinetic_types<Traits>::Own_topology::flipped_edges(const Edge_with_mirror& edge) const
    -> std::pair<Edge_name, Edge_name> {
  const auto& [face, i] = edge.here;
  const auto& [neighbor, j] = edge.there;
  const Point_id apex = face->vertex(i)->point().id();
  const Point_id opposite = neighbor->vertex(j)->point().id();
  if constexpr (is_periodic) {
    return {name_of(edge.here),
            periodic_edge(apex, opposite, Triangulation::offset_across(edge.here))};
  } else {
    return {ids_of(edge.here), edge_ids(apex, opposite)};
  }
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::faces() const -> std::vector<Face_handle> {
  std::vector<Face_handle> result;
  if (triangulation_.dimension() < 1) return result;
  if (triangulation_.dimension() == 1) {
    for (const Edge& edge : triangulation_.all_edges()) result.push_back(edge.first);
    return result;
  }
  result.reserve(2 * number_of_vertices_);
  for (const Face_handle face : triangulation_.all_face_handles()) result.push_back(face);
  return result;
}

template <class Traits>
inline auto Kinetic_types<Traits>::Own_topology::outer_edges(const Edge_with_mirror& edge) const
    -> Outer_edges {
  const auto& [face, i] = edge.here;
  const auto& [neighbor, j] = edge.there;
  return {with_mirror(Edge(face, Triangulation::cw(i))),
          with_mirror(Edge(neighbor, Triangulation::ccw(j))),
          with_mirror(Edge(neighbor, Triangulation::cw(j))),
          with_mirror(Edge(face, Triangulation::ccw(i)))};
}

// In a face that lists (infinite, b, a) counterclockwise the hull runs from a to b.
template <class Traits>
auto Kinetic_types<Traits>::Own_topology::hull_turn(const Edge_with_mirror& infinite_edge) const
    -> std::array<Vertex_handle, 3> {
  const auto& [face, i] = infinite_edge.here;
  const Vertex_handle here = face->vertex(i);
  const Vertex_handle there = infinite_edge.there.first->vertex(infinite_edge.there.second);
  const Vertex_handle left = face->vertex(Triangulation::cw(i));
  const Vertex_handle right = face->vertex(Triangulation::ccw(i));
  if (triangulation_.is_infinite(right)) return {here, left, there};
  return {there, right, here};
}

// ---- positions ----

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::locate(const Point_2& point, Face_handle start) const
    -> Location {
  if constexpr (is_periodic) {
    return locate_on_torus(point, start);
  } else {
    Location result;
    result.face = triangulation_.locate(point, result.locus, result.index, start);
    return result;
  }
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::locate_from(const Point_2& point,
                                                      const Location& start) const -> Location {
  if constexpr (is_periodic) {
    return {triangulation_.locate(point, start.face, start.offset)};
  } else {
    return locate(point, start.face);
  }
}

// The hull edges that a point outside sees are next to each other.
template <class Traits>
auto Kinetic_types<Traits>::Own_topology::at_least_hull_edge([[maybe_unused]] const Point_2& point,
                                                             const Location& location) const
    -> Location {
  Location result = location;
  if constexpr (!is_periodic) {
    if (location.locus != Triangulation::OUTSIDE_CONVEX_HULL) return result;
    const auto turn = triangulation_.geom_traits().orientation_2_object();
    const auto hull_edge = [this](Face_handle face) {
      return Edge(face, face->index(triangulation_.infinite_vertex()));
    };
    const auto is_seen = [&](const Edge& edge) {
      return turn(edge.first->vertex(Triangulation::ccw(edge.second))->point(),
                  edge.first->vertex(Triangulation::cw(edge.second))->point(),
                  point) == CGAL::LEFT_TURN;
    };
    const auto look = [&](auto beside) {
      for (Edge edge = beside(hull_edge(location.face)); is_seen(edge); edge = beside(edge)) {
        if (ids_of(edge) < ids_of(hull_edge(result.face))) result.face = edge.first;
      }
    };
    look([&](const Edge& e) { return hull_edge(e.first->neighbor(Triangulation::ccw(e.second))); });
    look([&](const Edge& e) { return hull_edge(e.first->neighbor(Triangulation::cw(e.second))); });
  }
  return result;
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::hiding_face(const Point_2& point,
                                                      const Location& location) const -> Location {
  Location result = location;
  if constexpr (is_weighted) {
    if (location.locus == Triangulation::VERTEX) return {};
    if (triangulation_.is_infinite(location.face)) {
      if (location.locus != Triangulation::EDGE) return {};
      result.face = location.face->neighbor(location.index);
    }
    const auto side = triangulation_.geom_traits().power_side_of_oriented_power_circle_2_object();
    if (side(corner(result.face, 0), corner(result.face, 1), corner(result.face, 2),
             point_at(result, point)) != CGAL::ON_POSITIVE_SIDE) {
      return result;
    }
  }
  return {};
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::location_of_hidden(Vertex_handle v) -> Location {
  Location result;
  result.face = v->face();
  if constexpr (is_periodic) result.offset = v->offset();
  return result;
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::beyond([[maybe_unused]] const Point_2& point,
                                                 const Location& location, int side) -> Location {
  if constexpr (is_periodic) {
    return {Triangulation::beyond(point, location, side)};
  } else {
    return {location.face->neighbor(side)};
  }
}

template <class Traits>
void Kinetic_types<Traits>::Own_topology::find_coincident(const Point_2& point,
                                                          const Location& location,
                                                          std::span<const Point_id> changed,
                                                          std::vector<Edge_ids>& coincident) const {
  const auto is_unchanged = [&](Vertex_handle v) {
    const Point_id other = v->point().id();
    return other != point.id() && !std::ranges::binary_search(changed, other);
  };
  if constexpr (is_periodic) {
    triangulation_.for_each_near(
        point, location, [&](Vertex_handle v, const Image_2& image, const Image_2& image_of_point) {
          if (is_unchanged(v) && same_trajectory(image.motion(), image_of_point.motion())) {
            coincident.push_back(edge_ids(v->point().id(), point.id()));
          }
        });
  } else {
    const auto check = [&](Vertex_handle v) {
      if (!triangulation_.is_infinite(v) && is_unchanged(v) &&
          same_trajectory(v->point().motion(), point.motion())) {
        coincident.push_back(edge_ids(v->point().id(), point.id()));
      }
    };
    const auto check_in = [&](Face_handle face) {
      if constexpr (is_weighted) {
        for (const Vertex_handle v : face->vertex_list()) check(v);
      }
    };
    const auto& [face, locus, i] = location;
    check_in(face);
    if (locus == Triangulation::EDGE) check_in(face->neighbor(i));
    if (locus != Triangulation::VERTEX) return;
    check(face->vertex(i));
    for_each_face_at(triangulation_, face->vertex(i), check_in);
  }
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::vertex_near(const Point_2& point, double time) const
    -> Vertex_handle {
  if constexpr (is_periodic) {
    return vertex_near_on_torus(point, time);
  } else if constexpr (requires { rounded_place(point.motion(), time); }) {
    return nearest_of_some(point,
                           [&](const Point_2& p) { return rounded_place(p.motion(), time); });
  } else {
    return *triangulation_.finite_vertex_handles().begin();
  }
}

// The nearest of about 2 n^(1/3) points, in doubles; a walk from there passes about as many
// triangles. [Muecke, Saias and Zhu 1996]
template <class Traits>
template <class Place_of>
auto Kinetic_types<Traits>::Own_topology::nearest_of_some(const Point_2& point,
                                                          const Place_of& place_of) const
    -> Vertex_handle {
  Vertex_handle nearest;
  const Vector_2 place = place_of(point);
  const auto tries = static_cast<std::size_t>(2 * std::cbrt(number_of_vertices_));
  const std::size_t step = std::max<std::size_t>(1, vertices_.size() / tries);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t id = point.id() % step; id < vertices_.size(); id += step) {
    const Vertex_handle v = vertices_[id];
    if (v == Vertex_handle()) continue;
    const Vector_2 there = place_of(v->point());
    const double dx = there.x - place.x;
    const double dy = there.y - place.y;
    const double distance = dx * dx + dy * dy;
    if (!(distance < least)) continue;
    least = distance;
    nearest = v;
  }
  return nearest != Vertex_handle() ? nearest : *triangulation_.finite_vertex_handles().begin();
}

// ---- changes ----

//         c                  c
//       / | \              /   \           The four outer edges keep their place but get a new
//      a  |  b    ==>     a --- b          opposite vertex, and the diagonal is new.
//       \ | /              \   /
//         d                  d
template <class Traits>
inline auto Kinetic_types<Traits>::Own_topology::flip(const Edge_with_mirror& edge,
                                                      Outer_edges& before) -> Edge_with_mirror {
  const auto [face, i] = edge.here;
  const auto [neighbor, j] = edge.there;
  if constexpr (is_periodic) {
    // Two outer edges may be one, so that what is beyond them may change, too.
    const Edge added = triangulation_.flip(edge.here);
    const std::array<Edge, 4> sides = {Edge(face, Triangulation::cw(i)), Edge(face, i),
                                       Edge(neighbor, Triangulation::cw(j)), Edge(neighbor, j)};
    std::ranges::transform(sides, before.begin(), [](const Edge& side) {
      return Edge_with_mirror{Triangulation::mirror(side), side};
    });
    return {added, Triangulation::mirror(added)};
  }
  triangulation_.tds().flip(face, i);
  before = {{{before[0].there, Edge(face, Triangulation::cw(i))},
             {before[1].there, Edge(face, i)},
             {before[2].there, Edge(neighbor, Triangulation::cw(j))},
             {before[3].there, Edge(neighbor, j)}}};
  return {Edge(face, Triangulation::ccw(i)), Edge(neighbor, Triangulation::ccw(j))};
}

// CGAL removes a copy of the vertex, so that this one keeps its handle.
template <class Traits>
template <class Note>
auto Kinetic_types<Traits>::Own_topology::remove_from_faces(Vertex_handle v,
                                                            std::vector<Face_handle>& faces,
                                                            const Note& note)
    -> std::vector<Edge_with_mirror> {
  std::vector<Edge> link;  // from the side of the faces beyond it, which stay
  for_each_face_at(triangulation_, v, [&](Face_handle face) {
    link.push_back(with_mirror(Edge(face, face->index(v))).there);
  });
  note_edges_at(v, -1, note);
  const Vertex_handle stand_in = triangulation_.tds().create_vertex();
  try {
    stand_in->set_point(v->point());
    replace_in_faces(v, stand_in);
    if constexpr (is_weighted) {
      if (are_weights_equal_) {
        triangulation_.as_delaunay([&](auto& delaunay) { delaunay.remove(stand_in); });
      } else {
        triangulation_.remove(stand_in);
      }
    } else {
      triangulation_.remove(stand_in);
    }
  } catch (...) {
    triangulation_.tds().delete_vertex(stand_in);
    throw;
  }
  return list_inside(link, faces, note);
}

// The edges of a polygon and those inside it, which are new; stores the faces inside in `faces`.
template <class Traits>
template <class Note>
auto Kinetic_types<Traits>::Own_topology::list_inside(std::span<const Edge> polygon,
                                                      std::vector<Face_handle>& faces,
                                                      const Note& note) const
    -> std::vector<Edge_with_mirror> {
  std::vector<Face_handle> beyond;
  for (const Edge& edge : polygon) beyond.push_back(edge.first);
  std::ranges::sort(beyond);
  std::vector<Edge_with_mirror> edges;
  faces = {with_mirror(polygon.front()).there.first};
  for (std::size_t next = 0; next < faces.size(); ++next) {
    const Face_handle face = faces[next];
    for (int i = 0; i < 3; ++i) {
      if (face->event(i) == listed) continue;
      const Edge_with_mirror edge = edges.emplace_back(with_mirror(Edge(face, i)));
      set_event(edge, listed);
      if (std::ranges::binary_search(beyond, edge.there.first)) continue;
      faces.push_back(edge.there.first);
      if (!triangulation_.is_infinite(edge.here)) note(ids_of(edge.here), 1);
    }
  }
  return edges;
}

template <class Traits>
void Kinetic_types<Traits>::Own_topology::insert_in_faces(Vertex_handle v,
                                                          const Location& location) {
  if constexpr (is_periodic) {
    triangulation_.insert_in_faces(v, location);
  } else {
    const auto& [face, locus, i] = location;
    KINETRI_ASSERT(locus != Triangulation::VERTEX, "the point is in the place of no other");
    auto& tds = triangulation_.tds();
    const Vertex_handle created =
        locus == Triangulation::EDGE ? tds.insert_in_edge(face, i) : tds.insert_in_face(face);
    replace_in_faces(created, v);
    tds.delete_vertex(created);
  }
}

//         c                  c
//       / | \              /   \           The first face gets the corner c in place of v, and the
//      /  v  \    ==>     /     \          neighbors of the others.
//     / /   \ \          /       \.
//    a --------- b      a ------- b
template <class Traits>
auto Kinetic_types<Traits>::Own_topology::remove_degree_3(Vertex_handle v)
    -> std::array<Face_handle, 3> {
  if constexpr (is_periodic) {
    return triangulation_.remove_degree_3(v);
  } else {
    const Face_handle first = v->face();
    const int i = index_in(first, v);
    const Face_handle at_b = first->neighbor(Triangulation::ccw(i));
    const Face_handle at_a = first->neighbor(Triangulation::cw(i));
    const Edge beyond_b = with_mirror(Edge(at_b, index_in(at_b, v))).there;
    const Edge beyond_a = with_mirror(Edge(at_a, index_in(at_a, v))).there;
    first->set_vertex(i, at_a->vertex(Triangulation::ccw(index_in(at_a, v))));
    auto& tds = triangulation_.tds();
    tds.set_adjacency(first, Triangulation::ccw(i), beyond_b.first, beyond_b.second);
    tds.set_adjacency(first, Triangulation::cw(i), beyond_a.first, beyond_a.second);
    for (int k = 0; k < 3; ++k) first->vertex(k)->set_face(first);
    for (const Face_handle face : {at_a, at_b}) face->set_vertices();
    v->set_face(Face_handle());
    return {first, at_a, at_b};
  }
}

// Replaces `old` in its faces by `replacement`, which has none.
template <class Traits>
void Kinetic_types<Traits>::Own_topology::replace_in_faces(Vertex_handle old,
                                                           Vertex_handle replacement) {
  std::vector<Face_handle> faces;
  for_each_face_at(triangulation_, old, [&](Face_handle f) { faces.push_back(f); });
  for (const Face_handle f : faces) f->set_vertex(f->index(old), replacement);
  replacement->set_face(faces.front());
}

template <class Traits>
template <class Note_hidden>
void Kinetic_types<Traits>::Own_topology::adopt(Triangulation rebuilt,
                                                [[maybe_unused]] const Note_hidden& note_hidden) {
  auto& tds = triangulation_.tds();
  const auto vertex_here = [&](Vertex_handle there) -> Vertex_handle {
    if constexpr (!is_periodic) {
      if (rebuilt.is_infinite(there)) return triangulation_.infinite_vertex();
    }
    return vertices_[there->point().id()];
  };
  tds.faces().clear();
  tds.faces().swap(rebuilt.tds().faces());
  tds.set_dimension(rebuilt.tds().dimension());
  // Faces have dimension + 1 vertices; in dimension -1 one, the infinite vertex.
  const int corners = std::max(tds.dimension(), 0) + 1;
  for (Face_handle face = tds.faces().begin(); face != tds.faces().end(); ++face) {
    for (int i = 0; i < corners; ++i) face->set_vertex(i, vertex_here(face->vertex(i)));
  }
  auto& vertices = rebuilt.tds().vertices();
  for (Vertex_handle there = vertices.begin(); there != vertices.end(); ++there) {
    vertex_here(there)->set_face(there->face());
  }
  if constexpr (is_weighted) {
    for (Face_handle face = tds.faces().begin(); face != tds.faces().end(); ++face) {
      face->vertex_list().clear();
    }
    for (Vertex_handle there = vertices.begin(); there != vertices.end(); ++there) {
      if (rebuilt.is_infinite(there)) continue;
      const Vertex_handle here = vertex_here(there);
      const bool was_hidden = here->is_hidden();
      here->set_hidden(there->is_hidden());
      here->set_event(no_event);
      if (here->is_hidden()) here->face()->vertex_list().push_back(here);
      if constexpr (is_periodic) here->set_offset(there->offset());
      if (was_hidden || here->is_hidden()) {
        note_hidden(here->point().id(), was_hidden, here->is_hidden());
      }
    }
    triangulation_.count_hidden_vertices();
  }
}

template <class Traits>
void Kinetic_types<Traits>::Own_topology::hide_in(Vertex_handle v, const Location& location) {
  if constexpr (is_weighted && is_periodic) {
    triangulation_.hide(v, location);
  } else if constexpr (is_weighted) {
    Face_handle face = location.face;
    if (triangulation_.dimension() > 0 && triangulation_.is_infinite(face)) {
      face = face->neighbor(face->index(triangulation_.infinite_vertex()));
    }
    triangulation_.hide(v, face);
  }
}

template <class Traits>
auto Kinetic_types<Traits>::Own_topology::take_hidden(std::span<const Face_handle> faces,
                                                      [[maybe_unused]] Vertex_handle leaving)
    -> std::vector<Taken_point> {
  std::vector<Taken_point> result;
  if constexpr (is_weighted) {
    for (const Face_handle face : faces) {
      auto& list = face->vertex_list();
      for (const Vertex_handle v : list) {
        Taken_point& taken = result.emplace_back(Taken_point{v});
        if constexpr (is_periodic) {
          int i = 0;
          while (i < 2 && face->vertex(i) == leaving) ++i;
          taken.near = face->vertex(i);
          taken.offset = Triangulation::offset_against(v->point(), location_of_hidden(v), i);
        }
      }
      list.clear();
    }
  }
  return result;
}

// The certificate of a hidden point fails at once if it is in another face.
template <class Traits>
auto Kinetic_types<Traits>::Own_topology::location_of(const Taken_point& taken) const -> Location {
  if constexpr (is_periodic) {
    constexpr std::size_t few_steps = 8;
    const Point_2& point = taken.vertex->point();
    const Face_handle face = taken.near->face();
    const auto start =
        Triangulation::location_near(point, face, face->index(taken.near), taken.offset);
    return {triangulation_.locate(point, face, start.offset, few_steps)};
  } else {
    return {taken.vertex->face()};
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_TOPOLOGY_IMPL_H
