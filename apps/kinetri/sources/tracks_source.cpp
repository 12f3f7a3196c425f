// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/tracks_source.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <span>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/text.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/shared_paths.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/viewer_page.h"
#include "kinetri/simulation/simulation_options.h"
#include "kinetri/simulation/tracks.h"
#include "sources/any_simulation.h"

namespace kinetri::app {
namespace {

class Tracks_source final : public Run_source {
 public:
  explicit Tracks_source(Tracks_settings settings) : settings_(std::move(settings)) {}

  std::string path() const override { return settings_.tracks; }
  void read() override;
  std::size_t number_of_points() const override { return stays_.size(); }
  double from() const override { return from_; }
  std::optional<double> until() const override { return until_; }
  std::optional<Frame_rate> frame_rate() const override {
    if (!file_.frame_rate) return std::nullopt;
    return Frame_rate{*file_.frame_rate, "--fps"};
  }
  /// The bounding box of all observations.
  std::optional<Box_2> extent() const override { return extent_; }
  std::string response() const override { return settings_.logs_contacts ? "log" : "none"; }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  Input_error coincidence(const Coincident_trajectories_error& coincident,
                          double time) const override;
  std::string name(Point_id id) const override { return file_.tracks[stays_[id].track].id; }
  std::vector<std::string> labels() const override;
  std::vector<Point_id> points_named(const std::string& name) const override;
  std::string expected_name() const override {
    return "an id with two observations, within --max-gap, --from and --until";
  }
  bool are_there_together(Point_id a, Point_id b) const override;
  std::string walkable_area() const override { return file_.walkable_area; }
  std::vector<std::string> remarks() const override;
  void write_points(std::ostream& out) const override;

 private:
  Input_error error(std::size_t line, const std::string& message) const {
    return tracks_error(input_name(path()), file_.place_name, line, message);
  }
  void check_frame_rate() const;
  void check_velocities() const;
  void check_radii() const;
  bool is_periodic() const { return settings_.reading.unwrap == Tracks_unwrap::periodic; }
  Periodic_box_2 periodic_box() const;
  std::vector<double> disc_radii() const;

