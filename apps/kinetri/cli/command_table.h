// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands and options of the program as plain values, for what is made from them: the manual
// page and the completions.
#ifndef KINETRI_APPS_COMMAND_TABLE_H
#define KINETRI_APPS_COMMAND_TABLE_H

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace kinetri::app {

/// What is completed where the value of an option stands.
enum class Value_kind {
  none,  ///< there is no value: the option is a flag
  choice,
  file,
  directory,
  other,  ///< a number, say: nothing is completed
};

/// An option or a positional argument.
struct Option_entry {
  std::vector<std::string> names;  ///< with dashes; the one name of a positional without
  std::string type;                ///< as in --help; empty if there is no value
  std::string help;
  bool required = false;
  bool positional = false;

  Value_kind kind() const;
  /// The values of a choice, whose type reads "a|b|c".
  std::vector<std::string> choices() const;
};

/// A command: the program itself, `kinetri simulate`, `kinetri generate uniform`, ...
struct Command_entry {
  std::string name;  ///< in full
  std::string help;
  std::string footer;
  std::vector<Option_entry> options;  ///< options first, then positionals, each as in --help
  std::vector<std::string> commands;  ///< the full names of its commands, if any
};

/// The last word of a full name: "uniform" of "kinetri generate uniform".
std::string last_word(const std::string& name);

/// The program and all its commands, each before its own.
std::vector<Command_entry> command_table(const CLI::App& program);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COMMAND_TABLE_H
