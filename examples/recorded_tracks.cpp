// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lesson 4, recorded tracks: three people and a dog in a park, each observed now and then. Who came
// near whom, and when?
#include <kinetri/io/tracks_file.h>
#include <kinetri/observers/closest_approaches.h>
#include <kinetri/simulation/tracks.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

using Time = kinetri::Algebraic_number;
using Paths = std::vector<std::vector<kinetri::Observation_2>>;

// The observations of each track, without line numbers and names.
static Paths paths_of(const kinetri::Tracks_file& file) {
  Paths paths;
  for (const kinetri::Track& track : file.tracks) {
    auto& path = paths.emplace_back();
    for (const auto& seen : track.observations) path.push_back({seen.time, seen.place});
  }
  return paths;
}

// Prints who appears, turns and leaves.
struct Log : kinetri::Event_observer {
  explicit Log(const std::vector<std::string>& point_names) : names(point_names) {}

  void after_event(const kinetri::Event& event) override {
    using Kind = kinetri::Event_kind;
    if (event.kind != Kind::insert && event.kind != Kind::trajectory && event.kind != Kind::erase) {
      return;
    }
    std::cout << "t = " << event.time.to_double() << ": " << name(event.kind) << ' '
              << names[*event.point_a] << '\n';
  }

  const std::vector<std::string>& names;  // by point id
};

int main(int argc, char** argv) try {
  const char* const file_name = argc > 1 ? argv[1] : "tracks.csv";
  const auto file = kinetri::read_tracks_file(file_name, kinetri::Tracks_format::rows);
  const Paths paths = paths_of(file);

  // After a gap of more than 10 seconds between two observations a track continues as a new point.
  const auto stays = kinetri::stays_of(paths, {.from = 0, .longest_gap = 10});
  std::vector<std::string> names;
  for (const kinetri::Stay& stay : stays) names.push_back(file.tracks[stay.track].id);

  Log log(names);  // outlives the park
  const std::unique_ptr<kinetri::Simulation_2<>> park = kinetri::simulate_tracks(paths, stays, 0);
  park->add_observer(log);
  kinetri::Closest_approaches approaches(*park, 4);  // keeps the 4 closest
  park->advance_to(40);

  std::cout << "closest approaches:\n";
  for (const kinetri::Approach& approach : approaches.approaches()) {
    std::cout << "  " << names[approach.points[0]] << " and " << names[approach.points[1]]
              << " at t = " << approach.time.to_double() << ", distance " << approach.distance
              << '\n';
  }
} catch (const kinetri::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
