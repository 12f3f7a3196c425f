// SPDX-License-Identifier: GPL-3.0-or-later
//
// The options --periodic and --shear.
#ifndef KINETRI_APPS_PERIODIC_OPTION_H
#define KINETRI_APPS_PERIODIC_OPTION_H

#include <optional>
#include <string>
#include <string_view>

#include "cli/command.h"
#include "commands/run_options.h"
#include "kinetri/kinetic/periodic_box_2.h"

namespace kinetri::app {

/// Their texts.
struct Periodic_options {
  std::optional<std::string> periodic;
  std::optional<std::string> shear;
};

/// Declares both. `options` must outlive the command.
void add_periodic_options(Command& command, Periodic_options& options);

/// The box of both. Throws Usage_error. Precondition: --periodic is given.
Periodic_box_2 periodic_box(const Periodic_options& options);

/// Throws Usage_error if --shear is given without --periodic.
void expect_no_shear(const Periodic_options& options);

/// Throws Usage_error: the option, which is given, is not for periodic boxes.
[[noreturn]] void refuse_with_periodic(std::string_view option);

/// Throws Usage_error if an option is given that is not for periodic boxes.
void expect_periodic(const Run_options& options);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_PERIODIC_OPTION_H
