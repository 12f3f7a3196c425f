// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/completion_command.h"

#include <array>
#include <string_view>

#include "cli/arguments.h"
#include "cli/command_line.h"
#include "cli/command_table.h"
#include "cli/completions.h"
#include "io/output_file.h"

namespace kinetri::app {
namespace {

constexpr std::array<std::string_view, 3> shells = {"bash", "zsh", "fish"};

}  // namespace

Completion_command::Completion_command(CLI::App& program)
    : program_(&program),
      command_(add_command(program, "completion",
                           "Write what a shell needs to complete command lines")) {
  add_option(*command_, "SHELL", shell_, "bash|zsh|fish", "The shell")->required();
  command_->footer(
      "Where Kinetri was installed as a package, the shells find their files by themselves. Else:\n"
      "bash: put the output into ~/.local/share/bash-completion/completions/kinetri;\n"
      "zsh: into a file _kinetri in a directory of $fpath; fish: into\n"
      "~/.config/fish/completions/kinetri.fish. For the shell that runs now, see below.\n\n"
      "Example:\n"
      "  kinetri completion bash > kinetri.bash; source ./kinetri.bash\n"
      "  kinetri completion fish | source");
}

Exit_code Completion_command::run() const {
  constexpr std::array writers = {write_bash_completion, write_zsh_completion,
                                  write_fish_completion};
  const std::size_t shell = choice_argument("SHELL", shell_, shells);
  Output_file output("-");
  writers[shell](output.stream(), command_table(*program_));
  output.commit();
  return Exit_code::done;
}

}  // namespace kinetri::app
