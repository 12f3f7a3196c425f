// SPDX-License-Identifier: GPL-3.0-or-later
//
// A kinetic triangulation at one time, for queries: exact predicates at the time and just beside
// it, and connected sets of vertices. A triangulation of points in a periodic box is, for queries,
// that of all their images in the plane.
#ifndef KINETRI_SRC_TRIANGULATION_TRIANGULATION_AT_TIME_H
#define KINETRI_SRC_TRIANGULATION_TRIANGULATION_AT_TIME_H

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "algebra/rounded_quotient.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/queried_triangulation.h"
#include "triangulation/whole_vectors.h"

namespace kinetri::detail {

/// An image of a vertex or of a face of the torus: moved by an offset, which is that of corner 0 of
/// a face.
template <class Handle>
struct Image_of {
  Handle handle = {};
  Lattice_offset_2 offset = {};

  friend bool operator==(const Image_of& a, const Image_of& b) {
    return a.handle == b.handle && a.offset == b.offset;
  }
  friend bool operator<(const Image_of& a, const Image_of& b) {
    return a.handle != b.handle ? a.handle < b.handle : a.offset < b.offset;
  }
};

/// Precondition: the time is neither before the present one nor after the next event, and the
/// triangulation does not change. So it is embedded just beside the time. Predicates are exact, at
/// the time itself unless stated otherwise, of points or vertices.
template <KineticTraits_2 Traits>
class Triangulation_at_time {
 public:
  using Types = Kinetic_types<Traits>;
  using Kinetic = Queried_triangulation<Traits>;
  using Triangulation = typename Types::Triangulation;
  using Point_2 = typename Types::Point_2;
  using Time = typename Types::Time;
  using Instantaneous_traits = typename Types::Instantaneous_traits;

  static constexpr bool is_weighted = Types::is_weighted;
  static constexpr bool is_periodic = Types::is_periodic;

  /// @{
  /// In a periodic box: an image.
  using Vertex = std::conditional_t<is_periodic, Image_of<typename Types::Vertex_handle>,
                                    typename Types::Vertex_handle>;
  using Face = std::conditional_t<is_periodic, Image_of<typename Types::Face_handle>,
                                  typename Types::Face_handle>;
  using Name = std::conditional_t<is_periodic, Periodic_image, Point_id>;
  using Place = typename Types::Image_2;  ///< what predicates take
  /// @}
  using Edge_name = typename Types::Edge_name;
  /// Of no point.
  static constexpr Name no_name = [] {
    if constexpr (is_periodic) {
      return Periodic_image();
    } else {
      return no_point;
    }
  }();

  Triangulation_at_time(std::unique_ptr<const Kinetic> kinetic, const Time& time)
      : kinetic_(std::move(kinetic)),
        triangulation_(kinetic_->triangulation()),
        time_(time),
        at_(kinetic_->predicates({time, Time_side::at})),
        beside_(kinetic_->predicates(
            {time, time == kinetic_->current_time() ? Time_side::after : Time_side::before})) {}

  const Kinetic& kinetic() const { return *kinetic_; }
  const Triangulation& triangulation() const { return triangulation_; }
  const Time& time() const { return time_; }
  static Point_id id(const Vertex& v) { return handle(v)->point().id(); }
  static Name name(const Vertex& v) {
    if constexpr (is_periodic) {
      return {id(v), v.offset};
    } else {
      return id(v);
    }
  }
  static Point_id id_of(const Name& name) {
    if constexpr (is_periodic) {
      return name.id;
    } else {
      return name;
    }
  }
  /// In a periodic box the image `there` as the point of the image `here` has it: against its
  /// position as given.
  static Name seen_from([[maybe_unused]] const Name& here, const Name& there) {
    if constexpr (is_periodic) {
      return {there.id, sum(there.offset, reversed(here.offset))};
    } else {
      return there;
    }
  }
  static Edge_name pair_of(const Name& a, const Name& b) {
    if constexpr (is_periodic) {
      return periodic_edge(a.id, b.id, seen_from(a, b).offset);
    } else {
      return edge_ids(a, b);
    }
  }
  /// The vertex at the position of the point or image. Precondition: there is that point.
  Vertex vertex(const Name& of) const {
    if constexpr (is_periodic) {
      const auto shown = kinetic_->vertex(of.id);
      if (shown->point().id() == of.id) return {shown, of.offset};
      return {shown, sum(of.offset, offset_of_hidden(of.id, shown))};
    } else {
      return kinetic_->vertex(of);
    }
  }
  /// The points that the point hides since they coincide with it for a while, by id. They have no
  /// vertices.
  const std::vector<Point_id>& hidden_by(Point_id shown) const {
    return kinetic_->hidden_by(shown);
  }
  /// The same; in a periodic box the images at that of the vertex.
  decltype(auto) names_hidden_by(const Vertex& v) const {
    if constexpr (is_periodic) {
      std::vector<Name> result;
      for (const Point_id hidden : kinetic_->hidden_by(id(v))) {
        result.push_back({hidden, sum(v.offset, reversed(offset_of_hidden(hidden, v.handle)))});
      }
      return result;
    } else {
      return kinetic_->hidden_by(id(v));
    }
  }

