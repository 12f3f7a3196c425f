// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "kinetri/observers/connected_components.h"
#include "kinetri/observers/kinetic_spanning_tree_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

// The mean number of others in range of a point: near the percolation threshold, so that merges and
// splits are frequent and components are large.
constexpr double most_in_range = 4.5;

constexpr std::size_t most_points_of_a_tree = 10'000;

}  // namespace

json measure_components(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  const double n = static_cast<double>(motions.size());
  const double side = setup.options.side.value_or(10 * std::sqrt(n));
  const double range = side * std::sqrt(most_in_range / (3.14159265358979 * n));
  return median_round([&]() -> json {
    json result;
    // The time of the run and of the observer's answer at its end.
    const auto seconds = [&](Kinetic_delaunay_triangulation_2<>& kinetic, const auto& answer) {
      const Stopwatch watch;
      kinetic.advance_to(setup.until);
      answer();
      return watch.seconds();
    };
    Kinetic_delaunay_triangulation_2<> alone(motions);
    const double bare = seconds(alone, [] {});
    result["bare_seconds"] = bare;
    result["events"] = alone.counters().number_of_events();

    Kinetic_delaunay_triangulation_2<> linked(motions);
    Connected_components components(linked, range);
    result["components_ratio"] = ratio(
        seconds(linked, [&] { result["merges_and_splits"] = components.events().size() - 1; }),
        bare);

    if (motions.size() > most_points_of_a_tree) return result;
    Kinetic_delaunay_triangulation_2<> spanned(motions);
    Kinetic_spanning_tree_2 tree(spanned);
    result["spanning_tree_ratio"] = ratio(
        seconds(spanned, [&] { result["changes_of_the_tree"] = tree.changes().size(); }), bare);
    return result;
  });
}

}  // namespace kinetri::bench
