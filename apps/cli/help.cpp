// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/help.h"

#include <algorithm>
#include <string_view>

#include "cli/terminal.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

constexpr std::size_t line_width = 80;
constexpr std::size_t label_width = 28;

// Wraps the text to `line_width` columns. The first line starts at `column`, the others with
// `indent` blanks.
std::string wrapped(std::string_view text, std::size_t column, std::size_t indent) {
  std::string result;
  bool is_first_word = true;
  while (!text.empty()) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, blank);
    text.remove_prefix(std::min(blank + 1, text.size()));
    if (!is_first_word && column + 1 + word.size() > line_width) {
      result += '\n';
      result.append(indent, ' ');
      column = indent;
    } else if (!is_first_word) {
      result += ' ';
      ++column;
    }
    is_first_word = false;
    result += word;
    column += word.size();
  }
  result += '\n';
  return result;
}

// A line "  label   text". If the label is long, the text begins on the next line.
std::string row(const std::string& label, const std::string& text) {
  std::string result = joined("  ", label);
  if (result.size() + 2 > label_width) {
    result += '\n';
    result.append(label_width, ' ');
  } else {
    result = left_aligned(result, label_width);
  }
  return joined(result, wrapped(text, label_width, label_width));
}

std::string section(const std::string& title) {
  return joined("\n", heading(joined(title, ":"), Stream::output), "\n");
}

// The headings in the order in which they occur.
std::vector<std::string> headings_of(const Command& command) {
  std::vector<std::string> result;
  for (const Option& option : command.options) {
    const bool is_new = std::find(result.begin(), result.end(), option.heading) == result.end();
    if (!option.positional() && is_new) result.push_back(option.heading);
  }
  return result;
}

}  // namespace

std::string usage_line(const Command& command, const std::string& name) {
  std::string result = name;
  for (const Option& option : command.options) {
    if (!option.positional()) continue;
    result += option.required ? joined(" ", option.name()) : joined(" [", option.name(), "]");
  }
  for (const Option& option : command.options) {
    if (option.required && !option.positional()) {
      result += joined(" ", option.name(), " ", option.type);
    }
  }
  return joined(result, command.commands.empty() ? " [OPTIONS]" : " COMMAND [OPTIONS]");
}

std::string option_label(const Option& option) {
  std::string result = separated(option.names, ", ");
  return option.type.empty() ? result : joined(result, " ", option.type);
}

std::string help_text(const Command& command, const std::string& name) {
  std::string result =
      joined(wrapped(joined(command.summary, "."), 0, 0), "\n", heading("Usage:", Stream::output),
             " ", usage_line(command, name), "\n");
  const auto add = [&result](const Option& option) {
    result += row(option_label(option), joined(option.help, option.remark()));
  };
  const auto is_positional = [](const Option& option) { return option.positional(); };
  if (std::any_of(command.options.begin(), command.options.end(), is_positional)) {
    result += section("Arguments");
  }
  for (const Option& option : command.options) {
    if (option.positional()) add(option);
  }
  if (!command.commands.empty()) result += section("Commands");
  for (const Command& inner : command.commands) result += row(inner.name, inner.summary);
  for (const std::string& title : headings_of(command)) {
    result += section(title.empty() ? "Options" : title);
    for (const Option& option : command.options) {
      if (!option.positional() && option.heading == title) add(option);
    }
  }
  for (const std::string& paragraph : command.description) {
    result += joined("\n", wrapped(paragraph, 0, 0));
  }
  result += section("Example");
  for (const std::string& example : command.examples) result += joined("  ", example, "\n");
  return result;
}

}  // namespace kinetri::app