  /// The first pair of a point and one that it hides so; none if there is none. O(n).
  std::optional<Edge_name> first_coincident_pair() const {
    const std::optional<Edge_ids> ids = kinetic_->first_coincident_pair();
    if constexpr (is_periodic) {
      if (!ids) return std::nullopt;
      const auto [shown, hidden] = *ids;
      return periodic_edge(shown, hidden,
                           reversed(offset_of_hidden(hidden, kinetic_->vertex(shown))));
    } else {
      return ids;
    }
  }

  /// @{
  /// The ends of an edge, and of a pair of points.
  static std::array<Vertex, 2> ends(const typename Types::Edge& edge) {
    const auto& [face, i] = edge;
    const int first = Triangulation::cw(i);
    const int second = Triangulation::ccw(i);
    if constexpr (is_periodic) {
      return {Vertex{face->vertex(first), {}},
              Vertex{face->vertex(second), Triangulation::offset(face, first, second)}};
    } else {
      return {face->vertex(first), face->vertex(second)};
    }
  }
  std::array<Vertex, 2> ends_of(const Edge_name& pair) const {
    if constexpr (is_periodic) {
      return {vertex({pair.ids[0], {}}), vertex({pair.ids[1], pair.offset})};
    } else {
      return {vertex(pair[0]), vertex(pair[1])};
    }
  }
  /// @}

  // ---- predicates ----

  const Instantaneous_traits& predicates() const { return at_; }
  const Instantaneous_traits& beside() const { return beside_; }

  /// @{
  /// The argument of a predicate.
  static const Place& point(const Place& p) { return p; }
  decltype(auto) point(const Vertex& v) const {
    if constexpr (is_periodic) {
      return at_.image(v.handle->point(), v.offset);
    } else {
      return v->point();
    }
  }
  Place place(const Point_2& p) const {
    if constexpr (is_periodic) {
      return at_.image(p, {});
    } else {
      return p;
    }
  }
  /// @}

  CGAL::Orientation orientation(const auto& p, const auto& q, const auto& r) const {
    return at_.orientation_2_object()(point(p), point(q), point(r));
  }
  /// With weights of the power circle.
  CGAL::Oriented_side side_of_circle(const auto& p, const auto& q, const auto& r,
                                     const auto& s) const {
    return at_.side_of_oriented_circle_2_object()(point(p), point(q), point(r), point(s));
  }
  /// The same for collinear points and the power segment of the first two.
  CGAL::Oriented_side side_of_segment(const auto& p, const auto& q, const auto& r) const {
    return at_.power_side_of_oriented_power_circle_2_object()(point(p), point(q), point(r));
  }
  bool coincide(const auto& p, const auto& q) const {
    return at_.compare_x_2_object()(point(p), point(q)) == CGAL::EQUAL &&
           at_.compare_y_2_object()(point(p), point(q)) == CGAL::EQUAL;
  }
  /// Whether the two have one position and, with weights, one weight.
  bool are_alike(const auto& p, const auto& q) const {
    return coincide(p, q) && weight_side(p, q) == CGAL::ON_ORIENTED_BOUNDARY;
  }
  /// Whether p has less weight than q. Precondition: the two coincide.
  bool is_lighter(const auto& p, const auto& q) const {
    return weight_side(p, q) == CGAL::ON_POSITIVE_SIDE;
  }
  bool is_strictly_between(const auto& p, const auto& q, const auto& r) const {
    return orientation(p, q, r) == CGAL::COLLINEAR &&
           at_.collinear_are_strictly_ordered_along_line_2_object()(point(p), point(q), point(r));
  }
  /// How the distance from p to q compares with that from p to r.
  Comparison_result compare_distance(const auto& p, const auto& q, const auto& r) const {
    return at_.compare_distance_2_object()(point(p), point(q), point(r));
  }
  /// Whether the first vertex is nearer to p than the second, or equally near with a smaller
  /// name.
  bool is_nearer(const auto& p, const Vertex& a, const Vertex& b) const {
    const auto order = compare_distance(p, a, b);
    return order != CGAL::EQUAL ? order == CGAL::SMALLER : name(a) < name(b);
  }
  /// @{
  /// The same as compare_distance, at the time and beside it; with weights of the power of the
  /// position of p to q and r.
  Comparison_result compare_power(const auto& p, const auto& q, const auto& r) const {
    return compare_power(at_, point(p), point(q), point(r));
  }
  Comparison_result compare_power_beside(const auto& p, const auto& q, const auto& r) const {
    return compare_power(beside_, point(p), point(q), point(r));
  }
  /// @}

