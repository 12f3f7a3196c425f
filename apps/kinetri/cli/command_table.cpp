// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_table.h"

#include <algorithm>
#include <utility>

namespace kinetri::app {
namespace {

Option_entry entry_of(const CLI::Option& option) {
  Option_entry result;
  result.positional = option.get_positional();
  if (result.positional) {
    result.names.push_back(option.get_name(true));
  } else {
    for (const std::string& name : option.get_snames()) result.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) result.names.push_back("--" + name);
  }
  if (option.get_items_expected_max() > 0) result.type = option.get_type_name();
  result.help = option.get_description();
  result.required = option.get_required();
  return result;
}

void append(std::vector<Command_entry>& table, const CLI::App& app, const std::string& name) {
  Command_entry entry;
  entry.name = name;
  entry.help = app.get_description();
  entry.footer = app.get_footer();
  for (const CLI::Option* option : app.get_options()) entry.options.push_back(entry_of(*option));
  std::stable_partition(entry.options.begin(), entry.options.end(),
                        [](const Option_entry& option) { return !option.positional; });
  const auto commands = app.get_subcommands(nullptr);
  for (const CLI::App* command : commands) {
    entry.commands.push_back(name + " " + command->get_name());
  }
  table.push_back(std::move(entry));
  for (const CLI::App* command : commands)
    append(table, *command, name + " " + command->get_name());
}

}  // namespace

Value_kind Option_entry::kind() const {
  if (type.empty()) return Value_kind::none;
  if (type.find('|') != std::string::npos) return Value_kind::choice;
  if (type == "FILE") return Value_kind::file;
  return type == "DIR" ? Value_kind::directory : Value_kind::other;
}

std::vector<std::string> Option_entry::choices() const {
  std::vector<std::string> result;
  if (kind() != Value_kind::choice) return result;
  for (std::size_t start = 0; start <= type.size();) {
    const std::size_t bar = std::min(type.find('|', start), type.size());
    result.push_back(type.substr(start, bar - start));
    start = bar + 1;
  }
  return result;
}

std::string last_word(const std::string& name) {
  return name.substr(name.rfind(' ') + 1);
}

std::vector<Command_entry> command_table(const CLI::App& program) {
  std::vector<Command_entry> result;
  append(result, program, program.get_name());
  return result;
}

}  // namespace kinetri::app
