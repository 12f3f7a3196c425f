// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstddef>
#include <random>
#include <stdexcept>
#include <vector>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;
using Kinetic = Kinetic_delaunay_triangulation_2<>;

template <class Function>
double seconds_of(const Function& function) {
  const Stopwatch watch;
  function();
  return watch.seconds();
}

}  // namespace

json measure_batches(const Setup& setup) {
  constexpr int rounds = 5;
  constexpr std::size_t period = 10;
  const std::vector<Linear_motion_2> motions = setup.motions();
  Kinetic one(motions);
  Kinetic two(motions);
  one.set_threads(1);
  two.set_threads(2);
  std::mt19937_64 random(setup.options.seed);
  std::uniform_int_distribution<std::size_t> any(0, motions.size() - 1);
  std::vector<double> ratios;
  std::vector<double> run_ratios;
  json result;
  for (int round = 0; round < rounds; ++round) {
    const double now = setup.until * (round + 1) / rounds;
    const double one_run = seconds_of([&] { one.advance_to(now); });
    run_ratios.push_back(ratio(one_run, seconds_of([&] { two.advance_to(now); })));
    if (!detail::Core_access::core(two).schedule.queue().is_divided()) {
      throw std::runtime_error(
          "two threads have left the queue in one part, so that they change motions as one thread "
          "does; expected more events: take more points, or a greater --until");
    }
    std::vector<Point_id> ids;
    std::vector<Linear_motion_2> others;
    for (std::size_t id = 0; id < motions.size(); id += period) {
      ids.push_back(static_cast<Point_id>(id));
      const Vector_2& velocity = motions[any(random)].velocity;
      others.push_back(with_velocity_at(one.motion(ids.back()), velocity, now));
    }
    // The order alternates.
    const auto change_one = [&] { one.set_motions(ids, others); };
    double one_seconds = 0;
    if (round % 2 == 0) one_seconds = seconds_of(change_one);
    const double two_seconds = seconds_of([&] { two.set_motions(ids, others); });
    if (round % 2 == 1) one_seconds = seconds_of(change_one);
    result["motions"] = ids.size();
    result["one_thread_seconds"] = one_seconds;
    result["two_threads_seconds"] = two_seconds;
    ratios.push_back(ratio(one_seconds, two_seconds));
  }
  if (one.finite_edge_ids() != two.finite_edge_ids()) {
    throw std::runtime_error("the edges with two threads are not those with one thread");
  }
  std::ranges::sort(ratios);
  std::ranges::sort(run_ratios);
  result["one_thread_over_two"] = ratios;
  result["run_one_thread_over_two"] = run_ratios;
  return result;
}

}  // namespace kinetri::bench
