// SPDX-License-Identifier: GPL-3.0-or-later
//
// The construction of the triangulation of a flat torus at a time.
#ifndef KINETRI_SRC_TRIANGULATION_TORUS_CONSTRUCTION_H
#define KINETRI_SRC_TRIANGULATION_TORUS_CONSTRUCTION_H

#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/impl/triangulation/insertion_order.h"
#include "kinetri/kinetic/linear_motion_2.h"
#include "triangulation/static_delaunay.h"
#include "triangulation/torus_triangulation_impl.h"
#include "triangulation/wrapping.h"

namespace kinetri::detail {

/// Copies of points in the plane: of each the one in the parallelogram of a Wrapping, in the order
/// of the points, then those that are in a margin around it.
class Torus_copies {
 public:
  struct Copy {
    std::uint32_t point;            ///< its number
    std::array<std::int8_t, 2> by;  ///< how many of the two short vectors it is moved
  };

  Torus_copies(std::span<const Wrapping::Image> images, const Wrapping& wrapping,
               const Vector_2& margin) {
    const auto add = [&](std::size_t point, int x, int y) {
      const Vector_2& place = images[point].place;
      copies_.push_back({static_cast<std::uint32_t>(point),
                         {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)}});
      places_.push_back(wrapping.position({place.x + x, place.y + y}));
    };
    for (std::size_t i = 0; i < images.size(); ++i) add(i, 0, 0);
    for (std::size_t i = 0; i < images.size(); ++i) {
      for (const int x : {-1, 0, 1}) {
        if (!is_near(images[i].place.x + x, margin.x)) continue;
        for (const int y : {-1, 0, 1}) {
          if ((x != 0 || y != 0) && is_near(images[i].place.y + y, margin.y)) add(i, x, y);
        }
      }
    }
  }

  const std::vector<Vector_2>& places() const { return places_; }
  /// By the number of the point: whether it has copies in the margin.
  std::vector<bool> are_copied(std::size_t points) const {
    std::vector<bool> result(points, false);
    for (std::size_t i = points; i < copies_.size(); ++i) result[copies_[i].point] = true;
    return result;
  }
  const Copy& operator[](std::size_t i) const { return copies_[i]; }

 private:
  static bool is_near(double multiple, double margin) {
    return -margin <= multiple && multiple <= 1 + margin;
  }

  std::vector<Copy> copies_;
  std::vector<Vector_2> places_;
};

/// Of the translates of a triangle of copies one is chosen: that whose *first* corner is not moved.
/// The first is the one with the least number, and the least movement among those.
struct Torus_face_name {
  std::array<std::uint32_t, 3> points;                  ///< from the first corner on
  std::array<std::array<std::int8_t, 2>, 2> movements;  ///< of the two others against the first
  std::size_t first;                                    ///< its index among the corners as given
  bool is_chosen;                                       ///< whether the first is not moved

  explicit Torus_face_name(const std::array<Torus_copies::Copy, 3>& corners) {
    first = 0;
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
      const auto key = [&](std::size_t k) { return std::pair(corners[k].point, corners[k].by); };
      if (key(i) < key(first)) first = i;
    }
    const auto& from = corners[first].by;
    is_chosen = from[0] == 0 && from[1] == 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Torus_copies::Copy& corner = corners[(first + k) % 3];
      points[k] = corner.point;
      if (k == 0) continue;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        movements[k - 1][axis] = static_cast<std::int8_t>(corner.by[axis] - from[axis]);
      }
    }
  }
  friend bool operator==(const Torus_face_name& a, const Torus_face_name& b) {
    return a.points == b.points && a.movements == b.movements;
  }
  struct Hash {
    std::size_t operator()(const Torus_face_name& name) const {
      std::uint64_t hash = 0;
      const auto add = [&hash](std::uint64_t number) {
        hash = (hash ^ number) * 0x9E3779B97F4A7C15;
        hash ^= hash >> 29;
      };
      for (const std::uint32_t point : name.points) add(point);
      for (const auto& [x, y] : name.movements) {
        add(static_cast<std::uint64_t>(16 * (x + 4) + y + 4));
      }
      return static_cast<std::size_t>(hash);
    }
  };
};

/// Builds the triangulation of points at one instant, that of the predicates of a Torus, near
/// `time`.
template <class Torus>
class Torus_construction {
 public:
  using Point_2 = typename Torus::Point_2;
  using Traits = typename Torus::Geom_traits;

  Torus_construction(std::span<const Point_2> points, double time, const Traits& now)
      : points_(points), wrapping_(now.box(), time), now_(now) {
    images_.reserve(points.size());
    for (const Point_2& point : points) {
      images_.push_back(wrapping_.image(rounded_place(point.motion(), time), point.id()));
    }
  }

