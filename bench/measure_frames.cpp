// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "kinetri/kinetri.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

constexpr double least_rate = 0x1p-6;
constexpr double greatest_rate = 0x1p20;

// A static triangulation whose vertices are moved from frame to frame.
class Moved_triangulation {
 public:
  Moved_triangulation(const std::vector<Linear_motion_2>& motions, double time) : time_(time) {
    const auto points = positions(motions, time);
    // Moves are fastest in the order of memory.
    triangulation_.insert(points.begin(), points.end());
    std::map<Static_kernel::Point_2, std::size_t> index;
    for (std::size_t i = 0; i < points.size(); ++i) index.emplace(points[i], i);
    for (const auto& vertex : triangulation_.finite_vertex_handles()) {
      movers_.push_back({vertex, motions[index.at(vertex->point())]});
    }
  }

  void advance(double duration) {
    time_ += duration;
    for (const auto& [vertex, motion] : movers_) {
      const double elapsed = time_ - motion.epoch;
      triangulation_.move_if_no_collision(
          vertex, Static_kernel::Point_2(motion.position.x + motion.velocity.x * elapsed,
                                         motion.position.y + motion.velocity.y * elapsed));
    }
  }

 private:
  struct Mover {
    Static_triangulation::Vertex_handle vertex;
    Linear_motion_2 motion;
  };

  double time_;
  Static_triangulation triangulation_;
  std::vector<Mover> movers_;
};

// Seconds per frame of moving each vertex by 1 / rate units of time; the mean over the frames of at
// least 0.2 seconds.
double move_seconds(const std::vector<Linear_motion_2>& motions, double time, double rate) {
  constexpr double enough = 0.2;
  Moved_triangulation triangulation(motions, time);
  // Moved vertices are less ordered in memory: the first frame is not counted.
  triangulation.advance(1 / rate);
  const Stopwatch watch;
  int frames = 0;
  do {
    triangulation.advance(1 / rate);
    ++frames;
  } while (watch.seconds() < enough);
  return watch.seconds() / frames;
}

// The rate at which rate * seconds per frame, which grows with the rate, equals `seconds`. Doubles
// or halves the rate from `start` on until it is bracketed, and interpolates logarithms. `measured`
// receives the seconds per frame by rate.
double crossover(double seconds, double start, const auto& seconds_per_frame,
                 std::map<double, double>& measured) {
  const auto total = [&](double rate) { return rate * (measured[rate] = seconds_per_frame(rate)); };
  double low = start;
  double high = start;
  double at_low = total(start);
  double at_high = at_low;
  while (at_high < seconds && high < greatest_rate) {
    low = high;
    at_low = at_high;
    high *= 2;
    at_high = total(high);
  }
  while (at_low > seconds && low > least_rate) {
    high = low;
    at_high = at_low;
    low *= 0.5;
    at_low = total(low);
  }
  if (!(at_low < at_high)) return low;
  const double share = std::log(seconds / at_low) / std::log(at_high / at_low);
  return low * std::pow(high / low, std::clamp(share, 0.0, 1.0));
}

}  // namespace

json measure_frames(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  const double halfway = 0.5 * setup.until;

  Kinetic_delaunay_triangulation_2<> exact(motions);
  const Stopwatch watch;
  exact.advance_to(setup.until);
  const double kinetic = watch.seconds() / setup.until;

  const double rebuild = rebuild_seconds(positions(motions, halfway));
  const double rebuild_crossover = kinetic / rebuild;
  std::map<double, double> measured;
  const double start = std::exp2(std::round(std::log2(std::max(rebuild_crossover, 1.0))));
  const double move_crossover = crossover(
      kinetic, start, [&](double rate) { return move_seconds(motions, halfway, rate); }, measured);

  json moves = json::array();
  for (const auto& [rate, seconds] : measured) {
    moves.push_back({{"rate", rate}, {"seconds_per_frame", seconds}});
  }
  return {{"kinetic_seconds_per_unit_time", kinetic},
          {"rebuild_seconds_per_frame", rebuild},
          {"rebuild_crossover_rate", rebuild_crossover},
          {"move", moves},
          {"move_crossover_rate", move_crossover}};
}

}  // namespace kinetri::bench
