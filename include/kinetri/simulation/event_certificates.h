// SPDX-License-Identifier: GPL-3.0-or-later
//
// The certificate of each event: the polynomial that has failed, and the proof that it has failed
// then and not before.
#ifndef KINETRI_SIMULATION_EVENT_CERTIFICATES_H
#define KINETRI_SIMULATION_EVENT_CERTIFICATES_H

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "kinetri/algebra/failure_certificate.h"
#include "kinetri/events/event.h"
#include "kinetri/simulation/simulation_options.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"

namespace kinetri {

/// Why an event happened at its time. `points`, and the polynomial whose failure is the event:
///
/// | Kind | Points | Polynomial |
/// |---|---|---|
/// | `flip` | the ends of the edge, the two others | perturbed_in_circle_polynomial, negated |
/// | `hull_insert`, `hull_remove` | the corners of the triangle | orientation_polynomial |
/// | `hide` | those of an edge of the point | as for a flip, or for `hull_insert` |
/// | `reveal` | the triangle that hid the point, and the point | as for a flip |
/// | `reveal` beyond the hull | a hull edge, and the point | orientation_polynomial |
/// | `wall` | the point | wall_polynomial |
/// | `collision` | both points | contact_polynomial |
///
/// If discs overlap when one gets its motion, and separate at first, the derivative of
/// contact_polynomial is the polynomial: they collide when they cease to separate. Points are in
/// the order of the function's parameters. Other events have no failure, nor have `hide` and
/// `reveal` of points that coincide for a while; their points are those that they name.
///
/// In a periodic box a polynomial is about images of these points: `offsets` has the offset of
/// each, against the positions as given, of which one is zero. If the same offset is added to all
/// images, the polynomial is the same.
struct Event_certificate {
  std::uint64_t event = 0;                     ///< the number of the event
  Event_kind kind = Event_kind::flip;          ///< of the event
  std::vector<Point_id> points;                ///< see above
  std::vector<Lattice_offset_2> offsets;       ///< empty in the plane, and if there is no failure
  std::optional<Failure_certificate> failure;  ///< none if nothing fails, or not at a root
  std::string_view reason;                     ///< why there is none, for people
};

namespace detail {
template <class Traits>
class Certificate_finder;
}  // namespace detail

/// An observer that certifies events. A certificate begins at the last change of its subject, or
/// else at the start of the observation. Changes are: the edge gets its two triangles; the hidden
/// point comes into its triangle; one of the points gets its motion; of a contact, a disc gets its
/// motion, or the two discs touch or separate. So certificates depend on the events of the run, not
/// on how it was computed.
///
/// Cost: for each event the roots of a polynomial and a Sturm sequence; for each change other than
/// a flip, the degrees of the points whose edges have changed. Memory: a record for each edge. Runs
/// with such an observer use one thread, since it looks at the triangulation. Compiled for the
/// library's traits.
template <class Traits = Linear_kinetic_traits_2>
class Event_certificates : public Event_observer {
 public:
  using Triangulation = Kinetic_triangulation_2<Traits>;           ///< what is observed
  using Function = std::function<void(const Event_certificate&)>;  ///< what it calls

  /// Calls `function` with the certificate of each event from now on, after the event. `options`
  /// are those of the simulation that owns the triangulation. The triangulation must outlive this
  /// object, and must not be reversed while it is observed.
  /// O(n log n).
  Event_certificates(const Triangulation& triangulation, const Simulation_options& options,
                     Function function);
  ~Event_certificates() override;

  /// Computes the certificate of the event.
  void before_event(const Event& event) override;
  /// Calls the function with the certificate.
  void after_event(const Event& event) override;
  /// Records which certificates have changed.
  void after_rebuild(const Algebraic_number& time, std::span<const Edge_ids> edges) override;
  /// Records which triangles hide the points.
  void after_hiding(const Algebraic_number& time, std::span<const Point_id> points) override;

 private:
  std::unique_ptr<detail::Certificate_finder<Traits>> finder_;
};

extern template class Event_certificates<Linear_kinetic_traits_2>;
extern template class Event_certificates<Polynomial_kinetic_traits_2>;
extern template class Event_certificates<Disc_kinetic_traits_2>;
extern template class Event_certificates<Polynomial_disc_kinetic_traits_2>;
extern template class Event_certificates<Periodic_kinetic_traits_2>;
extern template class Event_certificates<Periodic_disc_kinetic_traits_2>;

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_EVENT_CERTIFICATES_H
