// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions of Disc_geometry.
#ifndef KINETRI_SRC_SIMULATION_DISC_GEOMETRY_IMPL_H
#define KINETRI_SRC_SIMULATION_DISC_GEOMETRY_IMPL_H

#include "kinetri/algebra/algebraic_number.h"
#include "kinetri/impl/triangulation/incident.h"
#include "kinetri/impl/triangulation/parallel.h"
#include "kinetri/kinetic/certificate_polynomials.h"
#include "simulation/disc_boxes.h"
#include "simulation/disc_geometry.h"

namespace kinetri::detail {

// ---- points ----

template <class Traits>
std::vector<Point_id> Simulation_types<Traits>::Disc_geometry::present_points() const {
  std::vector<Point_id> result;
  for (Point_id id = 0; id < number_of_ids(); ++id) {
    if (contains(id)) result.push_back(id);
  }
  return result;
}

template <class Traits>
bool Simulation_types<Traits>::Disc_geometry::is_without_area(Point_id id) const {
  if constexpr (has_radii) return motion(id).radius == 0 && motion(id).growth == 0;
  return false;
}

template <class Traits>
bool Simulation_types<Traits>::Disc_geometry::is_seed(Point_id id) const {
  if constexpr (has_radii) {
    if (!contains(id)) return false;
    const Motion& disc = motion(id);
    if (disc.radius > 0 && disc.epoch <= current_time().interval().lower) return false;
    return disc.growth > 0 && zero_of_radius(disc) == current_time();
  }
  return false;
}

template <class Traits>
bool Simulation_types<Traits>::Disc_geometry::do_overlap(const Image_2& p, const Image_2& q) const {
  return traits().do_touch(p, q, setup_.diameter(), current_time()) &&
         sign_at(contact_polynomial(p, q, setup_.diameter()), current_time()) == CGAL::NEGATIVE;
}

// ---- images ----

// A bound of the radius of a disc at the present time.
template <class Traits>
double Simulation_types<Traits>::Disc_geometry::greatest_radius_of(const Point_2& p) const {
  if constexpr (has_radii) {
    const Double_interval times = current_time().tight_interval();
    return greatest_radius(p.motion(), times.lower, times);
  }
  return setup_.diameter() / 2;
}

// How many steps the images may be away that touch a disc, of which the radii have this sum. Two
// discs whose diameters are at most the shortest vector touch only if their distance is, too.
template <class Traits>
std::int64_t Simulation_types<Traits>::Disc_geometry::steps(
    [[maybe_unused]] double radii, [[maybe_unused]] const Vectors& vectors) const {
  if constexpr (is_periodic) {
    return setup_.lets_images_overlap() ? vectors.steps(radii) : Vectors::fewest_steps;
  } else {
    return 0;
  }
}

template <class Traits>
template <class Function>
void Simulation_types<Traits>::Disc_geometry::for_each_near([[maybe_unused]] const Point_2& p,
                                                            Point_id other,
                                                            [[maybe_unused]] const Vectors& vectors,
                                                            Function function) const {
  if constexpr (is_periodic) {
    const Point_2& q = point(other);
    const auto radii = greatest_radius_of(p) + greatest_radius_of(q);
    vectors.for_each_near(p, q, steps(radii, vectors), [&](const Lattice_offset_2& offset) {
      function(Disc{other, offset});
    });
  } else {
    function(other);
  }
}

template <class Traits>
bool Simulation_types<Traits>::Disc_geometry::does_overlap_image(const Point_2& p, Point_id other,
                                                                 const Vectors& vectors) const {
  const auto& of_disc = point_of(p, itself(p.id()));
  bool result = false;
  for_each_near(p, other, vectors, [&](const Disc& image) {
    result = result || do_overlap(point_of(image), of_disc);
  });
  return result;
}

template <class Traits>
void Simulation_types<Traits>::Disc_geometry::check_own_images(
    [[maybe_unused]] std::span<const Point_2> discs) const {
  if constexpr (is_periodic) {
    if (discs.empty() || (!setup_.has_response() && !setup_.options().refuses_overlaps) ||
        setup_.lets_images_overlap()) {
      return;
    }
    const Short_vectors<Traits> vectors(traits(), current_time());
    for (const Point_2& p : has_radii ? discs : discs.first(1)) {
      const Disc image = {p.id(), vectors.shortest()};
      if (do_overlap(point_of(p, itself(p.id())), point_of(p, image))) {
        throw_own_image_error(image, current_time());
      }
    }
  }
}

// ---- neighbors ----

template <class Traits>
template <class Function>
void Simulation_types<Traits>::Disc_geometry::for_each_neighbor(Point_id id,
                                                                Function function) const {
  if constexpr (!is_periodic) for_each_coincident_link(id, function);
  if constexpr (has_radii || !is_periodic) {
    if (is_hidden(id)) return for_each_corner(id, function);
  }
  for_each_end_of_edge(id, function);
  for_each_hidden_link(id, function);
}

// Calls `function` with the other ends of the edges of a point that is not hidden.
template <class Traits>
template <class Function>
void Simulation_types<Traits>::Disc_geometry::for_each_end_of_edge(Point_id id,
                                                                   Function function) const {
  const auto vertex = triangulation_.vertex(id);
  if constexpr (is_periodic) {
    using Torus = typename Triangulation::Triangulation;
    for_each_face_at(triangulation_.triangulation(), vertex, [&](auto face, int i) {
      const int k = Torus::ccw(i);
      function(Disc{face->vertex(k)->point().id(), Torus::offset(face, i, k)});
    });
  } else {
    detail::for_each_neighbor(triangulation_.triangulation(), vertex,
                              [&](auto neighbor) { function(neighbor->point().id()); });
  }
}

// Calls `function` with the point that hides the point, or with those that it hides, because their
// motions are the same.
template <class Traits>
template <class Function>
void Simulation_types<Traits>::Disc_geometry::for_each_coincident_link(Point_id id,
                                                                       Function function) const {
  if (triangulation_.number_of_hidden_points() == 0) return;
  if (shown(id) != id) return function(shown(id));
  for (const Point_id other : triangulation_.coincident_points(id)) function(other);
}

// Entries and overlaps store this too, and are faster to read.
template <class Traits>
bool Simulation_types<Traits>::Disc_geometry::is_edge(const Pair& pair) const {
  const auto [a, b] = ids_of(pair);
  if (!contains(a) || !contains(b)) return false;
  bool result = false;
  for_each_neighbor(a, [&](const Disc& other) { result = result || other == second_of(pair); });
  return result;
}

template <class Traits>
template <class Function>
void Simulation_types<Traits>::Disc_geometry::for_each_corner(Point_id id,
                                                              Function function) const {
  if constexpr (has_radii) {
    if (!is_hidden(id) || shown(id) != id || !is_without_area(id)) return;
    const auto vertex = triangulation_.vertex(id);
    const auto face = vertex->face();
    if constexpr (is_periodic) {
      for (int i = 0; i < 3; ++i) {
        const Disc hidden = {id, vertex->offset()};
        function(seen_from(hidden, Disc{face->vertex(i)->point().id(), face->offset(i)}));
      }
    } else {
      const auto& triangulation = triangulation_.triangulation();
      const int dimension = triangulation.dimension();
      if (dimension == 0) return function(triangulation.finite_vertex()->point().id());
      for (int i = 0; i <= dimension; ++i) {
        if (!triangulation.is_infinite(face->vertex(i))) function(face->vertex(i)->point().id());
      }
    }
  }
}

template <class Traits>
auto Simulation_types<Traits>::Disc_geometry::corners_of(Point_id id) const -> std::vector<Disc> {
  std::vector<Disc> result;
  for_each_corner(id, [&](const Disc& corner) { result.push_back(corner); });
  return result;
}

// Calls `function` with the hidden points that a vertex is linked with.
template <class Traits>
template <class Function>
void Simulation_types<Traits>::Disc_geometry::for_each_hidden_link(Point_id id,
                                                                   Function function) const {
  if constexpr (has_radii) {
    if (triangulation_.number_of_hidden_points() == 0) return;
    const auto& triangulation = triangulation_.triangulation();
    if constexpr (!is_periodic) {
      if (triangulation.dimension() < 2) {
        for (const Point_id hidden : present_points()) {
          for_each_corner(hidden, [&](Point_id corner) {
            if (corner == id) function(hidden);
          });
        }
        return;
      }
    }
    for_each_face_at(triangulation, triangulation_.vertex(id), [&](auto face, int i) {
      for (const auto& hidden : face->vertex_list()) {
        const Point_id other = hidden->point().id();
        if (!is_without_area(other)) continue;
        if constexpr (is_periodic) {
          function(seen_from(Disc{id, face->offset(i)}, Disc{other, hidden->offset()}));
        } else {
          function(other);
        }
      }
    });
  }
}

template <class Traits>
template <class Made, class Make>
std::vector<Made> Simulation_types<Traits>::Disc_geometry::make_for_edges(const Make& make) const {
  const auto& triangulation = triangulation_.triangulation();
  std::vector<Made> result;
  result.emplace_back();
  if constexpr (!is_periodic) {
    if (triangulation_.number_of_hidden_points() > 0) {
      for (const Point_id id : present_points()) {
        if (shown(id) != id) make({shown(id), id}, current_time(), result.back());
      }
    }
    if (triangulation.dimension() < 2) {
      for (const Edge_ids& edge : triangulation_.finite_edge_ids()) {
        make(edge, current_time(), result.back());
      }
      for (const Point_id id : present_points()) {
        for_each_corner(id, [&](Point_id corner) {
          make(edge_ids(id, corner), current_time(), result.back());
        });
      }
      return result;
    }
  }
  using Face_handle = typename Triangulation::Triangulation::Face_handle;
  struct Block {
    std::span<const Face_handle> faces;
    Time now;
    Made made = {};
  };
  std::vector<Face_handle> faces;
  faces.reserve(triangulation.tds().faces().size());
  for (const Face_handle face : triangulation.all_face_handles()) faces.push_back(face);
  std::vector<Block> blocks;
  for (const auto block : blocks_of(std::span(std::as_const(faces)))) {
    blocks.push_back({block, current_time().detached()});
  }
  for_each_in_parallel(blocks, [&](Block& block) {
    for (const Face_handle face : block.faces) {
      for (int i = 0; i < 3; ++i) {
        const int j = triangulation.ccw(i);
        const int k = triangulation.cw(i);
        const auto a = face->vertex(j);
        const auto b = face->vertex(k);
        // The two faces of an edge have its ends in opposite order.
        if (triangulation.is_infinite(a) || triangulation.is_infinite(b)) continue;
        Disc other = itself(b->point().id());
        if constexpr (is_periodic) other.offset = triangulation.offset(face, j, k);
        const Point_id id = a->point().id();
        if (is_first(id, other)) make(pair_from(id, other), block.now, block.made);
      }
      if constexpr (has_radii) {
        for (const auto& hidden : face->vertex_list()) {
          const Point_id id = hidden->point().id();
          for_each_corner(
              id, [&](const Disc& corner) { make(pair_of(id, corner), block.now, block.made); });
        }
      }
    }
  });
  for (Block& block : blocks) result.push_back(std::move(block.made));
  return result;
}

// ---- discs nearby ----

template <class Traits>
auto Simulation_types<Traits>::Disc_geometry::overlapping_points(Point_id id,
                                                                 const Traits& traits) const
    -> std::vector<Disc> {
  std::vector<Disc> result;
  const auto touches = [&](const Disc& other) {
    if (!may_touch(id, other, traits, current_time())) return false;
    // A filter that is always unsure, as beyond the range of binary64, would accept all images.
    if constexpr (is_periodic) return may_touch(id, other, traits.exact(), current_time());
    return true;
  };
  const auto add_neighbors = [&](const Disc& of) {
    for_each_neighbor(id_of(of), [&](const Disc& neighbor) {
      const Disc other = beyond(of, neighbor);
      if (other != itself(id) && std::ranges::find(result, other) == result.end() &&
          touches(other)) {
        result.push_back(other);
      }
    });
  };
  add_neighbors(itself(id));
  for (std::size_t i = 0; i < result.size(); ++i) add_neighbors(Disc(result[i]));
  return result;
}

template <class Traits>
std::vector<Point_id> Simulation_types<Traits>::Disc_geometry::discs_about(
    std::span<const Point_id> points) const {
  const auto& triangulation = triangulation_.triangulation();
  if (triangulation.dimension() < 2) return present_points();
  std::vector<Point_id> result;
  for (const Point_id id : points) {
    if (!contains(id)) continue;
    if constexpr (is_periodic) {  // in the plane they are neighbors
      for (const Point_id other : triangulation_.coincident_points(id)) result.push_back(other);
    }
    for (const Disc& owner : owners_in(id)) result.push_back(id_of(owner));
    if (is_hidden(id)) continue;
    for_each_neighbor(id, [&](const Disc& other) { result.push_back(id_of(other)); });
    for_each_face_at(triangulation, triangulation_.vertex(id), [&](auto face) {
      for (const auto& hidden : face->vertex_list()) result.push_back(hidden->point().id());
    });
  }
  return result;
}

// The discs whose power cells meet the disc of the point, and perhaps others that touch it. These
// cells are connected, since the disc is; all of these discs touch it, since the power of a common
// position is not positive. Precondition: the dimension is 2.
template <class Traits>
auto Simulation_types<Traits>::Disc_geometry::owners_in(Point_id id) const -> std::vector<Disc> {
  std::vector<Disc> result = {owner_of_center(id)};
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Disc owner = result[i];
    for_each_neighbor(id_of(owner), [&](const Disc& neighbor) {
      const Disc other = beyond(owner, neighbor);
      if (std::ranges::find(result, other) == result.end() && may_touch(id, other)) {
        result.push_back(other);
      }
    });
  }
  return result;
}

