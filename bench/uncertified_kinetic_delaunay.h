// SPDX-License-Identifier: GPL-3.0-or-later
//
// The baseline: a kinetic Delaunay triangulation of linear motions on CGAL's topology that computes
// in doubles, without certificates, and assumes general position. Rounding may cause wrong events,
// and coinciding points or simultaneous events a permanently wrong triangulation.
//
// Measured: faster are lazy mode, windows of 0.5 to 0.9 of the time scale, outer certificates of a
// flip in pairs, and prefetching of the next faces. No difference: replacing the first entry
// instead of popping and pushing, prefetching corners and neighbors of all next faces, and compiler
// options that relax rounding and errno.
#ifndef KINETRI_BENCH_UNCERTIFIED_KINETIC_DELAUNAY_H
#define KINETRI_BENCH_UNCERTIFIED_KINETIC_DELAUNAY_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_2.h>
#include <CGAL/Triangulation_ds_face_base_2.h>
#include <CGAL/Triangulation_vertex_base_2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kinetri/kinetic/linear_motion_2.h"
#include "time_heap.h"

namespace kinetri::bench {

using Static_kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A vertex with its velocity; its point is the position at time 0.
template <class VertexBase = CGAL::Triangulation_vertex_base_2<Static_kernel>>
class Moving_vertex_base_2 : public VertexBase {
 public:
  using VertexBase::VertexBase;

  template <class Tds2>
  struct Rebind_TDS {
    using Other = Moving_vertex_base_2<typename VertexBase::template Rebind_TDS<Tds2>::Other>;
  };

  Vector_2 velocity;
  std::uint32_t id = 0;
};

/// A face with the number of each of its edges, in one cache line.
template <class FaceBase = CGAL::Triangulation_ds_face_base_2<>>
class alignas(64) Numbered_edges_face_base_2 : public FaceBase {
 public:
  using FaceBase::FaceBase;

  template <class Tds2>
  struct Rebind_TDS {
    using Other = Numbered_edges_face_base_2<typename FaceBase::template Rebind_TDS<Tds2>::Other>;
  };

  std::array<std::uint32_t, 3> edge = {};
};

/// How far ahead certificates are computed.
enum class Outlook_range {
  unlimited,  ///< eager: to its first failure, whenever that is
  window,     ///< lazy: over a time window, at whose end they are rechecked
};

struct Uncertified_counters {
  std::uint64_t certificates = 0;  ///< computed
  std::uint64_t root_solves = 0;   ///< those of these that need a root search
  std::uint64_t scheduled = 0;     ///< entries of the queue, including rechecks
  std::uint64_t looked_again = 0;  ///< executed rechecks
  std::uint64_t executed = 0;      ///< flips
  std::uint64_t discarded = 0;     ///< entries replaced or removed before their time
};

/// The triangulation, from time 0 on. Preconditions: at least three points, not all collinear;
/// epochs 0.
class Uncertified_kinetic_delaunay {
 public:
  Uncertified_kinetic_delaunay(std::span<const Linear_motion_2> motions, Outlook_range range);

  /// Executes all events up to `time`.
  void advance_to(double time);

  const Uncertified_counters& counters() const { return counters_; }
  double build_seconds() const { return build_seconds_; }
  double initialize_seconds() const { return initialize_seconds_; }

  /// The ends of all finite edges, the smaller id first, sorted.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> finite_edge_ids() const;

 private:
  using Tds =
      CGAL::Triangulation_data_structure_2<Moving_vertex_base_2<>, Numbered_edges_face_base_2<>>;
  using Vertex = Tds::Vertex;
  using Vertex_handle = Tds::Vertex_handle;
  using Face_handle = Tds::Face_handle;

  struct Edge {
    Face_handle face;
    int index = 0;
  };

  void build(std::span<const Linear_motion_2> motions);
  void number_edges();

  void schedule(std::uint32_t edge, bool just_flipped);
  void set_time(std::uint32_t edge, double time);
  double next_look(const Edge& edge, bool just_flipped);
  double in_circle_look(const Vertex& p, const Vertex& q, const Vertex& r, const Vertex& s,
                        bool just_flipped);
  double orientation_look(const Vertex& p, const Vertex& q, const Vertex& r, bool just_flipped);
  template <std::size_t M>
  double look(const std::array<double, M>& c, double scale, bool just_flipped);
  template <std::size_t M>
  double first_look(const std::array<double, M>& c, double scale);
  template <std::size_t M>
  double first_look_in_window(const std::array<double, M>& c, double window);

  void flip(std::uint32_t edge);
  bool schedule_finite(std::uint32_t diagonal, const std::array<std::uint32_t, 4>& outer,
                       Face_handle face, int i, Face_handle neighbor, int j);

  Outlook_range range_;
  double now_ = 0;
  Tds tds_;
  Vertex_handle infinite_;
  std::vector<Edge> edges_;               // by number
  std::vector<std::uint8_t> look_again_;  // by number: whether its entry is a recheck
  bool holds_ = false;                    // whether the last time computed is that of a recheck
  Time_heap queue_;
  Uncertified_counters counters_;
  double build_seconds_ = 0;
  double initialize_seconds_ = 0;
};

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_UNCERTIFIED_KINETIC_DELAUNAY_H
