// SPDX-License-Identifier: GPL-3.0-or-later
//
// Responses to contacts of two discs: the built-in ones, and the argument and result of a
// user-defined one.
#ifndef KINETRI_SIMULATION_COLLISION_RESPONSE_H
#define KINETRI_SIMULATION_COLLISION_RESPONSE_H

#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// Two discs that touch while they approach each other: the argument of a response. All numbers are
/// rounded to binary64; the contact itself was decided exactly. In a periodic box, center and
/// velocity of b are those of the image that touches a.
struct Contact_2 {
  double time = 0;              ///< time of the contact
  Point_id point_a = no_point;  ///< the smaller id
  Point_id point_b = no_point;  ///< the greater one
  Vector_2 separation;          ///< center of b minus center of a; may be rounded to zero
  Vector_2 velocity_a;          ///< of point_a just before the contact
  Vector_2 velocity_b;          ///< of point_b just before the contact
  double mass_a = 1;            ///< of point_a: positive
  double mass_b = 1;            ///< of point_b: positive
  double growth_a = 0;          ///< growth of the radius of point_a per unit of time
  double growth_b = 0;          ///< growth of the radius of point_b per unit of time
  /// Whether this is a resting contact: the first derivative of their gap is zero, exactly, but
  /// they accelerate toward each other. No exchange of velocities separates them.
  bool is_pressed = false;
  /// Whether the two would approach each other with these new velocities, decided exactly for the
  /// resulting motions. A response with such velocities leads to the same contact again.
  std::function<bool(const Vector_2& a, const Vector_2& b)> would_approach;
};

/// The result of a response. Each point gets a new velocity and keeps its acceleration, or comes to
/// rest, or is erased, or keeps its motion. If both keep their motions, the discs pass through each
/// other: their next contact comes only after they have separated.
///
/// If a response gives discs in resting contact motions with which they are still in resting
/// contact, the simulation throws Endless_contacts_error.
struct Contact_response_2 {
  std::optional<Vector_2> velocity_a = std::nullopt;  ///< new velocity of point_a; finite
  std::optional<Vector_2> velocity_b = std::nullopt;  ///< new velocity of point_b; finite
  bool erases_a = false;                              ///< whether point_a is erased
  bool erases_b = false;                              ///< whether point_b is erased
  /// Whether point_a rests from now on: velocity, acceleration, jerk and growth are 0.
  bool stops_a = false;
  bool stops_b = false;  ///< whether point_b rests from now on

  /// Whether a point gets another velocity, or rests, and both stay.
  bool is_motion_given() const {
    return !erases_a && !erases_b && (velocity_a || velocity_b || stops_a || stops_b);
  }
};

/// A response: called at every contact. It may read the simulation, and schedule changes unless it
/// is pure (Simulation_options::response_is_pure); other functions that change the simulation throw
/// Precondition_error. If it throws, the simulation cannot continue. If the function is empty,
/// discs do not collide and no contacts are computed.
using Collision_response = std::function<Contact_response_2(const Contact_2&)>;

/// Changes nothing: contacts are only reported as events.
Contact_response_2 log_contact(const Contact_2& contact);

/// The two points exchange their velocities: a point that hits a resting point stops and sets it in
/// motion. Masses are ignored. If they are equal, energy and momentum are conserved exactly. If the
/// exchanged velocities would still make the discs approach, they pass through each other. So do
/// discs that grow faster than the exchanged velocities separate them, such as two that rest, and
/// discs of nearly equal centers, because of rounded positions. Source: Computation of Topologic
/// Events in Kinetic Delaunay Triangulation using Sturm Sequences of Polynomials, section 6.3.
Contact_response_2 swap_velocities(const Contact_2& contact);

/// Elastic collision: equal and opposite impulses along the line of centers, after which the
/// boundary circles separate as fast as they approached. Let v be the component of the relative
/// velocity along the line of centers, positive if the centers separate, and G the sum of the
/// growths: v becomes 2 G - v, and this change is divided between the two velocities in inverse
/// proportion to the masses. Momentum is conserved up to rounding, and so is energy if neither disc
/// grows; equal masses exchange the components. (Growing discs gain energy. The rule for them: B.
/// Lubachevsky, F. Stillinger, Geometric properties of random disk packings, Journal of Statistical
/// Physics 60, 1990.)
///
/// If the discs would still approach with the rounded velocities, as in a nearly tangential
/// contact, the impulse is increased until they do not. If no increase up to the size of the speeds
/// achieves that, because the centers nearly coincide, they pass through each other.
Contact_response_2 collide_elastically(const Contact_2& contact);

/// Both points stop, and stay where they are: velocity, acceleration, jerk and growth are 0.
Contact_response_2 stop_both(const Contact_2& contact);

/// Both points are erased.
Contact_response_2 erase_both(const Contact_2& contact);

/// A response and its name in the program `kinetri`.
struct Named_response {
  std::string_view name;                             ///< "swap", for example
  Contact_response_2 (*response)(const Contact_2&);  ///< null for "none"
  std::string_view effect;                           ///< what happens when two discs touch
};

/// All built-in responses.
inline constexpr std::array<Named_response, 6> named_responses = {
    {{"none", nullptr, "nothing"},
     {"log", log_contact, "a row in the event log"},
     {"swap", swap_velocities, "they exchange velocities"},
     {"elastic", collide_elastically, "they collide elastically"},
     {"stop", stop_both, "both stop"},
     {"remove", erase_both, "both are erased"}}};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_COLLISION_RESPONSE_H
