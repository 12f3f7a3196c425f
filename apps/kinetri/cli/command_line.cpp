// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"

#include <CLI/CLI.hpp>

namespace kinetri::app {

CLI::App* add_command(CLI::App& program, const std::string& name, const std::string& help) {
  return program.add_subcommand(name, help);
}

CLI::Option* add_option(CLI::App& command, const std::string& names, std::string& value,
                        const std::string& type, const std::string& help) {
  return command.add_option(names, value, help)->type_name(type);
}

CLI::Option* add_option(CLI::App& command, const std::string& names,
                        std::optional<std::string>& value, const std::string& type,
                        const std::string& help) {
  return command.add_option(names, value, help)->type_name(type);
}

CLI::Option* add_flag(CLI::App& command, const std::string& name, bool& value,
                      const std::string& help) {
  return command.add_flag(name, value, help);
}

}  // namespace kinetri::app
