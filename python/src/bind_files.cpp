// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of points and tracks, scenarios and packings, as columns.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/shared_paths.h"
#include "kinetri/io/points_file.h"
#include "kinetri/io/tracks_file.h"
#include "kinetri/simulation/packing.h"
#include "kinetri/simulation/scenarios.h"
#include "kinetri/simulation/tracks.h"
#include "numpy_arrays.h"
#include "parameter_names.h"

namespace kinetri::python {
namespace {

// A column of vectors, one for each motion.
template <class Motion>
py::array_t<double> column(const std::vector<Motion>& motions, Vector_2 Motion::*member) {
  std::vector<Vector_2> result;
  result.reserve(motions.size());
  for (const Motion& motion : motions) result.push_back(motion.*member);
  return array_of<double>(std::move(result), 2);
}

// The keys are the parameters of the package's classes.
py::dict points_file(const std::string& path) {
  const Points_file file = without_gil([&] { return read_points_file(path); });
  py::dict result;
  file.with_motions([&]<class Motion>(const std::vector<Motion>& motions) {
    result["positions"] = column(motions, &Motion::position);
    result["velocities"] = column(motions, &Motion::velocity);
  });
  if (file.is_polynomial) {
    result["acceleration"] = column(file.polynomial_motions, &Polynomial_motion_2::acceleration);
    result["jerk"] = column(file.polynomial_motions, &Polynomial_motion_2::jerk);
  }
  if (!file.radii.empty()) result["radius"] = array_of<double>(file.radii);
  if (!file.growths.empty()) result["growth"] = array_of<double>(file.growths);
  if (!file.masses.empty()) result["mass"] = array_of<double>(file.masses);
  if (!file.labels.empty()) result["label"] = file.labels;
  return result;
}

Tracks_format format_of(const std::string& text) {
  std::string names;
  for (const auto& [format, name, description] : tracks_formats()) {
    if (name == text) return format;
    names += (names.empty() ? "'" : ", '") + std::string(name) + "'";
  }
  throw Precondition_error("the format is '" + text + "'; expected one of " + names);
}

Tracks_projection projection_of(const std::string& text) {
  if (text == "refused") return Tracks_projection::refused;
  if (text == "none") return Tracks_projection::none;
  if (text == "local") return Tracks_projection::local;
  if (text == "utm") return Tracks_projection::utm;
  throw Precondition_error("projection is '" + text + "'; expected one of 'none', 'local', 'utm'");
}

Tracks_duplicates duplicates_of(const std::string& text) {
  if (text == "automatic") return Tracks_duplicates::automatic;
  if (text == "refuse") return Tracks_duplicates::refuse;
  if (text == "first") return Tracks_duplicates::first;
  if (text == "last") return Tracks_duplicates::last;
  if (text == "mean") return Tracks_duplicates::mean;
  throw Precondition_error("duplicates is '" + text +
                           "'; expected one of 'first', 'last', 'mean', 'refuse'");
}

Tracks_unwrap unwrap_of(const std::string& text) {
  if (text == "refused") return Tracks_unwrap::refused;
  if (text == "nearest") return Tracks_unwrap::nearest;
  throw Precondition_error("unwrap is '" + text + "'; expected 'nearest'");
}

Track_columns columns_of(const std::map<std::string, std::string>& names) {
  Track_columns result;
  for (const auto& [column, name] : names) {
    std::string* const taken = column == "t"        ? &result.t
                               : column == "id"     ? &result.id
                               : column == "x"      ? &result.x
                               : column == "y"      ? &result.y
                               : column == "radius" ? &result.radius
                                                    : nullptr;
    if (taken == nullptr) {
      throw Precondition_error("columns has '" + column +
                               "'; expected 't', 'id', 'x', 'y' and 'radius' alone");
    }
    *taken = name;
  }
  return result;
}

// One row for each observation, by track; the ids are those of the tracks.
py::dict columns_of_tracks(const Tracks_file& file, Tracks_duplicates duplicates) {
  std::vector<double> times;
  std::vector<Vector_2> places;
  std::vector<std::uint64_t> offsets = {0};
  py::list ids;
  std::vector<double> radii;
  for (const Track& track : file.tracks) {
    for (const Track_observation& observation : track.observations) {
      times.push_back(observation.time);
      places.push_back(observation.place);
    }
    offsets.push_back(times.size());
    ids.append(text_of(track.id));
    radii.push_back(track.radius);
  }
  py::dict result;
  result["times"] = array_of<double>(std::move(times));
  result["places"] = array_of<double>(std::move(places), 2);
  result["offsets"] = array_of<std::uint64_t>(std::move(offsets));
  result["ids"] = ids;
  result["radii"] = file.has_radii ? py::object(array_of<double>(std::move(radii))) : py::none();
  result["frame_rate"] = file.frame_rate;
  result["origin"] = file.origin;
  result["walkable_area"] = file.walkable_area;
  std::vector<std::string> remarks = file.remarks;
  const std::vector<std::string> on_rows = remarks_on_rows(file, duplicates);
  remarks.insert(remarks.end(), on_rows.begin(), on_rows.end());
  py::list texts;
  for (const std::string& remark : remarks) texts.append(text_of(with_parameters(remark)));
  result["remarks"] = texts;
  return result;
}

// Reads the file `path`, or `text`, if given, with `path` as its name.
py::dict tracks_file(const std::string& path, const std::optional<std::string>& text,
                     const std::string& format, std::optional<double> fps,
                     const std::map<std::string, std::string>& columns,
                     const std::string& projection, const std::string& date_format,
                     const std::string& duplicates, const std::string& unwrap) {
  Tracks_file_options options;
  options.format = format_of(format);
  options.fps = fps;
  options.columns = columns_of(columns);
  options.projection = projection_of(projection);
  options.date_format = date_format;
  if (const std::string problem = problem_of_date_format(date_format);
      !date_format.empty() && !problem.empty()) {
    throw Precondition_error("date_format is '" + date_format + "', which " + problem);
  }
  options.duplicates = duplicates_of(duplicates);
  options.unwrap = unwrap_of(unwrap);
  return columns_of_tracks(without_gil([&] {
                             if (!text) return read_tracks_file(path, options);
                             std::istringstream in(*text);
                             return read_tracks(in, path, options);
                           }),
                           options.duplicates);
}

// Things that share a path: for at most ten pairs, their stays and the time from which they share
// it; and whether these are all pairs.
py::tuple shared_paths_of(const Array<double>& times, const Array<double>& places,
                          const Array<std::uint64_t>& offsets,
                          const std::optional<Array<double>>& radii, double from, double until,
                          double longest_gap) {
  std::vector<std::vector<Observation_2>> tracks;
  for (py::ssize_t i = 0; i + 1 < offsets.size(); ++i) {
    std::vector<Observation_2>& track = tracks.emplace_back();
    for (std::uint64_t j = offsets.data()[i]; j < offsets.data()[i + 1]; ++j) {
      track.push_back({times.data()[j], {places.data()[2 * j], places.data()[2 * j + 1]}});
    }
  }
  std::vector<double> of_tracks;
  if (radii) of_tracks.assign(radii->data(), radii->data() + radii->size());
  const Shared_paths paths = without_gil([&] {
    const std::vector<Stay> stays =
        stays_of(tracks, {.from = from, .until = until, .longest_gap = longest_gap});
    return shared_paths(tracks, stays, of_tracks, from, until);
  });
  py::list pairs;
  for (const auto& [stays, time] : paths.first)
    pairs.append(py::make_tuple(stays[0], stays[1], time));
  return py::make_tuple(pairs, paths.are_all);
}

// The observations of each thing, from offsets[i] on; `rows` are the numbers that name them in
// messages, from 1 on. The ids of the result are the numbers of the things, as texts.
py::dict projected_tracks(const Array<double>& times, const Array<double>& places,
                          const Array<std::uint64_t>& offsets, const Array<std::uint64_t>& rows,
                          const std::string& origin, const std::string& name,
                          const std::string& name_of_x, const std::string& name_of_y,
                          const std::string& projection, const std::string& duplicates,
                          std::size_t rows_at_another_place) {
  Tracks_file file;
  file.format = Tracks_format::table;
  file.place_name = "observation";
  file.origin = origin;
  file.observations = static_cast<std::size_t>(times.size());
  file.rows_at_another_place = rows_at_another_place;
  const auto time = times.unchecked<1>();
  const auto place = places.unchecked<2>();
  const auto offset = offsets.unchecked<1>();
  const auto row = rows.unchecked<1>();
  for (py::ssize_t i = 0; i + 1 < offset.shape(0); ++i) {
    Track& track = file.tracks.emplace_back();
    track.id = std::to_string(i);
    for (auto k = static_cast<py::ssize_t>(offset(i)); k < static_cast<py::ssize_t>(offset(i + 1));
         ++k) {
      track.observations.push_back({time(k), {place(k, 0), place(k, 1)}, row(k)});
    }
  }
  const Tracks_projection chosen = projection_of(projection);
  return columns_of_tracks(without_gil([&] {
                             return project_tracks(std::move(file), name,
                                                   {.x = name_of_x, .y = name_of_y}, chosen);
                           }),
                           duplicates_of(duplicates));
}

template <class Enumerator, std::size_t n>
Enumerator named(const std::array<Enumerator, n>& all, const std::string& text, const char* what) {
  std::string names;
  for (const Enumerator enumerator : all) {
    if (name(enumerator) == text) return enumerator;
    names += (names.empty() ? "'" : ", '") + std::string(name(enumerator)) + "'";
  }
  throw Precondition_error(std::string(what) + " is '" + text + "'; expected one of " + names);
}

py::tuple scenario(const std::string& kind, std::size_t points, std::uint64_t seed,
                   std::optional<double> side, double speed, double spacing, double jitter,
                   const std::string& movers) {
  Scenario_options options;
  options.points = points;
  options.seed = seed;
  options.side = side;
  options.speed = speed;
  options.spacing = spacing;
  options.jitter = jitter;
  options.movers = named(all_lattice_movers, movers, "movers");
  const auto motions = make_scenario(named(all_scenarios, kind, "the scenario"), options);
  return py::make_tuple(column(motions, &Linear_motion_2::position),
                        column(motions, &Linear_motion_2::velocity));
}

py::dict packing(std::size_t points, double share, double sizes, std::uint64_t seed,
                 std::optional<double> side, double speed, bool is_periodic) {
  Packing_options options;
  options.points = points;
  options.share = share;
  options.size_ratio = sizes;
  options.seed = seed;
  options.side = side;
  options.speed = speed;
  options.is_periodic = is_periodic;
  const Packing made = without_gil([&] { return make_packing(options); });
  std::vector<Linear_motion_2> centers;
  std::vector<double> radii;
  for (const Disc_motion_2& disc : made.discs) {
    centers.push_back(disc);
    radii.push_back(disc.radius);
  }
  py::dict result;
  result["positions"] = column(centers, &Linear_motion_2::position);
  result["velocities"] = column(centers, &Linear_motion_2::velocity);
  result["radius"] = array_of<double>(std::move(radii));
  result["box"] = py::make_tuple(made.box.xmin, made.box.ymin, made.box.xmax, made.box.ymax);
  return result;
}

}  // namespace

void bind_files(py::module_& module) {
  module.def("read_points", points_file);
  module.def("read_tracks", tracks_file);
  module.def("project_tracks", projected_tracks);
  module.def("shared_paths", shared_paths_of);
  module.def("scenario", scenario);
  module.def("packing", packing);
}

}  // namespace kinetri::python
