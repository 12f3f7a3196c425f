// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/documentation_commands.h"

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/completions.h"
#include "cli/help.h"
#include "cli/manual.h"
#include "cli/text.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

constexpr std::array<std::string_view, 3> shells = {"bash", "zsh", "fish"};

template <class Write>
Exit_code print(Write write) {
  Output_file output("-");
  write(output.stream());
  output.commit();
  return Exit_code::done;
}

Command completion_command(const std::string& program_name) {
  const auto shell = std::make_shared<std::string>();
  Command result;
  result.name = "completion";
  result.summary = "Write the completion script for a shell";
  result.add_required("SHELL", shell.get(), choice_type(shells), "The shell");
  result.description = {
      "Packages install these scripts where shells find them. Without a package, write the script "
      "to ~/.local/share/bash-completion/completions/NAME for bash, to "
      "~/.config/fish/completions/NAME.fish for fish, or to a file _NAME in a directory of "
      "$fpath for zsh. The examples load it into the shell that is running."};
  for (std::string& paragraph : result.description) paragraph = with_name(paragraph, program_name);
  result.examples = {
      with_name("NAME completion bash > NAME.bash; source ./NAME.bash", program_name),
      with_name("NAME completion fish | source", program_name)};
  result.run = [shell](const Command& program) {
    constexpr std::array writers = {write_bash_completion, write_zsh_completion,
                                    write_fish_completion};
    const std::size_t chosen = choice_argument("SHELL", *shell, shells);
    return print([&](std::ostream& out) { writers[chosen](out, program); });
  };
  return result;
}

Command manual_command(const std::string& program_name) {
  Command result;
  result.name = "manual";
  result.summary = "Write the manual page";
  result.description = {with_name("If Kinetri is installed, `man NAME` shows it.", program_name)};
  result.examples = {with_name("NAME manual | man -l -", program_name)};
  result.run = [](const Command& program) {
    return print([&](std::ostream& out) { write_manual(out, program); });
  };
  return result;
}

Command help_command(const Command& all, const std::string& remark,
                     const std::vector<std::string>& examples) {
  std::vector<std::string> names;
  for (const Command& command : all.commands) names.push_back(command.name);
  const auto command = std::make_shared<std::string>();
  Command result;
  result.name = "help";
  result.summary = "Show the help of a command";
  result.add("COMMAND", command.get(), separated(names, "|"),
             "The command; without one, all commands are listed");
  result.description = {
      with_name("`NAME help COMMAND` shows what `NAME COMMAND --help` shows.", all.name) + remark};
  result.examples = examples;
  // parse() itself finds the command; capturing `command` keeps the target alive.
  result.run = [command](const Command& program) {
    return print([&](std::ostream& out) { out << help_text(program, program.name); });
  };
  return result;
}

// Adds --help to the command, and to all commands in it.
void add_help(Command& command) {
  command.options.insert(command.options.begin(),
                         {{"-h", "--help"}, "", "Show this help and exit"});
  for (Command& inner : command.commands) add_help(inner);
}

}  // namespace

void add_documentation_commands(Command& program, const std::string& remark,
                                const std::vector<std::string>& examples) {
  program.commands.push_back(completion_command(program.name));
  program.commands.push_back(manual_command(program.name));
  program.commands.push_back(help_command(program, remark, examples));
  add_help(program);
  program.options.push_back({{"--version"}, "", "Show the version and exit"});
}

}  // namespace kinetri::app
