// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command.h"

#include <algorithm>

#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> result;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    result.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return result;
}

void append(std::vector<Named_command>& result, const Command& command, const std::string& name) {
  result.push_back({name, &command});
  for (const Command& inner : command.commands) append(result, inner, name + " " + inner.name);
}

}  // namespace

std::string Option::remark() const {
  if (!required) return {};
  return alternative.empty() ? " (required)" : joined(" (required, or ", alternative, ")");
}

Value_kind Option::kind() const {
  if (type.empty()) return Value_kind::none;
  if (type.find('|') != std::string::npos) return Value_kind::choice;
  if (type == "FILE") return Value_kind::file;
  return type == "DIR" ? Value_kind::directory : Value_kind::other;
}

std::vector<std::string> Option::choices() const {
  return kind() == Value_kind::choice ? split(type, '|') : std::vector<std::string>();
}

Option& Command::add(const std::string& names, Option_target target, const std::string& type,
                     const std::string& help) {
  options.push_back({split(names, ','), type, help, target});
  return options.back();
}

Option& Command::add_required(const std::string& names, Option_target target,
                              const std::string& type, const std::string& help) {
  Option& result = add(names, target, type, help);
  result.required = true;
  return result;
}

Option& Command::add_flag(const std::string& names, bool& target, const std::string& help) {
  return add(names, &target, "", help);
}

const Option* Command::find_option(const std::string& wanted) const {
  const auto found = std::find_if(options.begin(), options.end(), [&](const Option& option) {
    return std::find(option.names.begin(), option.names.end(), wanted) != option.names.end();
  });
  return found == options.end() ? nullptr : &*found;
}

const Command* Command::find_command(const std::string& wanted) const {
  const auto found = std::find_if(commands.begin(), commands.end(),
                                  [&](const Command& command) { return command.name == wanted; });
  return found == commands.end() ? nullptr : &*found;
}

std::vector<Named_command> all_commands(const Command& program) {
  std::vector<Named_command> result;
  append(result, program, program.name);
  return result;
}

}  // namespace kinetri::app
