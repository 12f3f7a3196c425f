// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rival: a kinetic Delaunay triangulation of linear motions on CGAL's topology that computes in
// doubles and certifies nothing. It is what one writes who wants speed and takes input in general
// position for granted: rounding can give it wrong events, and coinciding points or several events
// at one time can make it wrong for good.
//
// Measured: the lazy way beats the eager one, windows of 0.5 to 0.9 of the time scale do better
// than shorter and longer ones, the outer certificates of a flip in pairs do better than one by
// one, replacing the first entry costs as much as popping and pushing, asking memory early for the
// next faces pays but for their corners and neighbors too does not, and compiler options that relax
// rounding and errno change nothing.
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

/// A vertex with its place at time 0, which is its point, and its velocity.
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

/// How far a certificate is looked into the future.
enum class Outlook_range {
  unlimited,  ///< eager: to its first failure, whenever that is
  window,     ///< lazy: over a window of time, at whose end it is looked at again
};

struct Uncertified_counters {
  std::uint64_t certificates = 0;  ///< looked at
  std::uint64_t root_solves = 0;   ///< of these, the ones whose coefficients' signs do not tell
  std::uint64_t scheduled = 0;     ///< entries of the queue, those for another look included
  std::uint64_t looked_again = 0;  ///< entries that came to the front for another look
  std::uint64_t executed = 0;      ///< flips
  std::uint64_t discarded = 0;     ///< entries replaced or taken out before they came to the front
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
  std::vector<std::uint8_t> look_again_;  // by number: its entry is no failure
  bool holds_ = false;                    // what the last look found is no failure
  Time_heap queue_;
  Uncertified_counters counters_;
  double build_seconds_ = 0;
  double initialize_seconds_ = 0;
};

}  // namespace kinetri::bench

#endif  // KINETRI_BENCH_UNCERTIFIED_KINETIC_DELAUNAY_H
