// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/periodic_option.h"

#include <cmath>
#include <vector>

#include "cli/arguments.h"
#include "commands/common_arguments.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {

void add_periodic_options(Command& command, Periodic_options& options) {
  command.add("--periodic", &options.periodic, "LX,LY[,XY]",
              "Repeat the points all over the plane, without walls: each point stands for all its "
              "images, moved by whole multiples of (LX, 0) and of (XY, LY); XY is 0 if it is left "
              "out");
  command.add(
      "--shear", &options.shear, "RATE",
      "For --periodic: the vector (XY, LY), which is that at time 0, changes by (RATE LY, 0) "
      "in a unit of time (default 0)");
}

Periodic_box_2 periodic_box(const Periodic_options& options) {
  const std::string& text = *options.periodic;
  const std::vector<double> numbers =
      numbers_argument("--periodic", text, 2, 3, "two or three, LX,LY or LX,LY,XY");
  const double width = numbers[0];
  const double height = numbers[1];
  const double tilt = numbers.size() == 3 ? numbers[2] : 0;
  if (width <= 0 || height <= 0) {
    throw Usage_error(joined("--periodic: '", text,
                             "' has no area; expected LX,LY or LX,LY,XY with LX and LY greater "
                             "than 0"));
  }
  const double shear = options.shear ? number_argument("--shear", *options.shear) : 0;
  const double rate = shear * height;
  if (!std::isfinite(rate) || (rate == 0 && shear != 0)) {
    throw Usage_error(joined("--shear: ", *options.shear, " times LY, ", height,
                             ", is out of the range of binary64; expected another rate, or a box "
                             "of another size"));
  }
  return {{{width, 0}, {0, 0}, 0}, {{tilt, height}, {rate, 0}, 0}};
}

void expect_no_shear(const Periodic_options& options) {
  if (!options.shear || options.periodic) return;
  throw Usage_error("--shear: there is no periodic box; expected --periodic as well");
}

void refuse_with_periodic(std::string_view option) {
  throw Usage_error(
      joined(option, ": is not for periodic boxes; expected ", option, " or --periodic, not both"));
}

void expect_periodic(const Run_options& options) {
  if (options.until_share) refuse_with_periodic("--until-share");
  if (options.walkable) refuse_with_periodic("--walkable");
}

}  // namespace kinetri::app
