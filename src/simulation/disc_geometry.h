// SPDX-License-Identifier: GPL-3.0-or-later
//
// Positions, neighbors and overlaps of the discs of a simulation. All functions are const.
#ifndef KINETRI_SRC_SIMULATION_DISC_GEOMETRY_H
#define KINETRI_SRC_SIMULATION_DISC_GEOMETRY_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "simulation/short_vectors.h"
#include "simulation/simulation_setup.h"

namespace kinetri::detail {

/// The discs at the present time of the triangulation.
///
/// A *neighbor* of a point is one with which it has an edge or a link. A point that coincides with
/// others for a while is *linked* with the one that hides it, which has the edges. A point of
/// radius 0 that a triangle hides is linked with its corners: when it enters a disc, no third disc
/// need overlap both, but one of these corners contains the point as well (docs/MATH.md, section
/// 8). In a periodic box neighbors are images, and discs that coincide have no links.
template <class Traits>
class Simulation_types<Traits>::Disc_geometry {
 public:
  /// The others must outlive this object.
  Disc_geometry(const Simulation_setup& setup, const Triangulation& triangulation)
      : setup_(setup), triangulation_(triangulation) {}

  const Simulation_setup& setup() const { return setup_; }
  const Traits& traits() const { return setup_.traits(); }
  const Time& current_time() const { return triangulation_.current_time(); }

  // ---- points ----

  const Point_2& point(Point_id id) const { return triangulation_.point(id); }
  const Motion& motion(Point_id id) const { return point(id).motion(); }
  bool contains(Point_id id) const { return triangulation_.contains(id); }
  bool is_hidden(Point_id id) const { return triangulation_.is_hidden(id); }
  /// The point that has the vertex of a point: another one if that has the same motion.
  Point_id shown(Point_id id) const { return triangulation_.vertex(id)->point().id(); }
  Point_id number_of_ids() const { return triangulation_.next_id(); }
  /// The ids of the points, sorted. O(n).
  std::vector<Point_id> present_points() const;
  /// Whether the radius of a disc is 0 from now on.
  bool is_without_area(Point_id id) const;
  /// Whether a disc grows and its radius is 0 now.
  bool is_seed(Point_id id) const;

  // ---- two discs ----

  /// The point that a disc names or, in a periodic box, its image.
  decltype(auto) point_of(const Disc& disc) const { return point_of(point(id_of(disc)), disc); }
  /// The same with another motion.
  decltype(auto) point_of(const Point_2& p, const Disc& disc) const {
    if constexpr (is_periodic) {
      return traits().image(p, disc.offset);
    } else {
      return (p);
    }
  }
  /// The disc itself, as it sees itself.
  static Disc itself(Point_id id) {
    if constexpr (is_periodic) {
      return {id, {}};
    } else {
      return id;
    }
  }

  /// Whether the discs overlap just after the time, or touch if they have radii of their own. True
  /// if unsure.
  bool may_touch(Point_id a, const Disc& b, const Traits& traits, const Time& time) const {
    const auto& p = point_of(itself(a));
    const auto& q = point_of(b);
    return traits.may_overlap(p, q, setup_.diameter(), time) ||
           (has_radii && traits.do_touch(p, q, setup_.diameter(), time));
  }
  bool may_touch(Point_id a, const Disc& b) const {
    return may_touch(a, b, traits(), current_time());
  }
  /// Whether two discs touch or overlap at a time. Exact.
  bool do_touch(Point_id a, const Disc& b, const Time& time) const {
    return traits().do_touch(point_of(itself(a)), point_of(b), setup_.diameter(), time);
  }
  /// Whether the interiors of the discs overlap at the present time. Exact.
  bool do_overlap(const Image_2& p, const Image_2& q) const;

  // ---- images ----

  /// In the plane nothing.
  struct No_vectors {};
  /// The lattice at the present time.
  using Vectors = std::conditional_t<is_periodic, Short_vectors<Traits>, No_vectors>;
  Vectors vectors() const {
    if constexpr (is_periodic) {
      return Vectors(traits(), current_time());
    } else {
      return {};
    }
  }
  /// Calls `function` with another disc as that of `p`, which need not be in the triangulation,
  /// sees it; in a periodic box with those of its images that may touch the disc now, itself too if
  /// that has its id, and others. Precondition: no disc overlaps an image of itself now, unless
  /// they may (Simulation_setup::lets_images_overlap).
  template <class Function>
  void for_each_near(const Point_2& p, Point_id other, const Vectors& vectors,
                     Function function) const;
  /// Whether a disc, which need not be in the triangulation, overlaps another one now or, in a
  /// periodic box, an image of it. Exact. Precondition: as of for_each_near.
  bool does_overlap_image(const Point_2& p, Point_id other, const Vectors& vectors) const;
  /// In a periodic box, throws Own_image_error if one of the discs overlaps an image of itself now.
  /// Does nothing if such overlaps do not matter.
  void check_own_images(std::span<const Point_2> discs) const;

  // ---- neighbors ----

  /// Calls `function` with the neighbors of a point.
  template <class Function>
  void for_each_neighbor(Point_id id, Function function) const;
  /// Whether both points exist, and are neighbors. O(degree).
  bool is_edge(const Pair& pair) const;
  /// Calls `function` with the corners that a point is linked with, which exist if a triangle hides
  /// it and its radius is 0. In dimensions below 2 it is an edge or a vertex.
  template <class Function>
  void for_each_corner(Point_id id, Function function) const;
  std::vector<Disc> corners_of(Point_id id) const;
  /// Calls make(edge, now, made) for each two neighbors, with their ids and the present time, on
  /// several threads: for each block of faces with an object `made`. Returns these objects, in the
  /// order of the faces.
  template <class Made, class Make>
  std::vector<Made> make_for_edges(const Make& make) const;

  // ---- discs nearby ----

  /// The discs that overlap that of a point just after the present time, and perhaps some that
  /// almost do, found along edges. For discs of one radius.
  std::vector<Disc> overlapping_points(Point_id id, const Traits& traits) const;
  /// Discs such that each disc that overlaps one of `points` is one of them or overlaps one of
  /// them, or in a periodic box an image of one; see Overlap_tracker. For discs of any radii.
  std::vector<Point_id> discs_about(std::span<const Point_id> points) const;
  /// Calls `function` with the first and the second disc of each pair of the discs that may touch
  /// now, and others. For discs of any radii. Precondition: as of for_each_near.
  template <class Function>
  void for_each_close_pair(std::span<const Point_id> ids, Function function) const;
  /// Calls `function` with the first and the second disc of all pairs that overlap just after the
  /// present time. Exact.
  template <class Function>
  void for_each_exact_overlap(const Traits& exact, Function function) const;

 private:
  template <class Function>
  void for_each_end_of_edge(Point_id id, Function function) const;
  template <class Function>
  void for_each_coincident_link(Point_id id, Function function) const;
  template <class Function>
  void for_each_hidden_link(Point_id id, Function function) const;
  std::vector<Disc> owners_in(Point_id id) const;
  Disc owner_of_center(Point_id id) const;
  Disc corner_over(Point_id id) const;
  double greatest_radius_of(const Point_2& p) const;
  std::int64_t steps(double radii, const Vectors& vectors) const;

  const Simulation_setup& setup_;
  const Triangulation& triangulation_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_DISC_GEOMETRY_H
