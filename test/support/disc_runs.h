// SPDX-License-Identifier: GPL-3.0-or-later
//
// Simulations of discs, and the least distances between discs, computed from the motions alone.
#ifndef KINETRI_TEST_SUPPORT_DISC_RUNS_H
#define KINETRI_TEST_SUPPORT_DISC_RUNS_H

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kinetri/simulation/simulation_2.h"
#include "support/motions.h"

namespace kinetri::test {

using Simulation = Simulation_2<>;
using Simulation_event = Event;

struct Recorder : Event_observer {
  void after_event(const Simulation_event& event) override { events.push_back(event); }

  std::vector<Simulation_event> of(Event_kind kind) const {
    return chosen([kind](const Simulation_event& event) { return event.kind == kind; });
  }

  /// The contacts with walls and of discs.
  std::vector<Simulation_event> contacts() const {
    return chosen([](const Simulation_event& event) {
      return event.kind == Event_kind::wall || event.kind == Event_kind::collision;
    });
  }

  std::vector<Simulation_event> chosen(auto condition) const {
    std::vector<Simulation_event> result;
    std::ranges::copy_if(events, std::back_inserter(result), condition);
    return result;
  }

  std::vector<Simulation_event> events;
};

inline Simulation_options in_box(const Box_2& box) {
  Simulation_options options;
  options.box = box;
  return options;
}

inline Simulation_options discs(double radius, Collision_response response) {
  Simulation_options options;
  options.radius = radius;
  options.response = std::move(response);
  return options;
}

/// The same in a box.
inline Simulation_options discs(const Box_2& box, double radius, Collision_response response) {
  Simulation_options options = discs(radius, std::move(response));
  options.box = box;
  return options;
}

template <class Traits>
Vector_2 velocity(const Simulation_2<Traits>& simulation, Point_id id) {
  return simulation.triangulation().motion(id).velocity;
}

/// n discs on a square lattice of width 10, each shifted by up to `jitter`, in the box that the
/// lattice fills, with velocity components in [-5, 5].
inline std::vector<Linear_motion_2> discs_in_a_box(std::size_t n, double jitter, unsigned seed) {
  const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  std::uniform_real_distribution<double> velocity(-5, 5);
  std::vector<Linear_motion_2> motions(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t row = i / side;
    const double x = 10.0 * static_cast<double>(i % side) + shift(random);
    const double y = 10.0 * static_cast<double>(row) + shift(random);
    const double vx = velocity(random);
    motions[i] = {{x, y}, {vx, velocity(random)}, 0};
  }
  return motions;
}

inline Box_2 box_of(std::size_t n) {
  const double side = 10 * std::ceil(std::sqrt(static_cast<double>(n)));
  return {-5, -5, side - 5, side - 5};
}

/// Sums over all points: of squared speeds, and of velocities, each times the mass.
struct Conserved {
  long double energy = 0;
  long double momentum_x = 0;
  long double momentum_y = 0;
};

template <class Traits>
Conserved conserved(const Simulation_2<Traits>& simulation) {
  Conserved sum;
  for (Point_id id = 0; id < simulation.triangulation().next_id(); ++id) {
    if (!simulation.triangulation().contains(id)) continue;
    const Vector_2 v = velocity(simulation, id);
    const long double mass = simulation.mass(id);
    sum.energy +=
        mass * (static_cast<long double>(v.x) * v.x + static_cast<long double>(v.y) * v.y);
    sum.momentum_x += mass * v.x;
    sum.momentum_y += mass * v.y;
  }
  return sum;
}

/// Computes the least distance of any two points over a run from their motions.
class Distance_watcher : public Simulation::Observer {
 public:
  explicit Distance_watcher(Simulation& simulation) : simulation_(simulation) {
    remember();
    simulation.add_observer(*this);
  }

  void before_event(const Simulation_event& event) override {
    if (event.kind == Event_kind::wall || event.kind == Event_kind::collision) {
      look_until(event.time.to_double());
    }
  }
  void after_event(const Simulation_event& event) override {
    if (event.kind == Event_kind::wall || event.kind == Event_kind::collision) remember();
  }

  /// Examines the paths from the last change to `time`.
  void look_until(double time) {
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        least_ = std::min(least_, least_distance(motions_[i], motions_[j], since_, time));
      }
    }
    since_ = time;
  }

  long double least() const { return least_; }

 private:
  using Number = long double;

  static Number least_distance(const Linear_motion_2& p, const Linear_motion_2& q, Number from,
                               Number to) {
    const auto at = [](double x, double v, double epoch, Number t) {
      return Number(x) + Number(v) * (t - Number(epoch));
    };
    const auto difference = [&](Number t) {
      return std::pair(
          at(p.position.x, p.velocity.x, p.epoch, t) - at(q.position.x, q.velocity.x, q.epoch, t),
          at(p.position.y, p.velocity.y, p.epoch, t) - at(q.position.y, q.velocity.y, q.epoch, t));
    };
    const auto [x, y] = difference(from);
    const Number vx = Number(p.velocity.x) - Number(q.velocity.x);
    const Number vy = Number(p.velocity.y) - Number(q.velocity.y);
    const Number speed = vx * vx + vy * vy;
    const Number nearest = speed == 0 ? from : from - (x * vx + y * vy) / speed;
    const auto [nx, ny] = difference(std::clamp(nearest, from, std::max(from, to)));
    return std::sqrt(nx * nx + ny * ny);
  }

  void remember() {
    motions_.clear();
    for (Point_id id = 0; id < simulation_.triangulation().next_id(); ++id) {
      if (simulation_.triangulation().contains(id)) {
        motions_.push_back(simulation_.triangulation().motion(id));
      }
    }
  }

  const Simulation& simulation_;
  std::vector<Linear_motion_2> motions_;
  Number since_ = 0;
  Number least_ = std::numeric_limits<Number>::infinity();
};

/// Steps to `until` with an audit after each instant. Returns the first problem, or an empty
/// string.
inline std::string audited_run(Simulation& simulation, double until, Audit_level level) {
  const auto problem = [&](Audit_level l) -> std::string {
    const Audit_report report = simulation.audit(l);
    if (report.passed()) return {};
    return "at " + std::to_string(simulation.current_time().to_double()) + ": " +
           report.failures.front();
  };
  std::string found = problem(Audit_level::certificates);
  while (found.empty() && simulation.step(Algebraic_number(until)) > 0) found = problem(level);
  if (!found.empty()) return found;
  simulation.advance_to(until);
  return problem(Audit_level::certificates);
}

template <class Traits>
std::uint64_t count(const Simulation_2<Traits>& simulation, Event_kind kind) {
  return simulation.triangulation().counters().events[static_cast<std::size_t>(kind)];
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_DISC_RUNS_H
