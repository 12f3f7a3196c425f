// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificates of a kinetic triangulation: what the kinetic traits say of its edges, hidden
// points and triangles. Nothing here changes anything, so several threads may ask at once.
#ifndef KINETRI_IMPL_TRIANGULATION_CERTIFICATION_H
#define KINETRI_IMPL_TRIANGULATION_CERTIFICATION_H

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "kinetri/impl/base/compiler.h"
#include "kinetri/impl/kinetic/rounded_places.h"
#include "kinetri/impl/triangulation/topology.h"
#include "kinetri/kinetic/certificate.h"
#include "kinetri/kinetic/certificate_counters.h"

namespace kinetri::detail {

/// What the queue holds an entry for, in the order of entries at one time. Hidden points come
/// last: where they are is looked for in a triangulation whose edges are right.
enum class Entry_kind : std::uint8_t {
  recheck,      ///< the certificate certainly holds until then
  coincidence,  ///< the ends of the edge coincide
  hull_insert,
  hull_remove,
  flip,
  hidden,  ///< a hidden point reaches the side or the plane of the triangle that hides it
};

/// The condition on a hidden point that is certified or fails: a side of the triangle that hides
/// it, by the index of the opposite vertex, or this, the plane of the lifted triangle.
inline constexpr std::uint8_t plane_condition = 3;
/// As the index of a condition: none.
inline constexpr std::uint8_t no_condition = 4;

/// What a certificate is about: points for the kinetic traits, four for in-circle, three for
/// orientation; and the kind of its failure.
template <class Traits>
struct Kinetic_types<Traits>::Certificate_points {
  Entry_kind kind = Entry_kind::recheck;
  std::array<const Point_2*, 4> points = {};
};

/// From faces to certificates.
template <class Traits>
class Kinetic_types<Traits>::Certification {
 public:
  using Certificate_points = typename Kinetic_types::Certificate_points;

  /// The topology must outlive this object.
  Certification(const Traits& traits, const Topology& topology)
      : traits_(traits), topology_(topology), triangulation_(topology.triangulation()) {}

  const Traits& traits() const { return traits_; }
  const Topology& topology() const { return topology_; }

  // ---- edges ----

  /// What the certificate of an edge is about. Precondition: dimension 2.
  Certificate_points points(const Two_sided_edge& edge) const;
  /// The certificate that is about these points, from `after` on.
  Certificate certificate(const Certificate_points& about, const Time& after,
                          Certificate_state state) const;

  /// Calls put(edge, kind, certificate) for each of the edges, with its certificate from `after` on
  /// and the kind of the failure. An edge has two conditions, that it belongs to the triangulation
  /// and that its ends are apart; its certificate is that of the one that fails first.
  template <class Put>
  void certify(std::span<const Two_sided_edge> edges, const Time& after, Certificate_state state,
               Certificate_counters& counters, const Put& put) const;
  /// The same for an edge that has just been flipped, and the outer edges of its quadrilateral, as
  /// Topology::flip returns them; mostly the five are certified together. The time of the flip is
  /// within `bounds`; `now` is a function that returns it, which is called only if it is needed.
  template <class Now, class Put>
  void certify_after_flip(const Two_sided_edge& edge, const Outer_edges& outer,
                          const Double_interval& bounds, const Now& now,
                          Certificate_counters& counters, const Put& put) const;
  /// The certificate of one edge, and the kind of its failure; counted nowhere.
  std::pair<Entry_kind, Certificate> certificate_of(const Two_sided_edge& edge,
                                                    const Time& after) const;

  /// The exact failure time of a certificate, within bounds that the traits gave.
  Time failure_time(const Certificate_points& failed, const Double_interval& bounds) const;

  // ---- hidden points ----

  /// The certificate of a hidden point from `after` on, and the condition that fails first. The
  /// condition `vanishing`, if it is one, vanishes at that time, at which its negation has failed.
  std::pair<std::uint8_t, Certificate> hidden_certificate(
      Vertex_handle v, const Time& after, Certificate_counters& counters,
      std::uint8_t vanishing = no_condition) const;
  /// What a condition on a hidden point is about. Precondition: dimension 2.
  static Certificate_points hidden_points(Vertex_handle v, std::uint8_t condition);

  // ---- triangles ----

  /// Whether the triangles at `v` make left turns, and the hull is strictly convex at `v` and at
  /// its neighbors, at a time within `bounds`; is_left_turn(u, v, w) decides it exactly. Then `v`,
  /// which has moved, has left the triangulation properly embedded: the angles at an inner vertex
  /// add up to what they were, namely once around; a hull vertex sees its neighbors within less
  /// than half of that. Sufficient, not necessary.
  template <class Is_left_turn>
  bool is_embedded_around(Vertex_handle v, const Double_interval& bounds,
                          const Is_left_turn& is_left_turn) const;
  /// The positions of all points at a time, if there is a way to round them.
  Rounded_places places(const Time& time) const;

 private:
  struct Condition {
    std::uint8_t index;
    const Certificate* certificate;
  };

  template <class Now, class Put>
  bool certify_together(const Two_sided_edge& edge, const Outer_edges& outer,
                        const Double_interval& bounds, const Now& now,
                        Certificate_counters& counters, const Put& put) const;
  template <class Put>
  void certify_chain(std::span<const Two_sided_edge> edges, const Time& after,
                     Certificate_counters& counters, const Put& put) const;
  Certificate chain_certificate(const Edge& edge, const Time& after) const;
  template <class After>
  Entry_kind first_failure(const Two_sided_edge& edge, Entry_kind kind, Certificate& certificate,
                           const After& after, Certificate_counters& counters) const;
  Certificate coincidence(const Two_sided_edge& edge, const Time& after,
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
