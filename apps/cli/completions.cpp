// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/completions.h"

#include <algorithm>
#include <ostream>
#include <string>
#include <string_view>

#include "cli/text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

// The text with a backslash before each of the characters.
std::string escaped(std::string_view text, std::string_view characters) {
  std::string result;
  for (const char c : text) {
    if (characters.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

// One word of the language of bash and zsh.
std::string shell_quoted(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += R"('\'')";
    } else {
      result += c;
    }
  }
  return result + "'";
}

// One word of fish's language.
std::string fish_quoted(std::string_view text) {
  return joined("'", escaped(text, R"(\')"), "'");
}

std::vector<std::string> names_of_commands(const Command& command) {
  std::vector<std::string> result;
  for (const Command& inner : command.commands) result.push_back(inner.name);
  return result;
}

// ---- bash ----

// What completes a value: assignments to the script's variables.
std::string bash_value(const Option& option) {
  switch (option.kind()) {
    case Value_kind::choice:
      return "words=" + shell_quoted(separated(option.choices(), " "));
    case Value_kind::file:
      return "files=default";
    case Value_kind::directory:
      return "files=dirnames";
    case Value_kind::none:
    case Value_kind::other:
      break;
  }
  return ":";
}

void write_bash_command(std::ostream& out, const Command& command, const std::string& name) {
  std::vector<std::string> options;
  std::string value = "words=" + shell_quoted(separated(names_of_commands(command), " "));
  for (const Option& option : command.options) {
    if (option.positional()) {
      value = bash_value(option);
    } else {
      options.insert(options.end(), option.names.begin(), option.names.end());
    }
  }
  out << "        " << shell_quoted(name) << ")\n          if [[ $current == -* ]]; then words="
      << shell_quoted(separated(options, " ")) << "; else " << value << "; fi ;;\n";
}

// ---- zsh ----

std::string zsh_function(const std::string& name) {
  std::string result = "_" + name;
  std::ranges::replace(result, ' ', '_');
  return result;
}

// What completes a value: the last part of a specification of _arguments.
std::string zsh_value(const Option& option) {
  switch (option.kind()) {
    case Value_kind::choice:
      return joined("(", separated(option.choices(), " "), ")");
    case Value_kind::file:
      return "_files";
    case Value_kind::directory:
      return "_files -/";
    case Value_kind::none:
    case Value_kind::other:
      break;
  }
  return " ";
}

// The specifications of one option for _arguments, one for each of its names.
std::vector<std::string> zsh_specifications(const Option& option) {
  std::string value;
  if (option.kind() != Value_kind::none) {
    value = joined(":", escaped(option.type, ":\\"), ":", zsh_value(option));
  }
  if (option.positional()) return {"1" + value};
  std::vector<std::string> result;
  for (const std::string& name : option.names) {
    // A long name takes its value after `=` or in the next word, a short one also directly.
    const std::string_view separator = value.empty() ? "" : name.starts_with("--") ? "=" : "+";
    result.push_back(joined("(", separated(option.names, " "), ")", name, separator, "[",
                            escaped(option.help, "[]:\\"), "]", value));
  }
  return result;
}

void write_zsh_function(std::ostream& out, const Command& command, const std::string& name) {
  out << zsh_function(name) << "() {\n";
  if (!command.commands.empty()) out << "  local context line state state_descr\n";
  out << "  _arguments -S" << (command.commands.empty() ? "" : " -C");
  for (const Option& option : command.options) {
    for (const std::string& text : zsh_specifications(option))
      out << " \\\n    " << shell_quoted(text);
  }
  if (command.commands.empty()) {
    out << "\n}\n\n";
    return;
  }
  std::string commands;
  for (const Command& inner : command.commands) {
    commands += joined(" ", inner.name, "\\:", shell_quoted(escaped(inner.summary, ":\\")));
  }
  out << " \\\n    " << shell_quoted(joined("1:command:((", commands, "))"))
      << " \\\n    '*::argument:->arguments'\n"
         "  [[ $state == arguments ]] || return\n"
         "  case $words[1] in\n";
  for (const Command& inner : command.commands) {
    out << "    " << inner.name << ") " << zsh_function(name + " " + inner.name) << " ;;\n";
  }
  out << "  esac\n}\n\n";
}

// ---- fish ----

// `begin`: the beginning of each line.
void write_fish_option(std::ostream& out, const std::string& begin, const Option& option) {
  out << begin;
  for (const std::string& name : option.names) {
    if (option.positional()) break;
    const bool is_long = name.starts_with("--");
    out << (is_long ? " -l " : " -s ") << name.substr(is_long ? 2 : 1);
  }
  switch (option.kind()) {
    case Value_kind::none:
      break;
    case Value_kind::choice:
      out << " -x -a " << fish_quoted(separated(option.choices(), " "));
      break;
    case Value_kind::file:
      out << (option.positional() ? " -F" : " -r -F");
      break;
    case Value_kind::directory:
      out << " -x -a '(__fish_complete_directories)'";
      break;
    case Value_kind::other:
      out << " -x";
      break;
  }
  out << " -d " << fish_quoted(option.help) << "\n";
}

}  // namespace

