// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/periodic_points.h"

#include <algorithm>
#include <utility>

#include "kinetri/impl/io/text.h"
#include "kinetri/io/points_file.h"
#include "sources/points_source.h"
#include "sources/run_source.h"

namespace kinetri::app {

Periodic_points points_in_box(const std::string& path, const Periodic_box_2& box, double from,
                              double until) {
  Points_file file = read_points_file(path);
  const std::string name = input_name(path);
  if (file.is_polynomial) {
    throw Input_error(name, 0,
                      "the points accelerate, but those in a periodic box move on straight lines; "
                      "expected no columns ax, ay, jx and jy, or no --periodic");
  }
  Periodic_points result = {
      .box = box, .from = from, .until = until, .motions = std::move(file.motions)};
  result.number_of_points = result.motions.size();
  result.labels = std::move(file.labels);
  result.remarks = remarks_about(file);
  if (!file.is_utf16) result.verified = path;  // kinetri-verify does not read UTF-16
  result.coincidence = [name, lines = std::move(file.lines)](
                           const Coincident_trajectories_error& error, double) {
    const auto [first, second] = std::minmax({error.first(), error.second()});
    return Input_error(name, lines[second],
                       joined("the point is an image of the one in line ", lines[first],
                              " at all times; expected points that differ by more than vectors of "
                              "the periodic box, or --coincident hide"));
  };
  return result;
}

}  // namespace kinetri::app
