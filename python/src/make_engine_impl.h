// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_PYTHON_MAKE_ENGINE_IMPL_H
#define KINETRI_PYTHON_MAKE_ENGINE_IMPL_H

#include <memory>
#include <utility>

#include "engine_of.h"
#include "make_engine.h"

namespace kinetri::python {

template <class Traits>
std::unique_ptr<Engine> make_engine(const Motion_columns& motions, const Algebraic_number& start,
                                    Coincident_points coincident, const Traits& traits) {
  return engine_of(std::make_unique<Kinetic_triangulation_2<Traits>>(
      motions_of<typename Traits::Motion>(motions), start, traits, coincident));
}

template <class Traits>
std::unique_ptr<Engine> make_engine(const Motion_columns& motions, const Algebraic_number& start,
                                    const Simulation_options& options, const Traits& traits) {
  return engine_of(std::make_unique<Simulation_2<Traits>>(
      motions_of<typename Traits::Motion>(motions), options, start, traits));
}

template <class Traits>
std::unique_ptr<Engine> restored_triangulation(const Triangulation_snapshot<Traits>& snapshot,
                                               const Traits& traits, Coincident_points coincident) {
  using Kinetic = Kinetic_triangulation_2<Traits>;
  return engine_of(  // it cannot be moved
      std::unique_ptr<Kinetic>(new Kinetic(Kinetic::restore(snapshot, traits, coincident))));
}

template <class Traits>
std::unique_ptr<Engine> make_engine(const Simulation_snapshot<Traits>& snapshot, Engine_kind kind,
                                    Collision_response response, const Traits& traits) {
  using Simulation = Simulation_2<Traits>;
  if (kind == Engine_kind::simulation) {  // which cannot be moved
    return engine_of(std::unique_ptr<Simulation>(
        new Simulation(Simulation::restore(snapshot, std::move(response), traits))));
  }
  if (snapshot.options.box || snapshot.has_response || !snapshot.scheduled.empty()) {
    throw Snapshot_error(
        "the state is that of a simulation with a box, collisions or scheduled changes; expected "
        "that of a triangulation: restore it as a Simulation");
  }
  if constexpr (PeriodicKineticTraits_2<Traits> && HasWeight<typename Traits::Motion>) {
    throw Snapshot_error(
        "the state is that of discs in a periodic box, which only a simulation has; expected that "
        "of points: restore it as a Simulation");
  } else {
    return restored_triangulation(snapshot.triangulation, traits, snapshot.options.coincident);
  }
}

template <class Traits>
std::unique_ptr<Engine> make_engine(std::unique_ptr<Simulation_2<Traits>> simulation) {
  return engine_of(std::move(simulation));
}

#define KINETRI_PYTHON_INSTANTIATE(Traits)                                                       \
  template std::unique_ptr<Engine> make_engine<Traits>(                                          \
      const Motion_columns&, const Algebraic_number&, Coincident_points, const Traits&);         \
  template std::unique_ptr<Engine> make_engine<Traits>(                                          \
      const Motion_columns&, const Algebraic_number&, const Simulation_options&, const Traits&); \
  template std::unique_ptr<Engine> make_engine<Traits>(                                          \
      const Simulation_snapshot<Traits>&, Engine_kind, Collision_response, const Traits&);       \
  template std::unique_ptr<Engine> make_engine<Traits>(std::unique_ptr<Simulation_2<Traits>>)

}  // namespace kinetri::python

#endif  // KINETRI_PYTHON_MAKE_ENGINE_IMPL_H
