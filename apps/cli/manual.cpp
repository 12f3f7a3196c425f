// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/manual.h"

#include <algorithm>
#include <cctype>
#include <ostream>
#include <string>
#include <string_view>

#include "cli/text.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/version.h"

namespace kinetri::app {
namespace {

// The text escaped for roff.
std::string plain(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

// A line of text, protected from being read as a request of roff.
std::string line(std::string_view text) {
  const bool is_request = text.starts_with('.') || text.starts_with('\'');
  return joined(is_request ? "\\&" : "", plain(text), "\n");
}

std::string bold(std::string_view text) {
  return joined("\\fB", plain(text), "\\fR");
}
std::string italic(std::string_view text) {
  return joined("\\fI", plain(text), "\\fR");
}

// The paragraphs below the options in --help.
void write_description(std::ostream& out, const Command& command) {
  for (const std::string& paragraph : command.description) out << ".PP\n" << line(paragraph);
  out << ".PP\nExample:\n.PP\n.EX\n";
  for (const std::string& example : command.examples) out << line("  " + example);
  out << ".EE\n";
}

void write_option(std::ostream& out, const Option& option) {
  out << ".TP\n";
  if (option.positional()) {
    out << italic(option.names.front());
  } else {
    for (const std::string& name : option.names) {
      if (name != option.names.front()) out << ", ";
      out << bold(name);
    }
    if (!option.type.empty()) out << " " << italic(option.type);
  }
  out << "\n" << line(option.help + option.remark());
}

void write_command(std::ostream& out, const Command& command, const std::string& name) {
  out << ".SS " << plain(name);
  for (const Option& option : command.options) {
    if (option.positional()) out << " " << plain(option.name());
  }
  out << (command.commands.empty() ? " [OPTIONS]\n" : " COMMAND\n") << line(command.summary + ".");
  for (const Option& option : command.options) {
    if (option.name() != "--help") write_option(out, option);
  }
  write_description(out, command);
}

// The command with its arguments and required options.
void write_synopsis(std::ostream& out, const Command& command, const std::string& name) {
  out << ".B " << plain(name) << "\n";
  for (const Option& option : command.options) {
    if (option.positional()) out << italic(option.name()) << "\n";
  }
  for (const Option& option : command.options) {
    if (option.required && !option.positional()) {
      out << bold(option.name()) << " " << italic(option.type) << "\n";
    }
  }
  out << "[\\fIOPTIONS\\fR]\n.br\n";
}

}  // namespace

void write_manual(std::ostream& out, const Command& program) {
  const std::vector<Named_command> table = all_commands(program);
  std::string title = program.name;
  std::ranges::transform(title, title.begin(), [](unsigned char c) { return std::toupper(c); });
  std::string summary = program.summary;
  summary.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(summary.front())));
  out << with_name(".\\\" Made by `NAME manual`.\n", program.name) << ".TH " << plain(title)
      << " 1 \"\" \"" << plain(program.name) << " " << version
      << "\" \"User Commands\"\n"
         ".nh\n.ad l\n"
         ".SH NAME\n"
      << plain(program.name) << " \\- " << line(summary) << ".SH SYNOPSIS\n";
  for (const auto& [name, command] : table) {
    if (command->commands.empty()) write_synopsis(out, *command, name);
  }
  out << ".SH DESCRIPTION\n" << line(program.summary + ".");
  write_description(out, program);
  out << ".SH OPTIONS\n";
  for (const Option& option : program.options) write_option(out, option);
  out << ".SH COMMANDS\nEach command has the option \\fB\\-\\-help\\fR.\n";
  for (const auto& [name, command] : table) {
    if (command != &program) write_command(out, *command, name);
  }
  out << ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : program.exit_codes) {
    out << ".TP\n" << code << "\n" << line(meaning);
  }
  out << ".SH ENVIRONMENT\n"
         ".TP\nNO_COLOR\nIf it is set, and not empty, nothing is colored.\n";
}

}  // namespace kinetri::app