  /// If points have the same trajectory, modulo the lattice, appends some pairs of them to
  /// `coincident`, at least one. Expected O(n log n).
  Torus build(std::vector<Edge_ids>& coincident) const {
    if constexpr (Torus::is_weighted) {
      const auto weighs_the_same = [&](const Point_2& point) {
        return have_equal_weights(points_.front().motion(), point.motion());
      };
      if (!std::ranges::all_of(points_, weighs_the_same)) return regular(coincident);
    }
    constexpr std::size_t few = 200;  // for so few, insertion takes little time
    if (points_.size() >= few) {
      for (const double width : {4.0, 16.0}) {
        if (std::optional<Torus> made = from_copies(width)) return std::move(*made);
      }
    }
    return by_insertion(coincident);
  }

  /// By insertion, so that near points follow each other: each search begins at the point before.
  /// Precondition: no point is hidden.
  Torus by_insertion(std::vector<Edge_ids>& coincident) const;
  /// The same of points with weights, of which some may be hidden.
  Torus regular(std::vector<Edge_ids>& coincident) const;

 private:
  using Vertex_handle = typename Torus::Vertex_handle;
  using Face_handle = typename Torus::Face_handle;
  using Edge = typename Torus::Edge;

  class Regular;

  std::vector<std::size_t> order_of_insertion() const;
  std::optional<Torus> from_copies(double width) const;
  bool make_faces(const Static_delaunay& found, const Torus_copies& copies, Torus& result) const;

  std::span<const Point_2> points_;
  Wrapping wrapping_;
  const Traits& now_;
  std::vector<Wrapping::Image> images_;  // by the number of the point
};

template <class Torus>
std::vector<std::size_t> Torus_construction<Torus>::order_of_insertion() const {
  using Kernel = CGAL::Simple_cartesian<double>;
  std::vector<std::size_t> in_order(points_.size());
  std::vector<Kernel::Point_2> places;
  for (std::size_t i = 0; i < in_order.size(); ++i) {
    in_order[i] = i;
    places.emplace_back(images_[i].place.x, images_[i].place.y);
  }
  sort_for_insertion(in_order, Kernel(),
                     [&](std::size_t i) -> const Kernel::Point_2& { return places[i]; });
  return in_order;
}

template <class Torus>
Torus Torus_construction<Torus>::by_insertion(std::vector<Edge_ids>& coincident) const {
  Torus result(now_);
  if (points_.empty()) return result;
  const std::vector<std::size_t> in_order = order_of_insertion();
  Vertex_handle near = result.tds().create_vertex();
  near->set_point(points_[in_order.front()]);
  result.insert_first(near, wrapping_.basis());
  Lattice_offset_2 offset_of_near = images_[in_order.front()].offset;
  for (const std::size_t i : std::span(in_order).subspan(1)) {
    const Point_2& point = points_[i];
    const Lattice_offset_2& offset = images_[i].offset;
    const auto start = Torus::start_near(point, offset, near, offset_of_near);
    const Vertex_handle v = result.insert(point, start.face, start.offset);
    if (v->point().id() != point.id()) {
      coincident.push_back(edge_ids(v->point().id(), point.id()));
    } else {
      near = v;
      offset_of_near = offset;
    }
  }
  return result;
}

// The construction of a regular triangulation. A point that is hidden by others stays hidden when
// more are inserted, so the hidden ones are located in the end.
template <class Torus>
class Torus_construction<Torus>::Regular {
 public:
  Regular(const Torus_construction& construction, std::vector<Edge_ids>& coincident)
      : construction_(construction),
        coincident_(coincident),
        result_(construction.now_),
        in_order_(construction.order_of_insertion()),
        is_hidden_(in_order_.size(), false) {
    for (std::size_t i = 0; i < in_order_.size(); ++i) numbers_.emplace(point(i).id(), i);
  }

  Torus build() {
    while (!insert_visible()) result_ = Torus(construction_.now_);
    for (const std::size_t i : in_order_) {
      if (is_hidden_[i]) hide(i);
    }
    return std::move(result_);
  }

 private:
  using Location = typename Torus::Location;

  const Point_2& point(std::size_t i) const { return construction_.points_[i]; }
  const Lattice_offset_2& offset(std::size_t i) const { return construction_.images_[i].offset; }
  std::size_t number(Vertex_handle v) const { return numbers_.at(v->point().id()); }

  // The next search begins at the vertex of point i, or at a corner of the face where it is.
  void go_to(Vertex_handle v, std::size_t i) {
    near_ = v;
    offset_of_near_ = offset(i);
  }
  Location locate(std::size_t i) {
    const auto start = Torus::start_near(point(i), offset(i), near_, offset_of_near_);
    const Location there = result_.locate(point(i), start.face, start.offset);
    const Lattice_offset_2 of_corner = Torus::offset_against(point(i), there, 0);
    near_ = there.face->vertex(0);
    offset_of_near_ = Torus::checked_difference(offset(i), of_corner, point(i), near_->point());
    return there;
  }