  Tracks_settings settings_;
  Tracks_file file_;
  std::vector<std::vector<Observation_2>> observations_;  // by track
  std::vector<Stay> stays_;                               // by point id
  double from_ = 0;
  double until_ = 0;
  std::optional<Box_2> extent_;
};

void Tracks_source::read() {
  file_ = read_tracks_file(settings_.tracks, settings_.reading);
  check_frame_rate();
  check_radii();
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
    throw Usage_error(joined("--until: ", until_, " is before the start; expected at least ", from_,
                             ", which is ", settings_.from ? "--from" : "the first observation"));
  }
  Tracks_options options;
  options.from = from_;
  options.until = until_;
  if (settings_.longest_gap) options.longest_gap = *settings_.longest_gap;
  stays_ = stays_of(observations_, options);
  check_velocities();
}

// Throws if --fps is given and the file has no frames.
void Tracks_source::check_frame_rate() const {
  if (!settings_.reading.fps || file_.frame_rate) return;
  throw Usage_error(joined("--fps: ", input_name(path()),
                           " has times, not frames; expected no --fps (--frames-per-time is the "
                           "rate of --frames and --vtu)"));
}

// Differences of finite numbers may be too large for a finite velocity.
void Tracks_source::check_velocities() const {
  for (const Stay& stay : stays_) {
    for (std::size_t i = stay.first; i < stay.last; ++i) {
      if (is_finite(motion_after(observations_[stay.track], i))) continue;
      const Track& track = file_.tracks[stay.track];
      throw error(track.observations[i + 1].line,
                  joined("id ", kinetri::in_quotes(track.id), " moves too fast since ",
                         file_.place_name, ' ', track.observations[i].line,
                         "; expected a velocity that is a binary64 number"));
    }
  }
}

Any_simulation Tracks_source::make_simulation(Arithmetic arithmetic) const {
  Simulation_options options;
  options.coincident = settings_.coincident;
  std::vector<double> radii;
  if (settings_.logs_contacts && !stays_.empty()) {
    options.response = log_contact;
    radii = disc_radii();
    const bool are_equal = std::ranges::all_of(radii, [&](double r) { return r == radii.front(); });
    if (are_equal) options.radius = radii.front();
    if (are_equal) radii.clear();
  }
  const auto simulate = [&](const auto& traits, const auto& traits_of_discs) -> Any_simulation {
    if (radii.empty()) return simulate_tracks(observations_, stays_, from_, options, traits);
    return simulate_tracks(observations_, radii, stays_, from_, options, traits_of_discs);
  };
  try {
    if (is_periodic()) {
      return simulate(Periodic_kinetic_traits_2(periodic_box(), arithmetic),
                      Periodic_disc_kinetic_traits_2(periodic_box(), arithmetic));
    }
    return simulate(Linear_kinetic_traits_2(arithmetic), Disc_kinetic_traits_2(arithmetic));
  } catch (const Coincident_trajectories_error& coincident) {
    throw coincidence(coincident, from_);
  } catch (const Periodic_box_error& too_far) {
    throw Input_error(input_name(path()), 0, too_far.what());
  }
}

// That of the file, which has none if there are no observations.
Periodic_box_2 Tracks_source::periodic_box() const {
  const auto [first, second] =
      file_.periodic_box.value_or(std::array{Vector_2{1, 0}, Vector_2{0, 1}});
  return {{first, {}, 0}, {second, {}, 0}};
}

// By track.
std::vector<double> Tracks_source::disc_radii() const {
  std::vector<double> result;
  for (const Track& track : file_.tracks) {
    result.push_back(settings_.radius.value_or(track.radius));
  }
  return result;
}

// Throws if contacts are logged and radii are missing, 0 or too large.
void Tracks_source::check_radii() const {
  if (!settings_.logs_contacts) return;
  if (settings_.radius.has_value() == file_.has_radii) {
    throw Usage_error(
        file_.has_radii ? joined("--radius: ", input_name(path()),
                                 " has a column radius; expected one of the two")
                        : joined("--collisions: discs have a radius; expected a column radius in ",
                                 input_name(path()), ", or --radius R"));
  }
  for (const Track& track : file_.tracks) {
    if (track.radius <= greatest_radius) continue;
    throw error(track.observations.front().line,
                joined("the radius is ", track.radius, "; expected at most ", greatest_radius,
                       ", so that the diameter is a binary64 number"));
  }
  const auto has_none = [](const Track& track) { return track.radius == 0; };
  if (!file_.has_radii || file_.tracks.empty() || !std::ranges::all_of(file_.tracks, has_none)) {
    return;
  }
  throw error(file_.tracks.front().observations.front().line, detail::zero_radius_message);
}

Input_error Tracks_source::coincidence(const Coincident_trajectories_error& coincident,
                                       double time) const {
  const auto line = [&](Point_id id) {
    const auto& seen = file_.tracks[stays_[id].track].observations;
    const auto next = std::ranges::upper_bound(seen, time, {}, &Track_observation::time);
    return (next == seen.begin() ? next : std::prev(next))->line;
  };
  const std::size_t one = line(coincident.first());
  const std::size_t other = line(coincident.second());
  const auto pair_of = [&](Point_id a, Point_id b) {
    return joined(kinetri::in_quotes(name(a)), " and ", kinetri::in_quotes(name(b)));
  };
  const auto [first, second] = std::minmax({coincident.first(), coincident.second()});
  const std::vector<double> radii = settings_.logs_contacts ? disc_radii() : std::vector<double>();
  const Shared_paths paths = shared_paths(observations_, stays_, radii, from_, until_);
  std::string others;
  for (const auto& [stays, since] : paths.first) {
    if (stays == std::array<std::size_t, 2>{first, second}) continue;
    append(others, others.empty() ? ", and so do " : ", ",
           pair_of(static_cast<Point_id>(stays[0]), static_cast<Point_id>(stays[1])),
           " from t = ", since, " on");
  }
  if (!paths.are_all) append(others, ", and more pairs");
  return error(
      std::max(one, other),
      joined("from t = ", time, " on ids ", pair_of(first, second), " go the same way (see ",
             file_.place_name, ' ', std::min(one, other), ")", others,
             "; expected different positions at one of two observations, or ",
             is_periodic() && settings_.logs_contacts ? "no --collisions" : "--coincident hide"));
}

void Tracks_source::write_points(std::ostream& out) const {
  out << "point,id,first,last\n";
  for (std::size_t point = 0; point < stays_.size(); ++point) {
    const auto& [track, first, last] = stays_[point];
    out << joined(point, ",", csv_field(file_.tracks[track].id), ",",
                  observations_[track][first].time, ",", observations_[track][last].time, "\n");
  }
}

std::vector<std::string> Tracks_source::labels() const {
  std::vector<std::string> result;
  for (const Stay& stay : stays_) result.push_back(file_.tracks[stay.track].id);
  return result;
}

std::vector<Point_id> Tracks_source::points_named(const std::string& name) const {
  std::vector<Point_id> result;
  for (std::size_t point = 0; point < stays_.size(); ++point) {
    if (file_.tracks[stays_[point].track].id == name)
      result.push_back(static_cast<Point_id>(point));
  }
  return result;
}

bool Tracks_source::are_there_together(Point_id a, Point_id b) const {
  const auto first = [&](Point_id id) {
    return observations_[stays_[id].track][stays_[id].first].time;
  };
  const auto last = [&](Point_id id) {
    return observations_[stays_[id].track][stays_[id].last].time;
  };
  return first(a) <= last(b) && first(b) <= last(a);
}

std::vector<std::string> Tracks_source::remarks() const {
  std::vector<std::string> result;
  result.push_back(joined(counted(file_.observations, "observation"), " of ",
                          counted(file_.tracks.size(), "id"), ", ",
                          counted(stays_.size(), "stay")));
  const std::span<const Tracks_format_name> formats = tracks_formats();
  if (settings_.reading.format == Tracks_format::automatic && file_.format != Tracks_format::rows) {
    result.push_back(joined("format ", formats[static_cast<std::size_t>(file_.format)].name));
  }
  result.insert(result.end(), file_.remarks.begin(), file_.remarks.end());
  for (std::string& remark : remarks_on_rows(file_, settings_.reading.duplicates)) {
    result.push_back(std::move(remark));
  }
  const auto singles = std::ranges::count_if(
      file_.tracks, [](const Track& track) { return track.observations.size() == 1; });
  if (singles > 0) {
    result.push_back(joined(counted(static_cast<std::uint64_t>(singles), "id"),
                            " left out, having one observation and so no path"));
  }
  return result;
}

}  // namespace

std::unique_ptr<Run_source> tracks_source(const Tracks_settings& settings) {
  return std::make_unique<Tracks_source>(settings);
}

}  // namespace kinetri::app
