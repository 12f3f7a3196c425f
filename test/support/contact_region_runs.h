// SPDX-License-Identifier: GPL-3.0-or-later
//
// Optimistic parallel execution of simulations, compared with the sequential loop.
#ifndef KINETRI_TEST_SUPPORT_CONTACT_REGION_RUNS_H
#define KINETRI_TEST_SUPPORT_CONTACT_REGION_RUNS_H

#include <tbb/global_control.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "kinetri/simulation/recording.h"
#include "kinetri/simulation/simulation_2.h"
#include "simulation/contact_events.h"
#include "support/region_runs.h"

namespace kinetri::test {

/// Points in a square, at least `apart` from each other, with velocity components up to `speed`.
inline std::vector<Linear_motion_2> gas(std::size_t n, double side, double apart, double speed,
                                        unsigned seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  // One in each cell of a grid.
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(n))));
  const double cell = side / static_cast<double>(columns);
  std::vector<Linear_motion_2> result;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = cell * static_cast<double>(k % columns);
    const double y = cell * static_cast<double>(k / columns);
    const double free = cell - apart;
    result.push_back({{x + apart / 2 + between(0, free), y + apart / 2 + between(0, free)},
                      {between(-speed, speed), between(-speed, speed)}});
  }
  return result;
}

/// Points on a lattice with integer velocities, so that many events are simultaneous.
inline std::vector<Linear_motion_2> on_lattice(std::size_t n, std::size_t columns, unsigned seed) {
  std::mt19937_64 random(seed);
  const auto whole = [&] { return static_cast<double>(random() % 7) - 3; };
  std::vector<Linear_motion_2> result;
  for (std::size_t k = 0; k < n; ++k) {
    result.push_back(
        {{static_cast<double>(2 * (k % columns)), static_cast<double>(2 * (k / columns))},
         {whole(), whole()}});
  }
  return result;
}

template <class Traits>
std::string difference_of_simulations(const Simulation_2<Traits>& one,
                                      const Simulation_2<Traits>& other) {
  const std::string found = difference_of_states(one.triangulation(), other.triangulation());
  if (!found.empty()) return found;
  const auto a = one.snapshot();
  const auto b = other.snapshot();
  if (a.in_contact != b.in_contact) return "pairs in contact";
  if (a.scheduled.size() != b.scheduled.size()) return "scheduled changes";
  if (a.counters.instants != b.counters.instants) return "instants with contacts alone";
  if (a.counters.most_at_one_time != b.counters.most_at_one_time) return "contacts at one time";
  for (Point_id id = 0; id < one.triangulation().next_id(); ++id) {
    if (!one.options().response || !one.triangulation().contains(id)) continue;
    if (one.overlapping_discs(id) != other.overlapping_discs(id)) return "overlaps";
  }
  return {};
}

/// Erases the disc with the smaller mass.
inline Contact_response_2 erase_lighter(const Contact_2& contact) {
  Contact_response_2 result;
  (contact.mass_a < contact.mass_b ? result.erases_a : result.erases_b) = true;
  return result;
}

/// The difference between the sequential loop and parallel execution, with and without observers,
/// in pieces that end at `times`. Calls change(simulation) before each piece.
template <class Traits = Linear_kinetic_traits_2>
std::string difference_from_loop(
    const std::vector<typename Traits::Motion>& motions, const Simulation_options& options,
    const std::vector<Algebraic_number>& times, const Region_options& regions, Region_counters& sum,
    const std::function<void(Simulation_2<Traits>&)>& change = [](Simulation_2<Traits>&) {},
    const Traits& traits = {}) {
  using Run = Simulation_2<Traits>;
  // More threads than this machine may have.
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 8);
  Run plain(motions, options, 0, traits);
  Run watched(motions, options, 0, traits);
  Run alone(motions, options, 0, traits);
  Log expected;
  Log log;
  plain.add_observer(expected);
  watched.add_observer(log);
  const double end = times.back().to_double();
  kinetri::Recorder<Traits> expected_recorder(plain.triangulation(), end, 1'000'000);
  kinetri::Recorder<Traits> recorder(watched.triangulation(), end, 1'000'000);
  plain.add_observer(expected_recorder);
  watched.add_observer(recorder);
  auto watched_run = detail::region_run_of(watched, regions);
  for (const Algebraic_number& time : times) {
    for (Run* simulation : {&plain, &watched, &alone}) change(*simulation);
    const std::size_t count = plain.advance_to(time);
    if (watched_run.advance_to(time) != count) return "another number of events";
    // Each call of advance_to makes a run.
    if (detail::region_run_of(alone, regions).advance_to(time) != count) {
      return "another number of events without an observer";
    }
    std::string problem = difference(expected.events, log.events);
    if (!problem.empty()) return problem;
    if (expected.befores != log.befores) return "other numbers of events";
    if (expected.rebuilds != log.rebuilds) return "other edges rebuilt";
    problem = difference_of_simulations(plain, watched);
    if (!problem.empty()) return problem;
    problem = difference_of_simulations(plain, alone);
    if (!problem.empty()) return problem + " without an observer";
    const Audit_report report =
        alone.audit(motions.size() < 200 ? Audit_level::certificates : Audit_level::links);
    if (!report.failures.empty()) return report.failures.front();
  }
  add(sum, watched_run.counters());
  const Recording expected_recording = expected_recorder.recording();
  const Recording recording = recorder.recording();
  if (expected_recording.events.size() != recording.events.size()) return "recorded events";
  if (expected_recording.triangles != recording.triangles) return "recorded triangles";
  if (expected_recording.motions.size() != recording.motions.size()) return "recorded motions";
  for (std::size_t k = 0; k < recording.motions.size(); ++k) {
    if (expected_recording.motions[k].motion != recording.motions[k].motion) {
      return "recorded motion " + std::to_string(k);
    }
  }
  return {};
}

/// Changes some points in a square of the given side, or schedules changes within a unit of time.
template <class Traits>
void change_some_points(Simulation_2<Traits>& simulation, double side, std::mt19937_64& random) {
  const auto number = [&](double least, double greatest) {
    return std::uniform_real_distribution<double>(least, greatest)(random);
  };
  const double now = simulation.current_time().to_double();
  const Point_id next_id = simulation.triangulation().next_id();
  for (int k = 0; k < 6; ++k) {
    const Linear_motion_2 motion = {
        {number(1, side - 1), number(1, side - 1)}, {number(-5, 5), number(-5, 5)}, now + 0.5};
    const auto id = static_cast<Point_id>(random() % next_id);
    const bool is_there = simulation.triangulation().contains(id);
    if (k < 2) simulation.schedule_insert(now + number(0, 1), motion);
    if (k == 2 && is_there) simulation.erase(id);
    if (k == 3) simulation.schedule_erase(now + number(0, 0.5), id);
    if (k > 3 && is_there) {
      const Vector_2 velocity = {number(-9, 9), number(-9, 9)};
      simulation.set_velocities({&id, 1}, {&velocity, 1});
    }
  }
}

inline Simulation_options in_square(double side) {
  Simulation_options options;
  options.box = Box_2{0, 0, side, side};
  return options;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_CONTACT_REGION_RUNS_H
