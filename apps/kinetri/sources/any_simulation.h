// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulation whose kind of motion depends on the input, or one in a periodic box. Includes CGAL:
// headers that only name the class should declare it.
#ifndef KINETRI_APPS_ANY_SIMULATION_H
#define KINETRI_APPS_ANY_SIMULATION_H

#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "kinetri/base/error.h"
#include "kinetri/io/event_log.h"
#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri::app {

class Any_simulation {
 public:
  using Linear = Simulation_2<Linear_kinetic_traits_2>;
  using Polynomial = Simulation_2<Polynomial_kinetic_traits_2>;
  using Discs = Simulation_2<Disc_kinetic_traits_2>;
  using Polynomial_discs = Simulation_2<Polynomial_disc_kinetic_traits_2>;

  /// Holds no simulation until one is assigned.
  Any_simulation() = default;
  /// Holds the simulation.
  template <class Traits>  // NOLINTNEXTLINE(google-explicit-constructor)
  Any_simulation(std::unique_ptr<Simulation_2<Traits>> simulation)
      : simulation_(std::move(simulation)) {}

  /// Whether the box is periodic.
  bool is_periodic() const {
    return std::visit(
        []<class Traits>(const std::unique_ptr<Simulation_2<Traits>>&) {
          return PeriodicKineticTraits_2<Traits>;
        },
        simulation_);
  }
  /// The periodic box; none in the plane.
  std::optional<Periodic_box_2> periodic_box() const {
    return visit([]<class Traits>(const Simulation_2<Traits>& s) -> std::optional<Periodic_box_2> {
      if constexpr (PeriodicKineticTraits_2<Traits>) {
        return s.triangulation().traits().box();
      } else {
        return std::nullopt;
      }
    });
  }
  /// Those of its event log.
  Event_columns event_columns() const {
    return is_periodic() ? Event_columns::periodic : Event_columns::planar;
  }

  /// Calls `function` with the simulation.
  template <class Function>
  std::invoke_result_t<Function, Linear&> visit(Function function) const {
    // The explicit result type keeps std::visit from deducing it: clang omits virtual functions of
    // objects that are created only in a deduced body (LLVM issue 60965).
    return std::visit(
        [&](const auto& simulation) -> std::invoke_result_t<Function, Linear&> {
          return function(*simulation);
        },
        simulation_);
  }

 private:
  std::variant<std::unique_ptr<Linear>, std::unique_ptr<Polynomial>, std::unique_ptr<Discs>,
               std::unique_ptr<Polynomial_discs>
#ifndef KINETRI_WITHOUT_PERIODIC_BOXES
               ,
               std::unique_ptr<Simulation_2<Periodic_kinetic_traits_2>>,
               std::unique_ptr<Simulation_2<Periodic_disc_kinetic_traits_2>>
#endif
               >
      simulation_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_ANY_SIMULATION_H
