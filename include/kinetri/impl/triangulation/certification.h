// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificates of the edges and hidden points of a kinetic triangulation. All functions are
// const; several threads may call them at once.
#ifndef KINETRI_IMPL_TRIANGULATION_CERTIFICATION_H
#define KINETRI_IMPL_TRIANGULATION_CERTIFICATION_H

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/triangulation/topology.h"
#include "kinetri/kinetic/certificate.h"

namespace kinetri::detail {

/// The kinds of queue entries, in the order of entries at one time. Hidden points come last, since
/// they are located in a triangulation with the right edges.
enum class Entry_kind : std::uint8_t {
  recheck,      ///< the certificate certainly holds until then
  coincidence,  ///< the ends of the edge coincide
  hull_insert,
  hull_remove,
  flip,
  hidden,  ///< a hidden point reaches a side or the plane of the triangle that hides it
};

/// The index of a condition on a hidden point: 0 to 2 for a side of the triangle that hides it, by
/// the opposite vertex; this for the plane of the lifted triangle.
inline constexpr std::uint8_t plane_condition = 3;
inline constexpr std::uint8_t no_condition = 4;

/// The points of a certificate, four for in-circle, three for orientation; and the kind of its
/// failure.
template <class Traits>
struct Kinetic_types<Traits>::Certificate_points {
  Entry_kind kind = Entry_kind::recheck;
  std::array<Corner, 4> points = {};

  /// As the traits take them; valid as long as this object.
  Quadruple<Image_2> quadruple() const {
    if constexpr (is_periodic) {
      return {&points[0], &points[1], &points[2], &points[3]};
    } else {
      return points;
    }
  }
};

template <class Traits>
class Kinetic_types<Traits>::Certification {
 public:
  using Certificate_points = typename Kinetic_types::Certificate_points;

  /// The topology must outlive this object.
  Certification(const Traits& traits, const Topology& topology)
      : traits_(traits), topology_(topology), triangulation_(topology.triangulation()) {}

  const Traits& traits() const { return traits_; }
  /// From now on, makes the certificates of other traits.
  void set_traits(const Traits& traits) { traits_ = traits; }
  const Topology& topology() const { return topology_; }

  // ---- edges ----

  /// The points of the certificate of an edge. Precondition: dimension 2.
  Certificate_points points(const Edge_with_mirror& edge) const;
  /// The certificate of these points from `after` on.
  Certificate certificate(const Certificate_points& about, const Time& after,
                          Certificate_state state) const;

  /// Calls put(edge, kind, certificate) for each of the edges, with its certificate from `after` on
  /// and the kind of the failure. An edge has two conditions: that it is Delaunay (or a hull edge),
  /// and that its ends are apart. The certificate is that of the condition that fails first.
  template <class Put>
  void certify(std::span<const Edge_with_mirror> edges, const Time& after, Certificate_state state,
               Certificate_counters& counters, const Put& put) const;
  /// The same for an edge that has just been flipped, and the outer edges of its quadrilateral, as
  /// Topology::flip returns them; usually one call of the traits certifies all five. now(), called
  /// only if needed, is the time of the flip, within `bounds`.
  template <class Now, class Put>
  void certify_after_flip(const Edge_with_mirror& edge, const Outer_edges& outer,
                          const Double_interval& bounds, const Now& now,
                          Certificate_counters& counters, const Put& put) const;
  /// The certificate of one edge, and the kind of its failure; counted nowhere.
  std::pair<Entry_kind, Certificate> certificate_of(const Edge_with_mirror& edge,
                                                    const Time& after) const;

  /// The exact failure time of a certificate, within bounds that the traits gave.
  Time failure_time(const Certificate_points& failed, const Double_interval& bounds) const;

  // ---- hidden points ----

  /// The certificate of a hidden point from `after` on, and the condition that fails first. The
  /// polynomial of the condition `vanishing`, if given, vanishes at that time, at which its
  /// negation has failed.
  std::pair<std::uint8_t, Certificate> hidden_certificate(
      Vertex_handle v, const Time& after, Certificate_counters& counters,
      std::uint8_t vanishing = no_condition) const;
  /// The points of a condition on a hidden point. Precondition: dimension 2.
  Certificate_points hidden_points(Vertex_handle v, std::uint8_t condition) const;

  // ---- triangles ----

  /// Whether the triangles at `v` make left turns, and the hull is strictly convex at `v` and at
  /// its neighbors, at a time within `bounds`; is_left_turn(p, q, r) decides it exactly, of points
  /// or, in a periodic box, of images. Then the triangulation is still embedded after `v` has
  /// moved: the angles at an inner vertex still add up to 2 pi, and a hull vertex sees its
  /// neighbors within an angle less than pi. Sufficient, not necessary.
  template <class Is_left_turn>
  bool is_embedded_around(Vertex_handle v, const Double_interval& bounds,
                          const Is_left_turn& is_left_turn) const;

 private:
  struct Condition {
    std::uint8_t index;
    const Certificate* certificate;
  };

  Certificate_points points_in_plane(const Edge_with_mirror& edge) const;
  template <class Use>
  bool use_around(const Edge_with_mirror& edge, const Outer_edges& outer, const Use& use) const;
  template <class Now, class Put>
  bool certify_together(const Edge_with_mirror& edge, const Outer_edges& outer,
                        const Double_interval& bounds, const Now& now,
                        Certificate_counters& counters, const Put& put) const;
  template <class Put>
  void certify_chain(std::span<const Edge_with_mirror> edges, const Time& after,
                     Certificate_counters& counters, const Put& put) const;
  Certificate chain_certificate(const Edge& edge, const Time& after) const;
  template <class After>
  Entry_kind first_failure(const Edge_with_mirror& edge, Entry_kind kind, Certificate& certificate,
                           const After& after, Certificate_counters& counters) const;
  Certificate coincidence(const Edge_with_mirror& edge, const Time& after,
                          const Double_interval& among, Certificate_counters& counters) const;
  Certificate hidden_certificate(Vertex_handle v, std::uint8_t condition, const Time& after,
                                 Certificate_state state) const;
  bool is_earlier(Vertex_handle v, const Condition& a, const Condition& b) const;
  static Double_interval from(const Time& time) {
    return {time.interval().lower, std::numeric_limits<double>::infinity()};
  }

  Traits traits_;
  const Topology& topology_;
  const Triangulation& triangulation_;
};

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_CERTIFICATION_H
