// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine.h"

#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

#include "kinetri/base/error.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "make_engine.h"

namespace kinetri::python {
namespace {

Vector_2 vector_at(const double* column, std::size_t i) {
  return column == nullptr ? Vector_2() : Vector_2{column[2 * i], column[2 * i + 1]};
}

double number_at(const double* column, std::size_t i) {
  return column == nullptr ? 0 : column[i];
}

// Throws if points of the kind cannot be in a periodic box.
void check_in_box(const Motion_kind& kind) {
  if (!kind.is_polynomial) return;
  throw Precondition_error(
      "acceleration and jerk are not possible in a periodic box; expected points on straight "
      "lines");
}

// Calls `function` with the traits of the kind of motion.
template <class Function>
auto with_traits(const Motion_kind& kind, const Function& function) {
  if (kind.has_weight) {
    return kind.is_polynomial ? function(std::type_identity<Polynomial_disc_kinetic_traits_2>())
                              : function(std::type_identity<Disc_kinetic_traits_2>());
  }
  return kind.is_polynomial ? function(std::type_identity<Polynomial_kinetic_traits_2>())
                            : function(std::type_identity<Linear_kinetic_traits_2>());
}

}  // namespace

Polynomial_disc_motion_2 Motion_columns::operator[](std::size_t i) const {
  return {{vector_at(positions, i), vector_at(velocities, i), vector_at(accelerations, i),
           vector_at(jerks, i), epoch},
          number_at(radii, i),
          number_at(growths, i),
          number_at(weights, i)};
}

std::unique_ptr<Engine> make_triangulation(const Motion_columns& motions, const Motion_kind& kind,
                                           const Algebraic_number& start,
                                           Coincident_points coincident,
                                           const std::optional<Periodic_box_2>& box) {
  if (box) {
    check_in_box(kind);
    KINETRI_PRECONDITION(!kind.has_weight,
                         "a triangulation of discs in a periodic box; expected points");
    return make_engine(motions, start, coincident, Periodic_kinetic_traits_2(*box));
  }
  return with_traits(kind, [&]<class Traits>(std::type_identity<Traits>) {
    return make_engine(motions, start, coincident, Traits());
  });
}

std::unique_ptr<Engine> make_simulation(const Motion_columns& motions, const Motion_kind& kind,
                                        const Algebraic_number& start,
                                        const Simulation_options& options,
                                        const std::optional<Periodic_box_2>& box) {
  if (box) {
    check_in_box(kind);
    if (kind.has_weight) {
      return make_engine(motions, start, options, Periodic_disc_kinetic_traits_2(*box));
    }
    return make_engine(motions, start, options, Periodic_kinetic_traits_2(*box));
  }
  return with_traits(kind, [&]<class Traits>(std::type_identity<Traits>) {
    return make_engine(motions, start, options, Traits());
  });
}

std::unique_ptr<Engine> restore(const Checkpoint& checkpoint, Engine_kind kind,
                                Collision_response response) {
  return std::visit(
      [&]<class Traits>(const Simulation_snapshot<Traits>& snapshot) {
        if constexpr (PeriodicKineticTraits_2<Traits>) {
          return make_engine(snapshot, kind, std::move(response), Traits(*checkpoint.periodic_box));
        } else {
          return make_engine(snapshot, kind, std::move(response), Traits());
        }
      },
      checkpoint.simulation);
}

std::unique_ptr<Engine> make_tracks_simulation(std::span<const std::vector<Observation_2>> tracks,
                                               std::span<const double> radii,
                                               std::span<const Stay> stays, double start,
                                               const Simulation_options& options) {
  if (radii.empty()) return make_engine(simulate_tracks(tracks, stays, start, options));
  return make_engine(simulate_tracks(tracks, radii, stays, start, options));
}

}  // namespace kinetri::python
