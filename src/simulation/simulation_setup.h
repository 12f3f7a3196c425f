// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input of a simulation: traits, box, discs and masses; and which motions it allows.
#ifndef KINETRI_SRC_SIMULATION_SIMULATION_SETUP_H
#define KINETRI_SRC_SIMULATION_SIMULATION_SETUP_H

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "kinetri/impl/base/check.h"
#include "kinetri/kinetic/kinetic_traits_2.h"
#include "kinetri/simulation/simulation_errors.h"
#include "kinetri/simulation/simulation_options.h"
#include "simulation/disc_numbers.h"
#include "simulation/known_responses.h"
#include "simulation/shortest_text.h"
#include "simulation/simulation_types.h"

namespace kinetri::detail {

/// The options of a simulation, and values derived from them. Only masses change.
template <class Traits>
class Simulation_types<Traits>::Simulation_setup {
 public:
  /// problem() says whether the options are valid.
  Simulation_setup(const Traits& traits, const Simulation_options& options)
      : traits_(traits), options_(options), diameter_(2 * options.radius) {
    if (!options_.box) return;
    walls_ = options_.box->walls(options_.rim_touches ? options_.radius : 0);
    for (Wall_2& wall : walls_) wall.rim_touches = has_radii && options_.rim_touches;
  }

  const Traits& traits() const { return traits_; }
  const Simulation_options& options() const { return options_; }
  /// The diameter of all discs, if they have no radii of their own.
  double diameter() const { return diameter_; }
  bool has_box() const { return options_.box.has_value(); }
  const std::array<Wall_2, 4>& walls() const { return walls_; }
  /// Whether discs have contacts.
  bool has_response() const { return options_.response != nullptr; }
  void set_response(Collision_response response) { options_.response = std::move(response); }
  /// Whether a disc may overlap an image of itself, in a periodic box.
  bool lets_images_overlap() const { return is_let_images_overlap(options_.response); }

  double mass(Point_id id) const { return id < options_.masses.size() ? options_.masses[id] : 1; }
  void set_mass(Point_id id, double mass) {
    if (mass == this->mass(id)) return;
    if (id >= options_.masses.size()) options_.masses.resize(id + 1, 1.0);
    options_.masses[id] = mass;
  }
  /// The masses of this id and of greater ones are 1 from now on.
  void forget_masses_from(Point_id id) {
    if (id < options_.masses.size()) options_.masses.resize(id);
  }

  /// The error of the options; empty if they are valid.
  std::string problem() const;
  /// Throws if a point is outside of the box at `now`, or its radius is negative just after that.
  void check_place(const Point_2& p, const Time& now) const;

 private:
  template <HasWeight M = Motion>
  void check_radius(const Point_2& p, const Time& now) const;

  Traits traits_;
  Simulation_options options_;
  double diameter_ = 0;
  std::array<Wall_2, 4> walls_ = {};
};

template <class Traits>
std::string Simulation_types<Traits>::Simulation_setup::problem() const {
  if (!std::isfinite(diameter_) || !(options_.radius >= 0)) {
    return "the radius is negative, or the diameter is not finite";
  }
  if (has_radii && options_.radius != 0) {
    return "a radius for all discs, which have their own; leave it 0";
  }
  if (!has_radii && options_.response && options_.radius == 0) {
    return zero_radius_message;
  }
  for (Point_id id = 0; id < options_.masses.size(); ++id) {
    const std::string problem = mass_problem(id, options_.masses[id]);
    if (!problem.empty()) return problem;
  }
  if (!options_.box) return {};
  if (is_periodic) return "a box with walls, besides the periodic box of the traits; take one";
  const auto& [xmin, ymin, xmax, ymax] = *options_.box;
  if (!std::isfinite(xmin) || !std::isfinite(ymin) || !std::isfinite(xmax) ||
      !std::isfinite(ymax) || !(xmin < xmax && ymin < ymax)) {
    return "the box has no area or is not finite";
  }
  const Rational diameter = to_rational(diameter_);
  if (options_.rim_touches && (to_rational(xmax) - to_rational(xmin) <= diameter ||
                               to_rational(ymax) - to_rational(ymin) <= diameter)) {
    return "the box is not wider and higher than a disc whose rim touches it";
  }
  return {};
}

template <class Traits>
void Simulation_types<Traits>::Simulation_setup::check_place(const Point_2& p,
                                                             const Time& now) const {
  if constexpr (has_radii) check_radius(p, now);
  if constexpr (!is_periodic) {
    if (!options_.box) return;
    for (const Wall_2& wall : walls_) {
      if (traits_.is_inside(p, wall, now)) continue;
      const double time = now.to_double();
      const Vector_2 place = rounded_place(p.motion(), time);
      throw Outside_box_error(
          p.id(), "point " + std::to_string(p.id()) + " is outside of the box at t = " +
                      text(time) + ": at " + text(place.x) + ", " + text(place.y) +
                      (wall.clearance > 0 || wall.rim_touches ? ", its rim" : "") + " beyond the " +
                      std::string(name(wall.side)) + " side at " + text(wall.position) +
                      "; expected every point inside of the box or on its sides");
    }
  }
}

template <class Traits>
template <HasWeight M>
void Simulation_types<Traits>::Simulation_setup::check_radius(const Point_2& p,
                                                              const Time& now) const {
  const Motion& disc = p.motion();
  KINETRI_PRECONDITION(!options_.response || disc.weight == 0,
                       "disc " + std::to_string(p.id()) +
                           " has a weight besides its radius; discs that collide have none");
  const auto is_negative = [&] {
    if (disc.growth == 0) return disc.radius < 0;
    const Time zero = zero_of_radius(disc);
    return disc.growth > 0 ? now < zero : now > zero;
  };
  if (!is_negative()) return;
  throw Negative_radius_error(p.id(), now.detached(),
                              "the radius of disc " + std::to_string(p.id()) +
                                  " is negative at t = " + text(now) + ": " + text(disc.radius) +
                                  " at t = " + text(disc.epoch) + ", with the growth " +
                                  text(disc.growth) + "; expected a radius of 0 or more");
}

}  // namespace kinetri::detail

#endif  // KINETRI_SRC_SIMULATION_SIMULATION_SETUP_H
