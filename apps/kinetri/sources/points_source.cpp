// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/points_source.h"

#include <algorithm>
#include <concepts>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/arguments.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/points_file.h"
#include "sources/any_simulation.h"
#include "sources/point_discs.h"

namespace kinetri::app {
namespace {

class Points_source final : public Run_source {
 public:
  explicit Points_source(Points_settings settings) : settings_(std::move(settings)) {}

  std::string path() const override { return settings_.points; }
  // kinetri-verify does not read UTF-16.
  std::string points_file() const override { return points_.is_utf16 ? "" : settings_.points; }
  void read() override;
  std::size_t number_of_points() const override { return points_.number_of_points(); }
  double from() const override { return settings_.from; }
  std::optional<double> until() const override { return settings_.until; }
  std::string response() const override { return std::string(settings_.collisions.name); }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  std::vector<std::string> labels() const override { return points_.labels; }
  std::size_t line_of(Point_id id) const override { return points_.lines[id]; }
  std::vector<std::string> remarks() const override { return remarks_about(points_); }

 private:
  bool has_discs() const;
  Simulation_options options() const;
  Any_simulation simulation(const Point_discs* discs, const Simulation_options& simulation_options,
                            Arithmetic arithmetic) const;
  Input_error overlap(const Overlapping_discs_error& error) const;
  Input_error coincident(const Coincident_trajectories_error& error) const;
  double equal_radius(const Point_discs& discs) const;
  std::string equal_numbers() const;

