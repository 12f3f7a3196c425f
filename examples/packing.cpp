// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 11, packings: discs that grow in a box until they cover a share of it, or are jammed.
#include <kinetri/algebra/number_types.h>
#include <kinetri/simulation/growth.h>
#include <kinetri/simulation/scenarios.h>

#include <iostream>
#include <vector>

using Simulation = kinetri::Simulation_2<kinetri::Disc_kinetic_traits_2>;
using kinetri::Rational;
using kinetri::to_rational;

// Points with random places and velocities in the square of side 10 that become discs: every second
// one grows 1.4 times as fast as the others.
static std::vector<kinetri::Disc_motion_2> growing_points(std::size_t number) {
  kinetri::Scenario_options options;
  options.points = number;
  options.side = 10;
  options.speed = 1;
  std::vector<kinetri::Disc_motion_2> result;
  for (const auto& motion : kinetri::make_scenario(kinetri::Scenario::uniform, options)) {
    result.push_back({motion, 0, result.size() % 2 == 0 ? 0.05 : 0.07});
  }
  return result;
}

static kinetri::Simulation_options in_a_box() {
  kinetri::Simulation_options options;
  options.box = kinetri::Box_2{0, 0, 10, 10};
  options.rim_touches = true;
  options.response = kinetri::collide_elastically;
  return options;
}

// Lets the discs grow until they cover the share of the box. Returns false if they are jammed
// before.
static bool grow(Simulation& simulation, double share) {
  double end = *kinetri::time_of_share(simulation, share);
  kinetri::Jam_watch watch(kinetri::mean_radius(simulation, end));
  while (simulation.current_time() != end) {
    while (simulation.step(end) > 0) {
      if (watch.is_jammed(simulation)) return false;
    }
    simulation.advance_to(end);
    // Contacts round radii down, so the discs may have to grow a little more.
    end = *kinetri::time_of_share(simulation, share);
  }
  return true;
}

struct Exact_disc {
  Rational x, y, radius;
};

// Whether no two discs overlap, and all are in the box: exactly, over all pairs.
static bool are_apart(const Simulation& simulation) {
  const Rational t = simulation.current_time().rational();
  std::vector<Exact_disc> discs;
  for (kinetri::Point_id id = 0; id < simulation.triangulation().number_of_points(); ++id) {
    const kinetri::Disc_motion_2& disc = simulation.triangulation().motion(id);
    const Rational past = t - to_rational(disc.epoch);
    discs.push_back({to_rational(disc.position.x) + to_rational(disc.velocity.x) * past,
                     to_rational(disc.position.y) + to_rational(disc.velocity.y) * past,
                     to_rational(disc.radius) + to_rational(disc.growth) * past});
  }
  for (auto a = discs.begin(); a != discs.end(); ++a) {
    if (a->x < a->radius || a->y < a->radius) return false;
    if (a->x + a->radius > 10 || a->y + a->radius > 10) return false;
    for (auto b = discs.begin(); b != a; ++b) {
      const Rational x = a->x - b->x, y = a->y - b->y, contact = a->radius + b->radius;
      if (x * x + y * y < contact * contact) return false;
    }
  }
  return true;
}

int main() {
  Simulation simulation(growing_points(40), in_a_box());
  for (const double share : {0.2, 0.5, 0.7, 0.75}) {
    if (!grow(simulation, share)) return 1;
    std::cout << "t = " << simulation.current_time().to_double() << ": the discs cover "
              << kinetri::covered_share(simulation) << " of the box, and are "
              << (are_apart(simulation) ? "apart" : "not apart") << '\n';
  }
  const bool is_there = grow(simulation, 0.9);
  std::cout << "t = " << simulation.current_time().to_double() << ": the discs cover "
            << kinetri::covered_share(simulation) << " of the box, and are "
            << (is_there ? "there" : "jammed") << '\n';
  return simulation.audit(kinetri::Audit_level::certificates).passed() ? 0 : 1;
}
