// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of options that several commands have.
#ifndef KINETRI_APPS_COMMON_ARGUMENTS_H
#define KINETRI_APPS_COMMON_ARGUMENTS_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command.h"
#include "kinetri/simulation/box_2.h"
#include "kinetri/triangulation/coincident_points.h"

namespace kinetri::app {

/// A length, speed or time of a generated scenario. Throws Usage_error.
double scenario_size_argument(std::string_view option, std::string_view text,
                              bool zero_allowed = false);

/// The value of --sizes, the radius of some discs over that of the others. Throws Usage_error.
double size_ratio_argument(std::string_view text);

/// The value of --seed. Throws Usage_error.
std::uint64_t seed_argument(std::string_view text);

/// The value of --box. Throws Usage_error.
Box_2 box_argument(const std::string& text);

/// The finite numbers in `text`, which are separated by commas: from `least` to `most` of them, as
/// `expected` says. Throws Usage_error.
std::vector<double> numbers_argument(std::string_view option, const std::string& text,
                                     std::size_t least, std::size_t most,
                                     std::string_view expected);

/// Declares --coincident. `target` gets the default, and must outlive the command.
void add_coincident_option(Command& command, std::string& target);

/// The value of --coincident. Throws Usage_error.
Coincident_points coincident_argument(const std::string& text);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMMON_ARGUMENTS_H
