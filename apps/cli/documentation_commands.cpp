// SPDX-License-Identifier: GPL-3.0-or-later
//
// help, completion and manual: what the program says of itself, made from its own commands.
#include <array>
#include <memory>
#include <string_view>

#include "cli/arguments.h"
#include "cli/completions.h"
#include "cli/help.h"
#include "cli/manual.h"
#include "cli/text.h"
#include "commands/commands.h"
#include "io/output_file.h"

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

}  // namespace

Command completion_command() {
  const auto shell = std::make_shared<std::string>();
  Command result;
  result.name = "completion";
  result.summary = "Write the script by which a shell completes command lines";
  result.add_required("SHELL", shell.get(), choice_type(shells), "The shell");
  result.description = {
      "Packages install these scripts where shells find them. Without a package, write the script "
      "to ~/.local/share/bash-completion/completions/kinetri for bash, to "
      "~/.config/fish/completions/kinetri.fish for fish, or to a file _kinetri in a directory of "
      "$fpath for zsh. The examples load it into the shell that is running."};
  result.examples = {"kinetri completion bash > kinetri.bash; source ./kinetri.bash",
                     "kinetri completion fish | source"};
  result.run = [shell](const Command& program) {
    constexpr std::array writers = {write_bash_completion, write_zsh_completion,
                                    write_fish_completion};
    const std::size_t chosen = choice_argument("SHELL", *shell, shells);
    return print([&](std::ostream& out) { writers[chosen](out, program); });
  };
  return result;
}

Command manual_command() {
  Command result;
  result.name = "manual";
  result.summary = "Write the manual page";
  result.description = {"Where Kinetri is installed, `man kinetri` shows it."};
  result.examples = {"kinetri manual | man -l -"};
  result.run = [](const Command& program) {
    return print([&](std::ostream& out) { write_manual(out, program); });
  };
  return result;
}

Command help_command(const std::vector<std::string>& names) {
  const auto command = std::make_shared<std::string>();
  Command result;
  result.name = "help";
  result.summary = "Show the help of a command";
  result.add("COMMAND", command.get(), separated(names, "|"),
             "The command; without one, all commands are listed");
  result.description = {
      "`kinetri help COMMAND` shows what `kinetri COMMAND --help` shows. A scenario of generate is "
      "named after it."};
  result.examples = {"kinetri help simulate", "kinetri help generate uniform"};
  // The parser itself finds the command (see parse); this one keeps the target alive.
  result.run = [command](const Command& program) {
    return print([&](std::ostream& out) { out << help_text(program, program.name); });
  };
  return result;
}

}  // namespace kinetri::app
