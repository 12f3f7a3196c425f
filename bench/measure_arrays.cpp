// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numeric>
#include <vector>

#include "../python/src/event_table.h"
#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

constexpr std::size_t most_turns = 1000;

json measure_round(const Setup& setup, const std::vector<Linear_motion_2>& motions) {
  json result;
  const Stopwatch construction;
  Kinetic_delaunay_triangulation_2<> kinetic(motions);
  result["construction_seconds"] = construction.seconds();

  std::vector<Point_id> ids(std::min(most_turns, motions.size()));
  std::iota(ids.begin(), ids.end(), 0);
  std::vector<Linear_motion_2> turned;
  const Stopwatch turns;
  for (const Point_id id : ids) {
    turned.push_back(with_velocity_at(kinetic.motion(id), motions.back().velocity, 0));
    turned.back().velocity.x += 1e-3 * id;
  }
  kinetic.set_motions(ids, turned);
  kinetic.next_event_time();  // computes certificates that set_motions has deferred
  result["turns_seconds"] = turns.seconds();
  for (const Point_id id : ids) turned[id] = motions[id];
  kinetic.set_motions(ids, turned);
  kinetic.next_event_time();

  using Table = python::Event_table<python::Event_row>;
  Table::Kinds all;
  all.fill(true);
  Table table(all);
  kinetic.add_observer(table);
  const Stopwatch run;
  kinetic.advance_to(setup.until);
  result["record_seconds"] = run.seconds();
  kinetic.remove_observer(table);
  result["events"] = table.take().size();
  return result;
}

}  // namespace

json measure_arrays(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  return median_round([&] { return measure_round(setup, motions); });
}

}  // namespace kinetri::bench
