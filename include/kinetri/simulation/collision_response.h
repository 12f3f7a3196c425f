// SPDX-License-Identifier: GPL-3.0-or-later
//
// What two discs do when they touch: the responses that come with the library, and what one of
// one's own is given and gives.
#ifndef KINETRI_SIMULATION_COLLISION_RESPONSE_H
#define KINETRI_SIMULATION_COLLISION_RESPONSE_H

#include <array>
#include <functional>
#include <optional>
#include <string_view>

#include "kinetri/base/ids.h"
#include "kinetri/kinetic/linear_motion_2.h"

namespace kinetri {

/// Two discs that touch while they approach each other. The numbers are rounded to binary64.
struct Contact_2 {
  double time = 0;              ///< of the contact
  Point_id point_a = no_point;  ///< the smaller id
  Point_id point_b = no_point;  ///< the greater one
  Vector_2 separation;          ///< from the centre of a to that of b; zero if they are that near
  Vector_2 velocity_a;          ///< just before the contact
  Vector_2 velocity_b;          ///< likewise
  /// Whether the two would approach each other with these velocities, decided exactly for the
  /// motions that they would give. A response after which they do meets the same contact again.
  std::function<bool(const Vector_2& a, const Vector_2& b)> would_approach;
};

/// What becomes of the two. Where nothing is said a point keeps its motion; two that both keep it
/// are left in contact, and make no new one until their discs have parted.
struct Contact_response_2 {
  std::optional<Vector_2> velocity_a = std::nullopt;  ///< of the point a from then on; finite
  std::optional<Vector_2> velocity_b = std::nullopt;  ///< of the point b
  bool erases_a = false;                              ///< whether the point a goes
  bool erases_b = false;                              ///< whether the point b goes
};

/// Called at every contact. It must not change the simulation. Empty: discs do not collide, and
/// contacts are not looked for.
using Collision_response = std::function<Contact_response_2(const Contact_2&)>;

/// Changes nothing: contacts are events, no more.
Contact_response_2 log_contact(const Contact_2& contact);

/// The two exchange their velocities, so that a point that hits a resting one stops and sets it
/// going. Energy and momentum are kept exactly. Discs whose centres are so near to each other that
/// their places, as rounded, would approach all the same keep their motions. Source: Computation of
/// Topologic Events in Kinetic Delaunay Triangulation using Sturm Sequences of Polynomials,
/// section 6.3.
Contact_response_2 swap_velocities(const Contact_2& contact);

/// Elastic collision of equal masses: the components along the line of centres are exchanged.
/// Energy and momentum are kept up to rounding. A contact that is so nearly a touch in passing that
/// the rounded velocities approach still gets the least further change with which they do not.
/// Discs whose centres are so near to each other that there is none, up to their speeds, keep their
/// motions.
Contact_response_2 collide_elastically(const Contact_2& contact);

/// Both stop.
Contact_response_2 stop_both(const Contact_2& contact);

/// Both are erased.
Contact_response_2 erase_both(const Contact_2& contact);

/// A response by the name that it has in the program.
struct Named_response {
  std::string_view name;                             ///< "swap", for example
  Contact_response_2 (*response)(const Contact_2&);  ///< null for "none"
};

/// none, log, swap, elastic, stop, remove.
inline constexpr std::array<Named_response, 6> named_responses = {{{"none", nullptr},
                                                                   {"log", log_contact},
                                                                   {"swap", swap_velocities},
                                                                   {"elastic", collide_elastically},
                                                                   {"stop", stop_both},
                                                                   {"remove", erase_both}}};

}  // namespace kinetri

#endif  // KINETRI_SIMULATION_COLLISION_RESPONSE_H
