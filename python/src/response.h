// SPDX-License-Identifier: GPL-3.0-or-later
//
// A Python function as the response to contacts.
#ifndef KINETRI_PYTHON_RESPONSE_H
#define KINETRI_PYTHON_RESPONSE_H

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>

#include "kinetri/simulation/collision_response.h"

namespace kinetri::python {

/// Set while a response has been interrupted (Ctrl-C) and its contact is still due.
using Interrupt_flag = std::shared_ptr<std::atomic<bool>>;

/// The response: none for None, a built-in one for a name, else the function, which takes a Contact
/// and returns (velocity_a, velocity_b, erases_a, erases_b, stops_a, stops_b). It is called with
/// the GIL. If it is interrupted, the flag is set and it is called again, so that the simulation is
/// never left within an event. Throws Precondition_error if the name is unknown.
Collision_response response_of(const pybind11::object& response, const Interrupt_flag& flag);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_RESPONSE_H
