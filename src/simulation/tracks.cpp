// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/simulation/tracks.h"

#include <algorithm>
#include <tuple>

#include "kinetri/impl/base/check.h"

namespace kinetri {

std::vector<Stay> stays_of(std::span<const std::vector<Observation_2>> tracks,
                           const Tracks_options& options) {
  std::vector<Stay> result;
  for (std::size_t t = 0; t < tracks.size(); ++t) {
    const std::vector<Observation_2>& track = tracks[t];
    for (std::size_t first = 0; first < track.size();) {
      std::size_t last = first;
      while (last + 1 < track.size() &&
             track[last + 1].time - track[last].time <= options.longest_gap) {
        ++last;
      }
      if (first < last && track[last].time > options.from && track[first].time < options.until) {
        result.push_back({t, first, last});
      }
      first = last + 1;
    }
  }
  const auto order = [&](const Stay& stay) {
    return std::tuple(std::max(tracks[stay.track][stay.first].time, options.from), stay.track);
  };
  std::ranges::stable_sort(result, {}, order);
  return result;
}

Linear_motion_2 motion_after(const std::vector<Observation_2>& track, std::size_t i) {
  KINETRI_PRECONDITION(
      i + 1 < track.size(),
      "there is no next observation; expected an index less than that of the last one");
  const auto& [time, place] = track[i];
  const auto& [next_time, next_place] = track[i + 1];
  const double elapsed = next_time - time;
  return {place, {(next_place.x - place.x) / elapsed, (next_place.y - place.y) / elapsed}, time};
}

namespace {

// The simulation of the tracks. motion_of(stay, i) is the motion from observation i on.
template <class Traits, class Motion_of>
std::unique_ptr<Simulation_2<Traits>> simulate(std::span<const std::vector<Observation_2>> tracks,
                                               std::span<const Stay> stays, double start,
                                               const Simulation_options& options,
                                               const Traits& traits, const Motion_of& motion_of) {
  // The first stays are those that exist at the start.
  std::vector<typename Traits::Motion> motions;
  for (const Stay& stay : stays) {
    const std::vector<Observation_2>& track = tracks[stay.track];
    if (track[stay.first].time > start) break;
    std::size_t i = stay.first;
    while (track[i + 1].time <= start) ++i;
    motions.push_back(motion_of(stay, i));
  }
  auto simulation = std::make_unique<Simulation_2<Traits>>(motions, options, start, traits);
  for (Point_id id = 0; id < stays.size(); ++id) {
    const Stay& stay = stays[id];
    const std::vector<Observation_2>& track = tracks[stay.track];
    for (std::size_t i = stay.first; i <= stay.last; ++i) {
      const double time = track[i].time;
      if (time <= start) continue;
      if (i == stay.last) {
        simulation->schedule_erase(time, id);
      } else if (i == stay.first) {
        const Point_id given = simulation->schedule_insert(time, motion_of(stay, i));
        KINETRI_ASSERT(given == id, "ids are given in the order of the stays");
      } else {
        simulation->schedule_motion(time, id, motion_of(stay, i));
      }
    }
  }
  return simulation;
}

// The same of points.
template <class Traits>
std::unique_ptr<Simulation_2<Traits>> simulate(std::span<const std::vector<Observation_2>> tracks,
                                               std::span<const Stay> stays, double start,
                                               const Simulation_options& options,
                                               const Traits& traits) {
  return simulate(tracks, stays, start, options, traits, [&](const Stay& stay, std::size_t i) {
    return motion_after(tracks[stay.track], i);
  });
}

// The same of discs.
template <class Traits>
std::unique_ptr<Simulation_2<Traits>> simulate(std::span<const std::vector<Observation_2>> tracks,
                                               std::span<const double> radii,
                                               std::span<const Stay> stays, double start,
                                               const Simulation_options& options,
                                               const Traits& traits) {
  KINETRI_PRECONDITION(radii.size() == tracks.size(),
                       "there are not as many radii as tracks; expected one for each");
  return simulate(tracks, stays, start, options, traits, [&](const Stay& stay, std::size_t i) {
    return Disc_motion_2{motion_after(tracks[stay.track], i), radii[stay.track]};
  });
}

}  // namespace

std::unique_ptr<Simulation_2<>> simulate_tracks(std::span<const std::vector<Observation_2>> tracks,
                                                std::span<const Stay> stays, double start,
                                                const Simulation_options& options,
                                                const Linear_kinetic_traits_2& traits) {
  return simulate(tracks, stays, start, options, traits);
}

std::unique_ptr<Simulation_2<Disc_kinetic_traits_2>> simulate_tracks(
    std::span<const std::vector<Observation_2>> tracks, std::span<const double> radii,
    std::span<const Stay> stays, double start, const Simulation_options& options,
    const Disc_kinetic_traits_2& traits) {
  return simulate(tracks, radii, stays, start, options, traits);
}

#ifndef KINETRI_WITHOUT_PERIODIC_BOXES
std::unique_ptr<Simulation_2<Periodic_kinetic_traits_2>> simulate_tracks(
    std::span<const std::vector<Observation_2>> tracks, std::span<const Stay> stays, double start,
    const Simulation_options& options, const Periodic_kinetic_traits_2& traits) {
  return simulate(tracks, stays, start, options, traits);
}

std::unique_ptr<Simulation_2<Periodic_disc_kinetic_traits_2>> simulate_tracks(
    std::span<const std::vector<Observation_2>> tracks, std::span<const double> radii,
    std::span<const Stay> stays, double start, const Simulation_options& options,
    const Periodic_disc_kinetic_traits_2& traits) {
  return simulate(tracks, radii, stays, start, options, traits);
}
#endif

}  // namespace kinetri
