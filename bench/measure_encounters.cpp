// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinetri/observers/encounters.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

constexpr double neighbors_in_range = 5;
constexpr double density = 0.01;  // of points: 100 in 100 x 100
constexpr std::size_t most_for_all_pairs = 10'000;

// The pairs of points in linear motion that come in range of each other: rounded, not certified.
std::size_t encounters_of_all_pairs(const std::vector<Linear_motion_2>& motions, double range,
                                    double until) {
  std::size_t result = 0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    for (std::size_t j = i + 1; j < motions.size(); ++j) {
      const double x = motions[i].position.x - motions[j].position.x;
      const double y = motions[i].position.y - motions[j].position.y;
      const double vx = motions[i].velocity.x - motions[j].velocity.x;
      const double vy = motions[i].velocity.y - motions[j].velocity.y;
      const double squared_speed = vx * vx + vy * vy;
      double t = squared_speed > 0 ? -(x * vx + y * vy) / squared_speed : 0;
      t = std::clamp(t, 0.0, until);
      const double dx = x + vx * t;
      const double dy = y + vy * t;
      if (dx * dx + dy * dy <= range * range) ++result;
    }
  }
  return result;
}

json measure_round(const std::vector<Linear_motion_2>& motions, double range, double until) {
  const auto seconds_of = [&](auto observe) {
    Simulation_2<> simulation(motions, {});
    const Stopwatch watch;
    return observe(simulation, watch);
  };
  const double bare = seconds_of([&](Simulation_2<>& simulation, const Stopwatch& watch) {
    simulation.advance_to(until);
    return watch.seconds();
  });
  double start = 0;
  double answer = 0;
  json result;
  const double observed = seconds_of([&](Simulation_2<>& simulation, const Stopwatch& watch) {
    Encounters encounters(simulation, range);
    start = watch.seconds();
    const std::size_t events = simulation.advance_to(until);
    const double end = watch.seconds();
    const std::size_t number = encounters.encounters().size();
    answer = watch.seconds() - end;
    const auto& certificates = encounters.certificate_counters();
    result = {{"events", events},
              {"encounters", number},
              {"certificates", certificates.created},
              {"exact_certificates", certificates.exact_decided}};
    return end - start;
  });
  const double number = result["encounters"].get<double>();
  const double extra = observed - bare;
  result["bare_seconds"] = bare;
  result["seconds"] = observed;
  result["start_seconds"] = start;
  result["answer_seconds"] = answer;
  result["over_bare"] = ratio(observed, bare);
  result["extra_ns_per_event_and_encounter"] =
      1e9 * ratio(extra, result["events"].get<double>() + number);
  result["answer_ns_per_encounter"] = 1e9 * ratio(answer, number);
  if (motions.size() > most_for_all_pairs) return result;
  const Stopwatch watch;
  result["all_pairs_encounters"] = encounters_of_all_pairs(motions, range, until);
  result["all_pairs_seconds"] = watch.seconds();
  return result;
}

}  // namespace

json measure_encounters(const Setup& setup) {
  const auto motions = setup.motions();
  const double range = std::sqrt(neighbors_in_range / (std::numbers::pi * density));
  json result = median_round([&] { return measure_round(motions, range, setup.until); });
  result["range"] = range;
  return result;
}

}  // namespace kinetri::bench
