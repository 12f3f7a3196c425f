// SPDX-License-Identifier: GPL-3.0-or-later
//
// A simulation of points whose kind of motion the input decides. Takes in CGAL; what only passes a
// simulation on declares the class.
#ifndef KINETRI_APPS_ANY_SIMULATION_H
#define KINETRI_APPS_ANY_SIMULATION_H

#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include "kinetri/simulation/simulation_2.h"

namespace kinetri::app {

class Any_simulation {
 public:
  using Linear = Simulation_2<Linear_kinetic_traits_2>;
  using Polynomial = Simulation_2<Polynomial_kinetic_traits_2>;
  using Discs = Simulation_2<Disc_kinetic_traits_2>;
  using Polynomial_discs = Simulation_2<Polynomial_disc_kinetic_traits_2>;

  /// None, until another one is assigned.
  Any_simulation() = default;
  /// @{
  /// That one. NOLINTNEXTLINE(google-explicit-constructor)
  Any_simulation(std::unique_ptr<Linear> simulation) : simulation_(std::move(simulation)) {}
  /// NOLINTNEXTLINE(google-explicit-constructor)
  Any_simulation(std::unique_ptr<Polynomial> simulation) : simulation_(std::move(simulation)) {}
  /// NOLINTNEXTLINE(google-explicit-constructor)
  Any_simulation(std::unique_ptr<Discs> simulation) : simulation_(std::move(simulation)) {}
  /// NOLINTNEXTLINE(google-explicit-constructor)
  Any_simulation(std::unique_ptr<Polynomial_discs> simulation)
      : simulation_(std::move(simulation)) {}
  /// @}

  /// What `function` gives for the simulation, whichever it is.
  template <class Function>
  std::invoke_result_t<Function, Linear&> visit(Function function) const {
    // The type of the result stands here, so that std::visit need not look into the function for
    // it: clang forgets virtual functions of objects that are made where it only looks (LLVM issue
    // 60965).
    return std::visit(
        [&](const auto& simulation) -> std::invoke_result_t<Function, Linear&> {
          return function(*simulation);
        },
        simulation_);
  }

 private:
  std::variant<std::unique_ptr<Linear>, std::unique_ptr<Polynomial>, std::unique_ptr<Discs>,
               std::unique_ptr<Polynomial_discs>>
      simulation_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_ANY_SIMULATION_H