  // Returns false if a hidden point cannot be taken out: then all are to be inserted but those that
  // are known to be hidden.
  bool insert_visible() {
    for (const std::size_t i : in_order_) {
      if (!is_hidden_[i] && !insert(i)) return false;
    }
    return true;
  }

  bool insert(std::size_t i) {
    if (result_.dimension() < 2) {
      const Vertex_handle first = new_vertex(i);
      result_.insert_first(first, construction_.wrapping_.basis());
      go_to(first, i);
      return true;
    }
    const Location there = locate(i);
    if (there.locus == Torus::VERTEX) return insert_at_vertex(i, there);
    is_hidden_[i] = result_.hides(point(i), there);
    if (is_hidden_[i]) return true;
    const Vertex_handle v = new_vertex(i);
    result_.insert_in_faces(v, there);
    go_to(v, i);
    return restore(result_.edges_opposite(v));
  }

  // They coincide at all times: the heavier one hides the other.
  bool insert_at_vertex(std::size_t i, const Location& there) {
    const Vertex_handle v = there.face->vertex(there.index);
    const auto order = construction_.now_.compare_weight_2_object()(
        result_.image(point(i), there), result_.corner(there.face, there.index, 0));
    if (order == CGAL::EQUAL) coincident_.push_back(edge_ids(v->point().id(), point(i).id()));
    is_hidden_[order == CGAL::LARGER ? number(v) : i] = true;
    if (order != CGAL::LARGER) return true;
    result_.replace(there, point(i));
    go_to(v, i);
    std::vector<Edge> edges;
    detail::for_each_face_at(result_, v, [&](Face_handle face) {
      for (int side = 0; side < 3; ++side) edges.emplace_back(face, side);
    });
    return restore(std::move(edges));
  }

  bool restore(std::vector<Edge> edges) {
    std::vector<Vertex_handle> hidden;
    const bool is_regular = result_.restore_regular(std::move(edges), hidden);
    for (const Vertex_handle v : hidden) {
      is_hidden_[number(v)] = true;
      if (v->face() == Face_handle()) result_.tds().delete_vertex(v);
    }
    return is_regular;
  }

  void hide(std::size_t i) {
    const Location there = locate(i);
    bool is_twin = false;
    result_.for_each_near(point(i), there,
                          [&](Vertex_handle v, const auto& image, const auto& image_of_point) {
                            if (!same_trajectory(image.motion(), image_of_point.motion())) return;
                            coincident_.push_back(edge_ids(v->point().id(), point(i).id()));
                            is_twin = true;
                          });
    if (!is_twin) result_.hide(new_vertex(i), there);
  }

  Vertex_handle new_vertex(std::size_t i) {
    const Vertex_handle v = result_.tds().create_vertex();
    v->set_point(point(i));
    return v;
  }

  const Torus_construction& construction_;
  std::vector<Edge_ids>& coincident_;
  Torus result_;
  std::vector<std::size_t> in_order_;
  std::vector<bool> is_hidden_;                        // by the number of the point
  std::unordered_map<Point_id, std::size_t> numbers_;  // of the points
  Vertex_handle near_;
  Lattice_offset_2 offset_of_near_;
};

template <class Torus>
Torus Torus_construction<Torus>::regular(std::vector<Edge_ids>& coincident) const {
  return Regular(*this, coincident).build();
}

// From the triangulation in the plane of rounded positions and their copies in a margin, whose
// width is in mean distances of neighbors. None if that is not nearly the triangulation of the
// torus, as its exact conditions say: for instance because circles are greater than the margin, or
// points coincide.
template <class Torus>
std::optional<Torus> Torus_construction<Torus>::from_copies(double width) const {
  const Vector_2 heights = wrapping_.heights();
  const double distance = std::sqrt(heights.x * heights.y / static_cast<double>(points_.size()));
  const Vector_2 margin = {width * distance / heights.x, width * distance / heights.y};
  if (!(margin.x <= 1 && margin.y <= 1)) return std::nullopt;
  const Torus_copies copies(images_, wrapping_, margin);
  const Static_delaunay found = static_delaunay({copies.places(), {}});
  Torus result(now_);
  if (found.faces.empty() || !make_faces(found, copies, result) || !result.problem().empty()) {
    return std::nullopt;
  }
  std::vector<Edge> edges;
  edges.reserve(3 * points_.size());
  for (const Edge& edge : result.all_edges()) edges.push_back(edge);
  // Of cocircular points n^2 flips may be necessary.
  typename Torus::Journal none;
  if (!result.restore_delaunay(std::move(edges), none, result.tds().faces().size())) {
    return std::nullopt;
  }
  return result;
}