// A visible disc near a hidden one: the one that coincides with it or, if that is hidden too, a
// corner of the triangle that hides both.
template <class Traits>
auto Simulation_types<Traits>::Disc_geometry::corner_over(Point_id id) const -> Disc {
  const Point_id other = shown(id);
  Disc result = itself(other);
  if constexpr (is_periodic) {
    if (other != id) {
      const auto at = traits().instantaneous_traits(Instant{current_time(), Time_side::at});
      result.offset = whole_vectors(at, point(other), at.image(point(id), {}));
    }
  }
  if (!is_hidden(other)) return result;
  const auto vertex = triangulation_.vertex(id);
  const auto face = vertex->face();
  const int i = triangulation_.triangulation().is_infinite(face->vertex(0)) ? 1 : 0;
  const Point_id corner = face->vertex(i)->point().id();
  if constexpr (is_periodic) {
    return beyond(result, seen_from(Disc{other, vertex->offset()}, Disc{corner, face->offset(i)}));
  } else {
    return corner;
  }
}

// The disc whose power cell contains the center of a disc just after the present time: mostly the
// disc itself. From a disc without the least power there an edge leads to one with less.
template <class Traits>
auto Simulation_types<Traits>::Disc_geometry::owner_of_center(Point_id id) const -> Disc {
  const auto& triangulation = triangulation_.triangulation();
  Disc owner = is_hidden(id) ? corner_over(id) : itself(id);
  if (!is_hidden(id)) {
    Motion motion_of_center = motion(id);
    motion_of_center.radius = motion_of_center.growth = 0;
    const Point_2 center(motion_of_center, id);
    const auto& p = point_of(center, itself(id));
    bool is_in_none = true;
    for_each_neighbor(id, [&](const Disc& other) {
      is_in_none =
          is_in_none && !traits().do_touch(p, point_of(other), setup_.diameter(), current_time());
    });
    if (is_in_none) return owner;
  }
  const auto compare_powers = triangulation.geom_traits().compare_power_distance_2_object();
  const auto& p = point_of(itself(id));
  for (bool has_moved = true; has_moved;) {
    has_moved = false;
    Disc best = owner;
    for_each_end_of_edge(id_of(owner), [&](const Disc& neighbor) {
      const Disc other = beyond(owner, neighbor);
      if (compare_powers(p, point_of(other), point_of(best)) == CGAL::SMALLER) {
        best = other;
        has_moved = true;
      }
    });
    owner = best;
  }
  return owner;
}

