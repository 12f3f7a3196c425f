// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/manual_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "cli/command_table.h"
#include "io/output_file.h"
#include "kinetri/version.h"

namespace kinetri::app {
namespace {

// The text as it is to appear: without escape sequences, and with `-` as it is typed.
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

// A line of text, which must not begin like a request.
std::string line(std::string_view text) {
  const bool is_request = text.starts_with('.') || text.starts_with('\'');
  return fmt::format("{}{}\n", is_request ? "\\&" : "", plain(text));
}

std::string bold(std::string_view text) {
  return fmt::format("\\fB{}\\fR", plain(text));
}
std::string italic(std::string_view text) {
  return fmt::format("\\fI{}\\fR", plain(text));
}

// The text below the options in --help: paragraphs, and indented lines that stay as they are.
void write_footer(std::ostream& out, const std::string& text) {
  bool is_example = false;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view one = std::string_view(text).substr(start, end - start);
    start = end + 1;
    if (one.starts_with("  ") != is_example) {
      is_example = !is_example;
      out << (is_example ? ".PP\n.EX\n" : ".EE\n");
    }
    if (one.empty()) {
      out << ".PP\n";
    } else {
      out << line(one);
    }
  }
  if (is_example) out << ".EE\n";
}

void write_option(std::ostream& out, const Option_entry& option) {
  out << ".TP\n";
  if (option.positional) {
    out << italic(option.names.front());
  } else {
    for (const std::string& name : option.names) {
      if (name != option.names.front()) out << ", ";
      out << bold(name);
    }
    if (!option.type.empty()) out << " " << italic(option.type);
  }
  out << "\n" << line(option.help + (option.required ? " (required)" : ""));
}

void write_command(std::ostream& out, const Command_entry& command) {
  out << ".SS " << plain(command.name);
  for (const Option_entry& option : command.options) {
    if (option.positional) out << " " << plain(option.names.front());
  }
  out << (command.commands.empty() ? " [OPTIONS]\n" : " COMMAND\n") << line(command.help);
  for (const Option_entry& option : command.options) {
    const bool is_help = !option.positional && option.names.back() == "--help";
    if (!is_help) write_option(out, option);
  }
  out << ".PP\n";
  write_footer(out, command.footer);
}

void write_manual(std::ostream& out, const std::vector<Command_entry>& table) {
  const Command_entry& program = table.front();
  out << ".\\\" Made by `kinetri manual`.\n.TH KINETRI 1 \"\" \"kinetri " << version
      << "\" \"User Commands\"\n"
         ".nh\n.ad l\n"
         ".SH NAME\nkinetri \\- exact kinetic Delaunay triangulation of moving points\n"
         ".SH SYNOPSIS\n";
  for (const Command_entry& command : table) {
    if (&command != &program && command.commands.empty()) {
      out << ".B " << plain(command.name) << "\n[\\fIOPTIONS\\fR]";
      for (const Option_entry& option : command.options) {
        if (option.positional) out << " " << italic(option.names.front());
      }
      out << "\n.br\n";
    }
  }
  out << ".SH DESCRIPTION\n"
      << line(program.help)
      << "The triangulation is kept right through time, event by event, and every decision is the "
         "one\n"
         "that exact arithmetic makes. The same input gives the same events in the same order.\n"
         ".PP\n";
  write_footer(out, program.footer);
  out << ".SH OPTIONS\n";
  for (const Option_entry& option : program.options) write_option(out, option);
  out << ".SH COMMANDS\nEach command knows the option \\fB\\-\\-help\\fR.\n";
  for (const Command_entry& command : table) {
    if (&command != &program) write_command(out, command);
  }
  out << ".SH EXIT STATUS\n"
         ".TP\n0\nDone.\n"
         ".TP\n1\nAn audit failed.\n"
         ".TP\n2\nBad usage or bad input; standard error says what was expected.\n"
         ".TP\n3\nAn internal check failed.\n"
         ".TP\n130\nInterrupted, after writing what there is.\n";
}

}  // namespace

Manual_command::Manual_command(CLI::App& program)
    : program_(&program), command_(add_command(program, "manual", "Write the manual page")) {
  command_->footer(
      "Where Kinetri is installed, man kinetri shows it.\n\n"
      "Example:\n"
      "  kinetri manual | man -l -");
}

Exit_code Manual_command::run() const {
  Output_file output("-");
  write_manual(output.stream(), command_table(*program_));
  output.commit();
  return Exit_code::done;
}

}  // namespace kinetri::app