  // ---- positions ----

  /// The center of the circle, or power circle, through three points.
  Trajectory_2 center(const Vertex& v, const Vertex& a, const Vertex& b) const {
    if constexpr (is_weighted) {
      return weighted_circumcenter_trajectory(point(v), point(a), point(b));
    } else {
      return at_.construct_circumcenter_2_object()(point(v), point(a), point(b)).trajectory();
    }
  }
  static Trajectory_2 vector(const Trajectory_2& here, const Trajectory_2& there) {
    return {there.x * here.w - here.x * there.w, there.y * here.w - here.y * there.w,
            here.w * there.w};
  }
  Trajectory_2 vector(const Vertex& from, const Vertex& to) const {
    return vector(point(from).trajectory(), point(to).trajectory());
  }
  /// The vector from one point to another, turned to the left or to the right.
  Trajectory_2 turned_vector(const Vertex& from, const Vertex& to, bool to_left) const {
    const Trajectory_2 d = vector(from, to);
    return {to_left ? -d.y : d.y, to_left ? d.x : -d.x, d.w};
  }
  /// The position at the time, each coordinate rounded to nearest.
  Vector_2 rounded_position(const Trajectory_2& path) const {
    return {rounded_quotient(path.x, path.w, time_), rounded_quotient(path.y, path.w, time_)};
  }

  // ---- walks ----

  /// Calls `function` with each finite neighbor, counterclockwise.
  template <class Function>
  void for_each_neighbor(const Vertex& v, Function function) const {
    if constexpr (is_periodic) {
      for_each_face_at(triangulation(), v.handle, [&](auto face, int i) {
        const int j = Triangulation::ccw(i);
        function(Vertex{face->vertex(j), sum(v.offset, Triangulation::offset(face, i, j))});
      });
    } else {
      detail::for_each_neighbor(triangulation(), v, function);
    }
  }

  Vertex corner(const Face& face, int i) const {
    if constexpr (is_periodic) {
      return {face.handle->vertex(i), sum(face.offset, face.handle->offset(i))};
    } else {
      return face->vertex(i);
    }
  }
  Face neighbor(const Face& face, int i) const {
    if constexpr (is_periodic) {
      const auto [there, j] = Triangulation::mirror({face.handle, i});
      // The corner that is ccw(i) here.
      const int shared = Triangulation::cw(j);
      return {there, sum(corner(face, Triangulation::ccw(i)).offset,
                         Triangulation::offset(there, shared, 0))};
    } else {
      return face->neighbor(i);
    }
  }
  /// Some face at the vertex.
  Face face_at(const Vertex& v) const {
    if constexpr (is_periodic) {
      const auto face = v.handle->face();
      return {face, sum(v.offset, Triangulation::offset(face, face->index(v.handle), 0))};
    } else {
      return v->face();
    }
  }
  bool is_infinite(const Face& face) const {
    if constexpr (is_periodic) {
      return false;
    } else {
      return triangulation().is_infinite(face);
    }
  }

  /// Calls `function` with each hidden vertex of the faces at `v`; below dimension 2 with all.
  template <class Function>
  void for_each_hidden_near(const Vertex& v, Function function) const {
    if constexpr (is_weighted) {
      const Triangulation& all = triangulation();
      if (all.number_of_hidden_vertices() == 0) return;
      if constexpr (is_periodic) {
        for_each_face_at(all, v.handle, [&](auto face, int i) {
          const Lattice_offset_2 corner = sum(v.offset, Triangulation::offset(face, i, 0));
          for (const auto h : face->vertex_list()) function(Vertex{h, sum(corner, h->offset())});
        });
      } else {
        if (all.dimension() == 2) {
          return for_each_face_at(all, v, [&](auto face) {
            for (const Vertex& h : face->vertex_list()) function(h);
          });
        }
        for (auto h = all.hidden_vertices_begin(); h != all.hidden_vertices_end(); ++h) {
          function(Vertex(h));
        }
      }
    }
  }

