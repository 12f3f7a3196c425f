// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands and options of a program as plain values. The parser, --help, the manual page and
// the completions are all generated from them.
#ifndef KINETRI_APPS_COMMAND_H
#define KINETRI_APPS_COMMAND_H

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/exit_code.h"

namespace kinetri::app {

/// Which values a shell offers to complete.
enum class Value_kind {
  none,  ///< there is no value: the option is a flag
  choice,
  file,
  directory,
  other,  ///< a number, for example: nothing is completed
};

/// Where the parser stores the text of an option's value; of an option that may be repeated, all
/// values.
using Option_target =
    std::variant<bool*, std::string*, std::optional<std::string>*, std::vector<std::string>*>;

/// An option or a positional argument.
struct Option {
  std::vector<std::string> names;  ///< with dashes, short ones first; of a positional one, without
  std::string type;                ///< "FILE", "a|b|c", ...; empty if there is no value
  std::string help;
  Option_target target = static_cast<bool*>(nullptr);
  bool required = false;
  std::string heading = {};   ///< in --help; empty: "Options"
  std::string needs = {};     ///< the name of an option that this one requires
  std::string excludes = {};  ///< the name of an option with which this one cannot be used
  /// Of a required option, the name of one that may replace it. The command itself must check that
  /// one of the two is given.
  std::string alternative = {};

  bool positional() const { return !names.back().starts_with('-'); }
  /// In help: whether it is required, and what may replace it.
  std::string remark() const;
  /// The long name.
  const std::string& name() const { return names.back(); }
  Value_kind kind() const;
  /// The values of a choice, whose type reads "a|b|c".
  std::vector<std::string> choices() const;
};

/// A command, or the program itself.
struct Command {
  std::string name;     ///< one word
  std::string summary;  ///< one line
  /// Paragraphs below the options. Lines of --help and of the manual page are broken by width.
  std::vector<std::string> description = {};
  std::vector<std::string> examples = {};  ///< command lines, at least one
  std::vector<Option> options = {};
  std::vector<Command> commands = {};  ///< one of which must be named, if there are any
  /// Of a program: its exit codes, and what each means, for the manual page.
  std::vector<std::pair<int, std::string>> exit_codes = {};
  /// Called with the whole program after parsing. May throw Usage_error.
  std::function<Exit_code(const Command& program)> run = nullptr;

  /// Adds an option, or a positional argument if `names` has no dashes, and returns it. `names`
  /// reads "-o,--output". The reference is valid until the next one is added.
  Option& add(const std::string& names, Option_target target, const std::string& type,
              const std::string& help);
  /// Adds one that the command requires.
  Option& add_required(const std::string& names, Option_target target, const std::string& type,
                       const std::string& help);
  /// Adds an option without a value.
  Option& add_flag(const std::string& names, bool& target, const std::string& help);

  const Option* find_option(const std::string& wanted) const;
  const Command* find_command(const std::string& wanted) const;
};

/// A command with its name in full: `kinetri generate uniform`.
struct Named_command {
  std::string name;
  const Command* command;
};

/// The program and all its commands, each before its own. `program` must outlive the result.
std::vector<Named_command> all_commands(const Command& program);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMMAND_H
