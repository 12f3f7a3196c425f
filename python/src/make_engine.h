// SPDX-License-Identifier: GPL-3.0-or-later
//
// Makes the engines of each kind of motion. Defined in engines_of_points.cpp and
// engines_of_discs.cpp, which compile in parallel.
#ifndef KINETRI_PYTHON_MAKE_ENGINE_H
#define KINETRI_PYTHON_MAKE_ENGINE_H

#include <memory>

#include "engine.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri::python {

/// @{
/// As make_triangulation, make_simulation and restore, for the motions of the traits.
template <class Traits>
std::unique_ptr<Engine> make_engine(const Motion_columns& motions, const Algebraic_number& start,
                                    Coincident_points coincident, const Traits& traits);
template <class Traits>
std::unique_ptr<Engine> make_engine(const Motion_columns& motions, const Algebraic_number& start,
                                    const Simulation_options& options, const Traits& traits);
template <class Traits>
std::unique_ptr<Engine> make_engine(const Simulation_snapshot<Traits>& snapshot, Engine_kind kind,
                                    Collision_response response, const Traits& traits);
/// @}

/// An engine of the simulation.
template <class Traits>
std::unique_ptr<Engine> make_engine(std::unique_ptr<Simulation_2<Traits>> simulation);

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_MAKE_ENGINE_H
