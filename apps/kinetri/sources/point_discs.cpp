// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/point_discs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "cli/arguments.h"
#include "kinetri/algebra/number_types.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/simulation/simulation_options.h"
#include "sources/run_source.h"

namespace kinetri::app {
namespace {

class Disc_reader {
 public:
  Disc_reader(const Points_file& points, const Points_settings& settings)
      : points_(points), settings_(settings) {}

  Point_discs read() {
    discs_.growths = numbers("growth", points_.growths, settings_.growth);
    const bool is_growing = !discs_.growths.empty();
    discs_.growths.resize(points_.number_of_points());
    discs_.radii = numbers("radius", points_.radii, settings_.radius);
    // Growing discs may start with radius 0.
    if (discs_.radii.empty() && !is_growing) expect_radii();
    discs_.radii.resize(points_.number_of_points());
    for (std::size_t i = 0; i < discs_.radii.size(); ++i) check(i);
    if (settings_.collisions.response != nullptr) expect_contacts();
    return std::move(discs_);
  }

 private:
  // From the column, or the option for all points; empty if neither is given.
  std::vector<double> numbers(std::string_view name, const std::vector<double>& column,
                              const std::optional<double>& option) const {
    if (!option) return column;
    if (!column.empty()) {
      throw Usage_error(joined("--", name, ": ", input_name(settings_.points), " has a column ",
                               name, "; expected one of the two"));
    }
    return std::vector<double>(points_.number_of_points(), *option);
  }

  void expect_radii() const {
    if (points_.number_of_points() == 0) return;
    const std::string_view option = settings_.collisions.response != nullptr ? "--collisions"
                                    : settings_.rim_touches                  ? "--rim"
                                                                             : "--regular";
    throw Usage_error(joined(option, ": discs have a radius; expected a column radius in ",
                             input_name(settings_.points), ", or --radius R"));
  }

  // Whether no response ends the growth of a disc.
  bool is_growth_kept() const {
    const std::string_view response = settings_.collisions.name;
    return response != "stop" && response != "remove";
  }

  Rational radius_at(std::size_t i, double time) const {
    return to_rational(discs_.radii[i]) + to_rational(discs_.growths[i]) * to_rational(time);
  }

  void check(std::size_t i) const {
    const double from = settings_.from;
    const bool is_end_known = settings_.until && is_growth_kept();
    const double until = settings_.until.value_or(from);
    if (radius_at(i, from) < 0) {
      fail(i, joined("the radius is negative at t = ", from,
                     ", the start; expected at least 0: a greater radius, or another growth or "
                     "start"));
    }
    if (is_end_known && radius_at(i, until) < 0) {
      fail(i, joined("the radius shrinks to 0 at t = ", -discs_.radii[i] / discs_.growths[i],
                     ", before the end at t = ", until,
                     "; expected at least 0: a greater radius or growth, or an earlier end"));
    }
    if (!settings_.rim_touches) return;
    expect_fitting(i, from);
    if (is_end_known) expect_fitting(i, until);
  }

  void expect_fitting(std::size_t i, double time) const {
    const Rational diameter = 2 * radius_at(i, time);
    const auto& [xmin, ymin, xmax, ymax] = *settings_.box;
    if (to_rational(xmax) - to_rational(xmin) > diameter &&
        to_rational(ymax) - to_rational(ymin) > diameter) {
      return;
    }
    fail(i, joined("a disc of the radius ", discs_.radii[i] + discs_.growths[i] * time,
                   ", which it has at t = ", time,
                   ", does not fit the box; expected a box wider and higher than its diameter"));
  }

  void expect_contacts() const {
    const auto is_nothing = [](double number) { return number == 0; };
    if (discs_.radii.empty() || !std::ranges::all_of(discs_.radii, is_nothing) ||
        !std::ranges::all_of(discs_.growths, is_nothing)) {
      return;
    }
    fail(0, detail::zero_radius_message);
  }

  [[noreturn]] void fail(std::size_t i, const std::string& problem) const {
    throw Input_error(input_name(settings_.points), points_.lines[i], problem);
  }

  const Points_file& points_;
  const Points_settings& settings_;
  Point_discs discs_;
};

}  // namespace

bool Point_discs::are_equal() const {
  const auto is_first = [&](double radius) { return radius == radii.front(); };
  return std::ranges::all_of(radii, is_first) &&
         std::ranges::all_of(growths, [](double growth) { return growth == 0; });
}

Point_discs point_discs(const Points_file& points, const Points_settings& settings) {
  return Disc_reader(points, settings).read();
}

std::vector<double> point_masses(const Points_file& points, const Point_discs& discs,
                                 const Points_settings& settings) {
  if (settings.collisions.name != "elastic") return {};
  if (!settings.has_area_masses) return points.masses;
  std::vector<double> result;
  for (std::size_t i = 0; i < discs.radii.size(); ++i) {
    const double radius = discs.radii[i] + discs.growths[i] * settings.from;
    result.push_back(radius * radius);
    if (result.back() > 0 && std::isfinite(result.back())) continue;
    throw Input_error(input_name(settings.points), points.lines[i],
                      joined("the radius at the start is ", radius,
                             ", and its square is not a mass; expected a radius whose square is "
                             "greater than 0 and a binary64 number, or --mass column"));
  }
  return result;
}

}  // namespace kinetri::app
