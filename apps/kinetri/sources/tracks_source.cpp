// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/tracks_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

#include "cli/arguments.h"

namespace kinetri::app {

void Tracks_source::read() {
  file_ = read_tracks_file(settings_.tracks, settings_.format, settings_.fps);
  double first = std::numeric_limits<double>::infinity();
  double last = -first;
  for (const Track& track : file_.tracks) {
    observations_.emplace_back();
    for (const Track_observation& seen : track.observations) {
      observations_.back().push_back({seen.time, seen.place});
      const auto& [x, y] = seen.place;
      const Box_2 so_far = extent_.value_or(Box_2{x, y, x, y});
      extent_ = {std::min(so_far.xmin, x), std::min(so_far.ymin, y), std::max(so_far.xmax, x),
                 std::max(so_far.ymax, y)};
    }
    first = std::min(first, track.observations.front().time);
    last = std::max(last, track.observations.back().time);
  }
  from_ = settings_.from.value_or(file_.tracks.empty() ? 0 : first);
  until_ = settings_.until.value_or(file_.tracks.empty() ? from_ : std::max(last, from_));
  if (until_ < from_) {
    throw Usage_error(
        fmt::format("--until: {} is before the start; expected at least {}, which is {}", until_,
                    from_, settings_.from ? "--from" : "the first observation"));
  }
  Tracks_options options;
  options.from = from_;
  options.until = until_;
  if (settings_.longest_gap) options.longest_gap = *settings_.longest_gap;
  stays_ = stays_of(observations_, options);
  check_velocities();
}

// Finite numbers may be too far apart for a finite velocity.
void Tracks_source::check_velocities() const {
  for (const Stay& stay : stays_) {
    for (std::size_t i = stay.first; i < stay.last; ++i) {
      if (is_finite(motion_after(observations_[stay.track], i))) continue;
      const Track& track = file_.tracks[stay.track];
      throw Input_error(
          input_name(path()), track.observations[i + 1].line,
          fmt::format("id '{}' goes too far too fast since line {}; expected a velocity that is a "
                      "binary64 number",
                      track.id, track.observations[i].line));
    }
  }
}

Any_simulation Tracks_source::make_simulation(Arithmetic arithmetic) const {
  Simulation_options options;
  if (settings_.radius) {
    options.radius = *settings_.radius;
    options.response = log_contact;
  }
  try {
    return simulate_tracks(observations_, stays_, from_, options,
                           Linear_kinetic_traits_2(arithmetic));
  } catch (const Coincident_trajectories_error& error) {
    throw coincidence(error, from_);
  }
}

Input_error Tracks_source::coincidence(const Coincident_trajectories_error& error,
                                       double time) const {
  const auto line = [&](Point_id id) {
    const auto& seen = file_.tracks[stays_[id].track].observations;
    const auto next = std::ranges::upper_bound(seen, time, {}, &Track_observation::time);
    return (next == seen.begin() ? next : std::prev(next))->line;
  };
  const std::size_t one = line(error.first());
  const std::size_t other = line(error.second());
  return Input_error(
      input_name(path()), std::max(one, other),
      fmt::format("from t = {} on ids '{}' and '{}' go the same way (see line {}); expected things "
                  "that are apart at one of two observations",
                  time, name(error.first()), name(error.second()), std::min(one, other)));
}

void Tracks_source::write_points(std::ostream& out) const {
  out << "point,id,first,last\n";
  for (std::size_t point = 0; point < stays_.size(); ++point) {
    const auto& [track, first, last] = stays_[point];
    out << fmt::format("{},{},{},{}\n", point, file_.tracks[track].id,
                       observations_[track][first].time, observations_[track][last].time);
  }
}

std::vector<std::string> Tracks_source::names() const {
  std::vector<std::string> result;
  for (const Stay& stay : stays_) result.push_back(file_.tracks[stay.track].id);
  return result;
}

std::vector<std::string> Tracks_source::remarks() const {
  std::vector<std::string> result;
  result.push_back(fmt::format("{} observations of {} ids, {} stays", file_.observations,
                               file_.tracks.size(), stays_.size()));
  if (file_.doubled_rows > 0) {
    result.push_back(fmt::format("{} rows that repeat another are left out", file_.doubled_rows));
  }
  if (file_.rows_out_of_order > 0) {
    result.push_back(fmt::format("{} rows were not in the order of time", file_.rows_out_of_order));
  }
  const auto singles = std::ranges::count_if(
      file_.tracks, [](const Track& track) { return track.observations.size() == 1; });
  if (singles > 0) {
    result.push_back(
        fmt::format("{} ids with one observation have no path and are left out", singles));
  }
  return result;
}

}  // namespace kinetri::app
