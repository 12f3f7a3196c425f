// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which response of the library a response is.
#ifndef KINETRI_SRC_SIMULATION_KNOWN_RESPONSES_H
#define KINETRI_SRC_SIMULATION_KNOWN_RESPONSES_H

#include "kinetri/simulation/collision_response.h"

namespace kinetri::detail {

/// Whether a response is a built-in one that changes the points. Its result depends on its argument
/// only.
bool is_pure(const Collision_response& response);

/// Whether a response is erase_both.
bool is_erase_both(const Collision_response& response);

/// Whether a response is log_contact.
bool is_log_contact(const Collision_response& response);

/// Changes nothing, as log_contact. In a periodic box discs overlap images of themselves, and may
/// coincide for a while, without an error. Precondition: discs have radii of their own, which are
/// positive (docs/MATH.md, section 18, "Contacts").
Contact_response_2 let_images_overlap(const Contact_2& contact);

/// Whether a response is let_images_overlap.
bool is_let_images_overlap(const Collision_response& response);

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_KNOWN_RESPONSES_H