void write_bash_completion(std::ostream& out, const Command& program) {
  const std::vector<Named_command> table = all_commands(program);
  out << with_name(R"(# Completion for NAME in bash, made by `NAME completion bash`.
_NAME() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  # To bash, --option=value is three words.
  if [[ $current == = ]]; then
    current=
  elif [[ $previous == = ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  local command=NAME word words= files=
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$command $word" in
)",
                   program.name);
  for (const auto& [name, command] : table) {
    for (const std::string& inner : names_of_commands(*command)) {
      out << "      " << shell_quoted(name + " " + inner) << ") command+=\" $word\" ;;\n";
    }
  }
  out << "    esac\n  done\n  case \"$command $previous\" in\n";
  for (const auto& [name, command] : table) {
    for (const Option& option : command->options) {
      if (option.positional() || option.kind() == Value_kind::none) continue;
      for (const std::string& word : option.names) {
        out << "    " << shell_quoted(name + " " + word) << ") " << bash_value(option) << " ;;\n";
      }
    }
  }
  out << "    *)\n      case $command in\n";
  for (const auto& [name, command] : table) write_bash_command(out, *command, name);
  out << with_name(R"(      esac ;;
  esac
  COMPREPLY=()
  if [[ -n $files ]]; then
    # No word of ours: readline completes names of files, and quotes them.
    compopt -o "$files"
  else
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
  fi
}
complete -F _NAME NAME
)",
                   program.name);
}

void write_zsh_completion(std::ostream& out, const Command& program) {
  const std::vector<Named_command> table = all_commands(program);
  out << with_name(
      "#compdef NAME\n# Completion for NAME in zsh, made by `NAME completion zsh`.\n\n",
      program.name);
  for (const auto& [name, command] : table) write_zsh_function(out, *command, name);
  out << with_name(
      R"(# Loaded from $fpath this is the function itself, at its first call; else it is being sourced.
if [[ $funcstack[1] == _NAME ]]; then
  _NAME "$@"
else
  compdef _NAME NAME
fi
)",
      program.name);
}

void write_fish_completion(std::ostream& out, const Command& program) {
  const std::vector<Named_command> table = all_commands(program);
  out << with_name(R"(# Completion for NAME in fish, made by `NAME completion fish`.

# Whether the command line has got to the command that is named.
function __NAME_is_at
  set -l command NAME
  for word in (commandline -opc)[2..]
    switch "$command $word"
      case)",
                   program.name);
  for (const auto& [name, command] : table) {
    for (const std::string& inner : names_of_commands(*command)) {
      out << " " << fish_quoted(name + " " + inner);
    }
  }
  out << with_name(R"(
        set command "$command $word"
    end
  end
  test "$command" = "$argv"
end

complete -c NAME -f
)",
                   program.name);
  for (const auto& [name, command] : table) {
    const std::string begin = joined("complete -c ", program.name, " -n ",
                                     fish_quoted(joined("__", program.name, "_is_at ", name)));
    for (const Command& inner : command->commands) {
      out << begin << " -a " << inner.name << " -d " << fish_quoted(inner.summary) << "\n";
    }
    for (const Option& option : command->options) write_fish_option(out, begin, option);
  }
}

}  // namespace kinetri::app