// Makes the chosen translates of faces, and links them. Returns false if they do not fit together.
// Only of triangles near the border, whose points all have copies, are there other translates, by
// which they may have to be found.
template <class Torus>
bool Torus_construction<Torus>::make_faces(const Static_delaunay& found, const Torus_copies& copies,
                                           Torus& result) const {
  auto& tds = result.tds();
  std::vector<Vertex_handle> vertices(points_.size());
  for (const Point_id i : found.order) {
    if (i >= points_.size()) continue;
    vertices[i] = tds.create_vertex();
    vertices[i]->set_point(points_[i]);
  }
  const auto is_finite = [](const Static_delaunay::Face& face) {
    return std::ranges::find(face.vertices, no_point) == face.vertices.end();
  };
  const auto name_of = [&](const Static_delaunay::Face& face) {
    const auto& [a, b, c] = face.vertices;
    return Torus_face_name({copies[a], copies[b], copies[c]});
  };
  struct Made {
    Face_handle face;
    std::size_t first;     // the index of the first corner
    std::uint32_t number;  // in `found`
  };
  const std::vector<bool> are_copied = copies.are_copied(points_.size());
  std::unordered_map<Torus_face_name, Made, Torus_face_name::Hash> made_at_border;
  std::vector<Made> made;
  made.reserve(2 * points_.size());
  constexpr auto none = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> position_in_made(found.faces.size(), none);
  for (std::uint32_t f = 0; f < found.faces.size(); ++f) {
    const Static_delaunay::Face& face = found.faces[f];
    if (!is_finite(face)) continue;
    const Torus_face_name name = name_of(face);
    if (!name.is_chosen) continue;
    if (made.size() == 2 * points_.size()) return false;
    std::array<Vertex_handle, 3> corners;
    std::array<std::optional<Lattice_offset_2>, 3> offsets;
    for (std::size_t i = 0; i < 3; ++i) {
      const Torus_copies::Copy& copy = copies[face.vertices[i]];
      corners[i] = vertices[copy.point];
      offsets[i] = wrapping_.moved(images_[copy.point].offset, copy.by);
    }
    if (!offsets[0] || !offsets[1] || !offsets[2]) return false;
    const auto against_0 = [&](std::size_t i) {
      return to_offset(std::int64_t{offsets[i]->x} - offsets[0]->x,
                       std::int64_t{offsets[i]->y} - offsets[0]->y);
    };
    const auto first = against_0(1);
    const auto second = against_0(2);
    if (!first || !second) return false;
    const Face_handle there = tds.create_face(corners[0], corners[1], corners[2]);
    there->set_offsets(*first, *second);
    for (const Vertex_handle v : corners) v->set_face(there);
    position_in_made[f] = static_cast<std::uint32_t>(made.size());
    made.push_back({there, name.first, f});
    const auto is_copied = [&](std::uint32_t point) -> bool { return are_copied[point]; };
    if (std::ranges::all_of(name.points, is_copied) &&
        !made_at_border.emplace(name, made.back()).second) {
      return false;
    }
  }
  if (made.size() != 2 * points_.size()) return false;
  for (const auto& [face, first, number] : made) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t beyond = found.faces[number].neighbors[i];
      const Static_delaunay::Face& neighbor = found.faces[beyond];
      if (!is_finite(neighbor)) return false;
      const auto mirror = static_cast<std::size_t>(std::ranges::find(neighbor.neighbors, number) -
                                                   neighbor.neighbors.begin());
      if (mirror > 2) return false;
      Face_handle there;
      std::size_t j = mirror;
      if (position_in_made[beyond] != none) {
        there = made[position_in_made[beyond]].face;
      } else {
        const Torus_face_name name = name_of(neighbor);
        const auto chosen = made_at_border.find(name);
        if (chosen == made_at_border.end()) return false;
        there = chosen->second.face;
        // The corners of the chosen translate may begin with another one.
        j = (mirror + 3 - name.first + chosen->second.first) % 3;
      }
      face->set_neighbor(static_cast<int>(i), there);
      face->set_mirror(static_cast<int>(i), static_cast<int>(j));
    }
  }
  return true;
}

template <TorusTraits_2 Traits>
Torus_triangulation<Traits> triangulation_of_torus(std::span<const typename Traits::Point_2> points,
                                                   double time, const Traits& now,
                                                   std::vector<Edge_ids>& coincident) {
  return Torus_construction<Torus_triangulation<Traits>>(points, time, now).build(coincident);
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_TRIANGULATION_TORUS_CONSTRUCTION_H
