// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/points_source.h"

#include <string_view>
#include <utility>

#include "cli/arguments.h"
#include "cli/text.h"
#include "io/text.h"
#include "kinetri/io/points_file.h"
#include "sources/any_simulation.h"

namespace kinetri::app {
namespace {

class Points_source final : public Run_source {
 public:
  explicit Points_source(Points_settings settings) : settings_(std::move(settings)) {}

  std::string path() const override { return settings_.points; }
  void read() override;
  std::size_t number_of_points() const override { return points_.number_of_points(); }
  double from() const override { return settings_.from; }
  double until() const override { return settings_.until; }
  std::string response() const override { return std::string(settings_.collisions.name); }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  std::size_t line_of(Point_id id) const override { return points_.lines[id]; }
  std::vector<std::string> remarks() const override;

 private:
  Simulation_options options() const;
  double radius() const;

  Points_settings settings_;
  Points_file points_;
};

void Points_source::read() {
  points_ = read_points_file(settings_.points);
}

std::vector<std::string> Points_source::remarks() const {
  if (points_.ignored_columns.empty()) return {};
  return {joined("columns that are ignored: ", separated(points_.ignored_columns, ", "))};
}

Any_simulation Points_source::make_simulation(Arithmetic arithmetic) const {
  const Simulation_options simulation_options = options();
  try {
    if (points_.is_polynomial) {
      return std::make_unique<Simulation_2<Polynomial_kinetic_traits_2>>(
          points_.polynomial_motions, simulation_options, settings_.from,
          Polynomial_kinetic_traits_2(arithmetic));
    }
    return std::make_unique<Simulation_2<>>(points_.motions, simulation_options, settings_.from,
                                            Linear_kinetic_traits_2(arithmetic));
  } catch (const Outside_box_error& error) {
    throw Input_error(input_name(path()), points_.lines[error.point()], error.what());
  }
}

Simulation_options Points_source::options() const {
  Simulation_options result;
  result.box = settings_.box;
  result.rim_touches = settings_.rim_touches;
  result.response = settings_.collisions.response;
  if (!result.response && !result.rim_touches) return result;
  result.radius = radius();
  if (!result.rim_touches) return result;
  const Rational diameter = 2 * to_rational(result.radius);
  const auto& [xmin, ymin, xmax, ymax] = *settings_.box;
  if (to_rational(xmax) - to_rational(xmin) <= diameter ||
      to_rational(ymax) - to_rational(ymin) <= diameter) {
    throw Usage_error(joined("--rim: a disc of radius ", result.radius,
                             " does not fit the box; expected a box wider and higher than its "
                             "diameter"));
  }
  return result;
}

// That of all discs. Precondition: one is needed.
double Points_source::radius() const {
  const std::string_view option =
      settings_.collisions.response != nullptr ? "--collisions" : "--rim";
  if (settings_.radius) {
    if (points_.radii.empty()) return *settings_.radius;
    throw Usage_error(
        joined("--radius: ", input_name(path()), " has a column radius; expected one of the two"));
  }
  if (points_.radii.empty()) {
    if (points_.lines.empty()) return 1;  // of no disc
    throw Usage_error(joined(option, ": discs have a radius; expected a column radius in ",
                             input_name(path()), ", or --radius R"));
  }
  for (std::size_t i = 0; i < points_.radii.size(); ++i) {
    if (points_.radii[i] == 0) {
      throw Input_error(input_name(path()), points_.lines[i],
                        "the radius is 0, and discs without one never touch; expected a radius "
                        "greater than 0");
    }
    if (points_.radii[i] > greatest_radius) {
      throw Input_error(input_name(path()), points_.lines[i],
                        joined("the radius is ", points_.radii[i], "; expected at most ",
                               greatest_radius, ", so that the diameter is a binary64 number"));
    }
    if (points_.radii[i] == points_.radii[0]) continue;
    throw Input_error(
        input_name(path()), points_.lines[i],
        joined("the radius is ", points_.radii[i], ", but ", points_.radii[0], " in line ",
               points_.lines[0],
               "; expected equal radii, since unequal discs can touch without being neighbors in "
               "the Delaunay triangulation, and weighted ones are not supported yet"));
  }
  return points_.radii.empty() ? 1 : points_.radii[0];
}

}  // namespace

std::unique_ptr<Run_source> points_source(const Points_settings& settings) {
  return std::make_unique<Points_source>(settings);
}

}  // namespace kinetri::app
