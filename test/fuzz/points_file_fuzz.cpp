// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader of points files on any bytes: it refuses them with a message that names the place, or
// reads points that are as promised and come back the same from what is written of them.
#include <cmath>
#include <sstream>
#include <vector>

#include "fuzz/fuzz.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/io/points_file.h"

namespace kinetri {
namespace {

using test::require;

bool same_number(double a, double b) {
  return a == b && std::signbit(a) == std::signbit(b);
}

// The C library converts correctly rounded too.
void check_number(const std::string& text) {
  const Parsed_number parsed = parse_number(text);
  if (!parsed.problem.empty()) return;
  require(std::isfinite(parsed.value), "a number that is not finite: " + text);
  char* end = nullptr;
  const double expected = std::strtod(text.c_str(), &end);
  require(end == text.c_str() + text.size(), "not a number for the C library: " + text);
  require(same_number(parsed.value, expected), "another number for the C library: " + text);
}

void check_points(const Points_file& points) {
  const std::size_t number = points.number_of_points();
  require(points.with_motions([](const auto& motions) { return motions.size(); }) == number,
          "a line for each point");
  for (const std::vector<double>& column : {points.radii, points.growths, points.masses}) {
    require(column.empty() || column.size() == number, "a number for each point or none");
    for (const double value : column) require(std::isfinite(value), "a finite number");
  }
  require(points.labels.empty() || points.labels.size() == number,
          "a label for each point or none");
  if (points.is_polynomial) return;
  for (const Linear_motion_2& m : points.motions) {
    require(is_finite(m) && m.epoch == 0, "finite numbers at epoch 0");
  }
  for (const double radius : points.radii) require(radius >= 0, "a radius that is not negative");
  for (const double mass : points.masses) require(mass > 0, "a mass that is positive");
  std::stringstream written;
  write_points(written, points.motions, points.radii, points.growths, points.masses);
  const Points_file again = read_points(written, "written");
  require(again.motions.size() == points.motions.size(), "as many points as were written");
  for (std::size_t i = 0; i < again.motions.size(); ++i) {
    const Linear_motion_2& a = again.motions[i];
    const Linear_motion_2& b = points.motions[i];
    require(same_number(a.position.x, b.position.x) && same_number(a.position.y, b.position.y) &&
                same_number(a.velocity.x, b.velocity.x) && same_number(a.velocity.y, b.velocity.y),
            "the numbers that were written");
  }
  require(again.radii == points.radii, "the radii that were written");
  require(again.growths == points.growths, "the growths that were written");
  require(again.masses == points.masses, "the masses that were written");
}

}  // namespace
}  // namespace kinetri

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  std::istringstream in(text);
  try {
    kinetri::check_points(kinetri::read_points(in, "input"));
  } catch (const kinetri::Input_error& error) {
    const std::string message = error.what();
    kinetri::test::require(message.starts_with("input:"), "a message with its place: " + message);
    kinetri::test::require(message.find('\n') == std::string::npos, "a message on one line");
  }
  std::istringstream fields(text);
  for (std::string field; std::getline(fields, field, ',');) kinetri::check_number(field);
  return 0;
}
