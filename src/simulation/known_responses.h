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

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_KNOWN_RESPONSES_H
