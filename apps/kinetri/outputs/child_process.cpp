// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "cli/interrupt.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/output_file.h"
#include "kinetri/impl/io/text.h"

extern char** environ;

namespace kinetri::app {

Nameless_file nameless_file() {
  Nameless_file file(std::tmpfile());
  // On some systems tmpfile() sets FD_CLOEXEC.
  if (file && ::fcntl(::fileno(file.get()), F_SETFD, 0) == 0) return file;
  throw Output_error(
      joined("/tmp: no temporary file can be made: ", std::generic_category().message(errno),
             "; expected a directory in which files can be created"));
}

std::string path_of(const Nameless_file& file) {
  return joined("/dev/fd/", ::fileno(file.get()));
}

std::optional<int> run_child(const std::string& program, std::vector<std::string> arguments,
                             const std::array<int, 3>& streams) {
  std::string name = program;
  std::vector<char*> words = {name.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int i = 0; i < 3; ++i) {
    posix_spawn_file_actions_adddup2(&actions, streams[static_cast<std::size_t>(i)], i);
  }
  pid_t child = 0;
  const int failure =
      ::posix_spawnp(&child, name.c_str(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return std::nullopt;
  const Child_section ends_with_this_process(child);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string content(const Nameless_file& file) {
  std::string text;
  std::rewind(file.get());
  std::array<char, 4096> buffer;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    text.append(buffer.data(), n);
  }
  return text;
}

Tool_result run_tool(const std::string& program, std::vector<std::string> arguments,
                     const std::string& input) {
  const Nameless_file in = nameless_file();
  const Nameless_file out = nameless_file();
  const Nameless_file err = nameless_file();
  const bool is_written = std::fwrite(input.data(), 1, input.size(), in.get()) == input.size() &&
                          std::fflush(in.get()) == 0;
  if (!is_written) {
    throw Output_error(program + ": its input cannot be kept; expected space for temporary files");
  }
  std::rewind(in.get());
  const auto status = run_child(program, std::move(arguments),
                                {::fileno(in.get()), ::fileno(out.get()), ::fileno(err.get())});
  if (!status) return {};
  return {true, *status, content(out), content(err)};
}

}  // namespace kinetri::app