  Points_settings settings_;
  Points_file points_;
};

void Points_source::read() {
  if (!settings_.text) {
    points_ = read_points_file(settings_.points);
  } else {
    std::istringstream in(*settings_.text);
    points_ = read_points(in, settings_.points);
  }
  if (!settings_.periodic_box || !points_.is_polynomial) return;
  throw Input_error(input_name(path()), 0,
                    "the points accelerate, but those in a periodic box move on straight lines; "
                    "expected no columns ax, ay, jx and jy, or no --periodic");
}

Any_simulation Points_source::make_simulation(Arithmetic arithmetic) const {
  try {
    if (!has_discs()) return simulation(nullptr, options(), arithmetic);
    const Point_discs discs = point_discs(points_, settings_);
    Simulation_options with_discs = options();
    with_discs.masses = point_masses(points_, discs, settings_);
    if (!discs.are_equal() || settings_.is_regular) {
      // Equal discs may overlap: they have no contact until they approach.
      with_discs.refuses_overlaps =
          !discs.are_equal() && with_discs.response && settings_.collisions.response != log_contact;
      return simulation(&discs, with_discs, arithmetic);
    }
    with_discs.radius = equal_radius(discs);
    // Without discs.
    if (discs.radii.empty()) with_discs.rim_touches = false;
    return simulation(nullptr, with_discs, arithmetic);
  } catch (const Outside_box_error& error) {
    throw Input_error(input_name(path()), points_.lines[error.point()], error.what());
  } catch (const Overlapping_discs_error& error) {
    throw overlap(error);
  } catch (const Coincident_trajectories_error& error) {
    throw coincident(error);
  } catch (const Periodic_box_error& error) {  // a point is too far away
    throw Input_error(input_name(path()), 0, error.what());
  }
}

Input_error Points_source::coincident(const Coincident_trajectories_error& error) const {
  const auto [first, second] = std::minmax({error.first(), error.second()});
  const std::size_t line = points_.lines[first];
  std::string problem;
  if (settings_.periodic_box) {
    problem = joined("the point is an image of the one in line ", line,
                     " at all times; expected points that differ by more than vectors of the "
                     "periodic box",
                     settings_.collisions.response == nullptr ? ", or --coincident hide" : "");
  } else {
    problem = joined("the point has the same ", equal_numbers(), " as the one in line ", line,
                     "; expected points that differ in one of them, or --coincident hide");
  }
  return Input_error(input_name(path()), points_.lines[second], problem);
}

// The numbers that points with one trajectory have in common.
std::string Points_source::equal_numbers() const {
  std::vector<std::string> names = {"place", points_.is_polynomial ? "derivatives" : "velocity"};
  if (has_discs() && !points_.radii.empty()) names.emplace_back("radius");
  if (has_discs() && !points_.growths.empty()) names.emplace_back("growth");
  const std::string last = names.back();
  names.pop_back();
  return joined(separated(names, ", "), " and ", last);
}

// "the disc overlaps the one in line 2 at t = 0, and so do those in lines 4 and 5, ...".
Input_error Points_source::overlap(const Overlapping_discs_error& error) const {
  constexpr std::size_t most_pairs = 3;
  const std::vector<Edge_ids>& pairs = error.pairs();
  const auto line = [&](Point_id id) { return points_.lines[id]; };
  std::string others;
  for (std::size_t i = 1; i < std::min(pairs.size(), most_pairs); ++i) {
    append(others, i == 1 ? ", and so do those in lines " : ", ", line(pairs[i][0]), " and ",
           line(pairs[i][1]));
  }
  if (pairs.size() > most_pairs) append(others, ", and ", pairs.size() - most_pairs, " more pairs");
  const auto& [first, second] = pairs.front();
  return Input_error(
      input_name(path()), line(second),
      joined("the disc overlaps the one in line ", line(first), " at t = ", settings_.from, others,
             "; expected discs that are apart, or touch, for --collisions ",
             settings_.collisions.name,
             ": move them, make them smaller, or take --collisions log"));
}

// Whether the sizes of discs make a difference.
bool Points_source::has_discs() const {
  return settings_.collisions.response != nullptr || settings_.rim_touches || settings_.is_regular;
}

// Without the options that depend on discs.
Simulation_options Points_source::options() const {
  Simulation_options result;
  result.box = settings_.box;
  result.rim_touches = settings_.rim_touches;
  result.response = settings_.collisions.response;
  result.coincident = settings_.coincident;
  return result;
}

// Of points, or of discs with radii of their own if these are given.
Any_simulation Points_source::simulation(const Point_discs* discs,
                                         const Simulation_options& simulation_options,
                                         Arithmetic arithmetic) const {
  const auto make = [&]<class Motion, class Traits>(const std::vector<Motion>& motions,
                                                    const Traits& traits) -> Any_simulation {
    return std::make_unique<Simulation_2<Traits>>(motions, simulation_options, settings_.from,
                                                  traits);
  };
  const auto of = [&]<class Motion>(const std::vector<Motion>& motions) -> Any_simulation {
#ifndef KINETRI_WITHOUT_PERIODIC_BOXES
    if constexpr (std::same_as<Center_motion_of<Motion>, Linear_motion_2>) {
      if (settings_.periodic_box) {
        return make(motions,
                    Basic_periodic_kinetic_traits_2<Motion>(*settings_.periodic_box, arithmetic));
      }
    }
#endif
    return make(motions, Basic_kinetic_traits_2<Motion>(arithmetic));
  };
  return points_.with_motions([&]<class Center>(const std::vector<Center>& centers) {
    if (discs == nullptr) return of(centers);
    std::vector<Basic_disc_motion_2<Center>> motions;
    for (std::size_t i = 0; i < centers.size(); ++i) {
      motions.push_back({centers[i], discs->radii[i], discs->growths[i], 0});
    }
    return of(motions);
  });
}

// The common radius, if contacts can be computed with it.
double Points_source::equal_radius(const Point_discs& discs) const {
  const double radius = discs.radii.empty() ? 1 : discs.radii.front();
  if (radius <= greatest_radius) return radius;
  throw Input_error(input_name(path()), points_.lines.front(),
                    joined("the radius is ", radius, "; expected at most ", greatest_radius,
                           ", so that the diameter is a binary64 number"));
}

}  // namespace

std::vector<std::string> remarks_about(const Points_file& points) {
  std::vector<std::string> result;
  if (points.is_utf16) result.emplace_back("the file is in UTF-16, read as UTF-8");
  if (!points.ignored_columns.empty()) {
    result.push_back(joined("columns that are ignored: ", separated(points.ignored_columns, ", ")));
  }
  if (points.comment_lines > 0) {
    result.push_back(joined(counted(points.comment_lines, "line"), " left out, beginning with #"));
  }
  return result;
}

std::unique_ptr<Run_source> points_source(const Points_settings& settings) {
  return std::make_unique<Points_source>(settings);
}

}  // namespace kinetri::app