template <class Traits>
template <class Function>
void Simulation_types<Traits>::Disc_geometry::for_each_close_pair(std::span<const Point_id> ids,
                                                                  Function function) const {
  const Double_interval times = current_time().tight_interval();
  const auto box_of = [&](const Disc& disc) {
    return box_around(point_of(disc).motion(), disc, times.lower, times);
  };
  using Box = Basic_disc_box<Disc>;
  std::vector<Box> boxes;
  if constexpr (is_periodic) {
    // Of each disc the image in one parallelogram of the lattice, with all that may touch it.
    const Vectors lattice = vectors();
    double greatest = 0;
    for (const Point_id id : ids) {
      boxes.push_back(box_of({id, lattice.home(point(id))}));
      greatest = std::max(greatest, greatest_radius_of(point(id)));
    }
    CGAL::Bbox_2 all;
    for (const Box& box : boxes) all += box.bbox();
    std::vector<Box> around;
    for (const Box& box : boxes) {
      const Disc home = box.info();
      const auto reach = greatest_radius_of(point(home.id)) + greatest;
      lattice.for_each_around(home.offset, steps(reach, lattice),
                              [&](const Lattice_offset_2& offset) {
                                const Box there = box_of({home.id, offset});
                                if (CGAL::do_overlap(there.bbox(), all)) around.push_back(there);
                              });
    }
    for_each_pair_of_boxes(boxes, around, [&](const Disc& a, const Disc& b) {
      const Disc from_a = seen_from(a, b);
      if (is_first(a.id, from_a)) function(a.id, from_a);
    });
  } else {
    for (const Point_id id : ids) boxes.push_back(box_of(id));
    for_each_pair_of_boxes(
        boxes, [&](Point_id a, Point_id b) { function(std::min(a, b), std::max(a, b)); });
  }
}

template <class Traits>
template <class Function>
void Simulation_types<Traits>::Disc_geometry::for_each_exact_overlap(const Traits& exact,
                                                                     Function function) const {
  if constexpr (has_radii) {
    for_each_close_pair(present_points(), [&](Point_id a, const Disc& b) {
      if (exact.may_overlap(point_of(itself(a)), point_of(b), setup_.diameter(), current_time())) {
        function(a, b);
      }
    });
  } else {
    for (const Point_id a : present_points()) {
      for (const Disc& b : overlapping_points(a, exact)) {
        if (is_first(a, b)) function(a, b);
      }
    }
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_DISC_GEOMETRY_IMPL_H
