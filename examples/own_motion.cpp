// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 7, user-defined motion and rules: balls fall, and bounce by a response defined here.
#include <kinetri/simulation/simulation_2.h>

#include <iostream>
#include <vector>

using kinetri::Vector_2;
using Simulation = kinetri::Simulation_2<kinetri::Polynomial_kinetic_traits_2>;

// Balls of equal mass that lose half of their speed of approach. The velocities returned are
// rounded; from then on the balls move exactly with these.
static kinetri::Contact_response_2 bounce_softly(const kinetri::Contact_2& contact) {
  const Vector_2& n = contact.separation;  // from the center of a to the center of b
  const Vector_2& a = contact.velocity_a;
  const Vector_2& b = contact.velocity_b;
  const double approach = ((b.x - a.x) * n.x + (b.y - a.y) * n.y) / (n.x * n.x + n.y * n.y);
  const double impulse = 0.75 * approach;
  const Vector_2 new_a = {a.x + impulse * n.x, a.y + impulse * n.y};
  const Vector_2 new_b = {b.x - impulse * n.x, b.y - impulse * n.y};
  // After rounding, two balls that barely touch may still approach each other: decided exactly.
  // An empty response leaves both motions as they are, and the next contact of the two can only
  // come after they have separated.
  if (contact.would_approach(new_a, new_b)) return {};
  return {new_a, new_b};
}

static void print_balls(const Simulation& simulation) {
  const double t = simulation.current_time().to_double();
  std::cout << "t = " << t << ", events "
            << simulation.triangulation().counters().number_of_events() << '\n';
  for (kinetri::Point_id id = 0; id < 2; ++id) {
    const kinetri::Polynomial_motion_2& motion = simulation.triangulation().motion(id);
    const Vector_2 position = rounded_place(motion, t);
    const Vector_2 velocity = rounded_velocity(motion, t);
    std::cout << "  ball " << id << " at (" << position.x << ", " << position.y << "), velocity ("
              << velocity.x << ", " << velocity.y << ")\n";
  }
}

int main() {
  // {position, velocity, acceleration} at time 0; what is omitted is zero. Two balls are thrown
  // toward each other; two lanterns hang.
  const Vector_2 gravity = {0, -2};
  const std::vector<kinetri::Polynomial_motion_2> motions = {
      {{0, 0}, {3, 4}, gravity}, {{7, 0}, {-3, 4}, gravity}, {{-2, 6}}, {{9, 7}}};

  kinetri::Simulation_options options;
  options.box = kinetri::Box_2{-8, 0, 16, 12};
  options.radius = 0.5;
  options.response = bounce_softly;

  Simulation simulation(motions, options);
  for (const double t : {0.5, 1.0, 4.0, 5.0}) {
    simulation.advance_to(t);
    print_balls(simulation);
  }
  return simulation.audit(kinetri::Audit_level::certificates).passed() ? 0 : 1;
}