  /// The vertices that edges connect with `v` within the set of vertices for which belongs(u), then
  /// the hidden vertices of the set in faces at those, perhaps several times.
  template <class Belongs>
  std::vector<Vertex> connected(const Vertex& v, Belongs belongs) const {
    std::vector<Vertex> result = {v};
    std::set<Name> seen = {name(v)};
    for (std::size_t i = 0; i < result.size(); ++i) {
      for_each_neighbor(Vertex(result[i]), [&](const Vertex& u) {
        if (seen.insert(name(u)).second && belongs(u)) result.push_back(u);
      });
    }
    const std::size_t visible = result.size();
    for (std::size_t i = 0; i < visible; ++i) {
      for_each_hidden_near(Vertex(result[i]), [&](const Vertex& h) {
        if (belongs(h)) result.push_back(h);
      });
    }
    return result;
  }

  /// The names of all vertices that are like `v` (are_alike), in ascending order, `v` included.
  /// Edges connect those with a cell beside the time, if the common cell has an area.
  std::vector<Name> all_at(const Vertex& v) const {
    std::vector<Name> result;
    for (const Vertex& u : connected(v, [&](const Vertex& w) { return are_alike(w, v); })) {
      result.push_back(name(u));
    }
    std::ranges::sort(result);
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// A visible vertex, probably near the position. Precondition: there is a point.
  Vertex visible_near(const Point_2& position) const {
    const auto v = visible_beside(kinetic_->vertex_near(position));
    if constexpr (is_periodic) {
      const Place here = place(position);
      const Lattice_basis_2 basis = Wrapping(at_.box(), time_.to_double()).basis();
      // The position is in a parallelogram whose corners are images of v.
      const Lattice_offset_2 first = whole_vectors(at_, v->point(), here, basis);
      const Lattice_offset_2 second = sum(first, basis[0]);
      Vertex nearest = {v, first};
      for (const auto& offset : {second, sum(first, basis[1]), sum(second, basis[1])}) {
        const Vertex corner = {v, offset};
        if (compare_power_beside(here, corner, nearest) == CGAL::SMALLER) nearest = corner;
      }
      return nearest;
    } else {
      return v;
    }
  }

  // ---- hidden vertices ----

  /// Whether a triangle hides the vertex.
  static bool is_hidden(const Vertex& v) {
    if constexpr (is_weighted) return handle(v)->is_hidden();
    return false;
  }
  /// The corners of the triangle that hides a hidden vertex; below dimension 2 of the edge, or the
  /// one vertex.
  std::vector<Vertex> corners_over(const Vertex& v) const {
    std::vector<Vertex> result;
    if constexpr (is_weighted) {
      const auto hidden = handle(v);
      if constexpr (is_periodic) {
        const Face face = {hidden->face(), sum(v.offset, reversed(hidden->offset()))};
        for (int i = 0; i < 3; ++i) result.push_back(corner(face, i));
      } else {
        const int dimension = triangulation().dimension();
        if (dimension < 1) return {triangulation().finite_vertex()};
        for (int i = 0; i <= dimension; ++i) result.push_back(hidden->face()->vertex(i));
      }
    }
    return result;
  }

 private:
  static typename Types::Vertex_handle handle(const Vertex& v) {
    if constexpr (is_periodic) {
      return v.handle;
    } else {
      return v;
    }
  }

  // The position of a hidden point is that of an image of the point that hides it: the offset.
  Lattice_offset_2 offset_of_hidden(Point_id hidden, typename Types::Vertex_handle shown) const {
    return whole_vectors(at_, shown->point(), place(kinetic_->point(hidden)));
  }

  // The vertex itself, or one that hides it.
  typename Types::Vertex_handle visible_beside(typename Types::Vertex_handle v) const {
    if constexpr (is_weighted) {
      if (v->is_hidden()) {
        if constexpr (!is_periodic) {
          if (triangulation().dimension() < 1) return triangulation().finite_vertex();
        }
        return v->face()->vertex(0);
      }
    }
    return v;
  }

  CGAL::Oriented_side weight_side(const auto& p, const auto& q) const {
    if constexpr (is_weighted) {
      return at_.power_side_of_oriented_power_circle_2_object()(point(p), point(q));
    } else {
      return CGAL::ON_ORIENTED_BOUNDARY;
    }
  }
  static Comparison_result compare_power(const Instantaneous_traits& instant, const Place& p,
                                         const Place& q, const Place& r) {
    if constexpr (is_weighted) {
      return instant.compare_power_distance_2_object()(p, q, r);
    } else {
      return instant.compare_distance_2_object()(p, q, r);
    }
  }

  std::unique_ptr<const Kinetic> kinetic_;
  const Triangulation& triangulation_;
  Time time_;
  Instantaneous_traits at_;      // the time
  Instantaneous_traits beside_;  // the side of it on which the triangulation is Delaunay
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_TRIANGULATION_AT_TIME_H
