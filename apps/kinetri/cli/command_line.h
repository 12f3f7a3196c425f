// SPDX-License-Identifier: GPL-3.0-or-later
//
// How commands declare what they take on the command line. Compiled once: CLI11 is all in headers.
#ifndef KINETRI_APPS_COMMAND_LINE_H
#define KINETRI_APPS_COMMAND_LINE_H

#include <CLI/App.hpp>
#include <optional>
#include <string>

namespace kinetri::app {

/// A command of the program, or of a command.
CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& help);

/// An option, or a positional argument where `names` has no dashes, whose value is kept as it
/// stands on the command line. `type` is what --help shows, and says what is completed
/// (command_table.h).
CLI::Option* add_option(CLI::App& command, const std::string& names, std::string& value,
                        const std::string& type, const std::string& help);
CLI::Option* add_option(CLI::App& command, const std::string& names,
                        std::optional<std::string>& value, const std::string& type,
                        const std::string& help);

/// An option without a value.
CLI::Option* add_flag(CLI::App& command, const std::string& name, bool& value,
                      const std::string& help);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMMAND_LINE_H
