// SPDX-License-Identifier: GPL-3.0-or-later
#include <random>

#include "kinetri/triangulation/kinetic_delaunay_triangulation_2.h"
#include "measurements.h"

namespace kinetri::bench {
namespace {

using nlohmann::json;

// The changes of a round: random points, and motions for them.
struct Changes {
  std::vector<Point_id> ids;
  std::vector<Linear_motion_2> motions;

  Changes(const Setup& setup, std::mt19937_64& random) {
    Setup other = setup;
    other.options.seed = random();
    motions = other.motions();
    for (Linear_motion_2& m : motions) m.epoch = present;
    std::uniform_int_distribution<Point_id> id(0, static_cast<Point_id>(motions.size() - 1));
    const std::size_t number = std::min<std::size_t>(motions.size() / 2, 2000);
    while (ids.size() < number) ids.push_back(id(random));
    motions.resize(number);
  }
};

double nanoseconds(const Stopwatch& watch, std::size_t number) {
  return 1e9 * watch.seconds() / static_cast<double>(number);
}

}  // namespace

json measure_changes(const Setup& setup) {
  const std::vector<Linear_motion_2> motions = setup.motions();
  Kinetic_delaunay_triangulation_2<> kinetic(motions);
  kinetic.advance_to(present);
  const auto places = positions(motions, present);
  Static_triangulation fixed(places.begin(), places.end());
  std::mt19937_64 random(setup.options.seed);
  return median_round([&]() -> json {
    const Changes changes(setup, random);
    json result;
    {
      const Stopwatch watch;
      for (const Point_id id : changes.ids) {
        const Linear_motion_2& m = kinetic.motion(id);
        const Vector_2 back = {-m.velocity.x, -m.velocity.y};
        kinetic.set_motion(id, with_velocity_at(m, back, present));
      }
      result["turn_ns"] = nanoseconds(watch, changes.ids.size());
    }
    // Changes of all velocities at once, and of a tenth, beside a new static triangulation.
    const auto turn_every = [&](std::size_t period) {
      std::vector<Point_id> ids;
      std::vector<Linear_motion_2> turned;
      for (std::size_t i = 0; i < motions.size(); i += period) {
        ids.push_back(static_cast<Point_id>(i));
        const Vector_2& velocity = changes.motions[i % changes.motions.size()].velocity;
        turned.push_back(with_velocity_at(kinetic.motion(ids.back()), velocity, present));
      }
      const Stopwatch watch;
      kinetic.set_motions(ids, turned);
      kinetic.next_event_time();  // computes certificates that set_motions has deferred
      return watch.seconds();
    };
    const double all = turn_every(1);
    const double tenth = turn_every(10);
    const Stopwatch watch_static;
    const Static_triangulation anew(places.begin(), places.end());
    const double rebuilt = watch_static.seconds();
    result["turn_all_ns"] = 1e9 * all / static_cast<double>(motions.size());
    result["turn_all_over_rebuild"] = ratio(all, rebuilt);
    result["turn_tenth_over_rebuild"] = ratio(tenth, rebuilt);
    std::vector<Point_id> inserted;
    {
      const Stopwatch watch;
      for (const Linear_motion_2& m : changes.motions) inserted.push_back(kinetic.insert(m));
      result["insert_ns"] = nanoseconds(watch, inserted.size());
    }
    {
      const Stopwatch watch;
      for (const Point_id id : inserted) kinetic.erase(id);
      result["erase_ns"] = nanoseconds(watch, inserted.size());
    }
    const auto new_places = positions(changes.motions, present);
    std::vector<Static_triangulation::Vertex_handle> vertices;
    {
      const Stopwatch watch;
      for (const auto& place : new_places) vertices.push_back(fixed.insert(place));
      result["static_insert_ns"] = nanoseconds(watch, vertices.size());
    }
    {
      const Stopwatch watch;
      for (const auto v : vertices) fixed.remove(v);
      result["static_remove_ns"] = nanoseconds(watch, vertices.size());
    }
    result["insert_over_static"] = ratio(result["insert_ns"], result["static_insert_ns"]);
    result["erase_over_static"] = ratio(result["erase_ns"], result["static_remove_ns"]);
    return result;
  });
}

}  // namespace kinetri::bench
