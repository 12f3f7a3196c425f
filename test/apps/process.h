// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a program as a user would: arguments in, exit code and both outputs out.
#ifndef KINETRI_TEST_APPS_PROCESS_H
#define KINETRI_TEST_APPS_PROCESS_H

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support/temporary_directory.h"

namespace kinetri::test {

/// How a process ended. The exit code is minus the signal's number if a signal ended it.
struct Outcome {
  int exit_code = 0;
  std::string out;
  std::string err;
};

struct Process_input {
  std::string directory = ".";
  std::string standard_input = "/dev/null";
  std::string standard_output = {};           ///< a file; if empty it is captured
  std::vector<std::string> environment = {};  ///< NAME=value, added to this process's
  bool ignores_hangup = false;                ///< as nohup has it
};

/// A process that was started. It is killed if it has not ended after two minutes.
class Process {
 public:
  Process(std::string program, std::vector<std::string> arguments, const Process_input& input) {
    const std::string out =
        input.standard_output.empty() ? captured_.file("out") : input.standard_output;
    const std::string err = captured_.file("err");
    std::vector<char*> argv = {program.data()};
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    id_ = ::fork();
    if (id_ < 0) throw std::runtime_error("cannot fork");
    if (id_ > 0) return;
    // In the child: nothing may return.
    constexpr unsigned seconds = 120;
    ::alarm(seconds);
    ::signal(SIGHUP, input.ignores_hangup ? SIG_IGN : SIG_DFL);
    for (const std::string& variable : input.environment) {
      const std::size_t equals = variable.find('=');
      ::setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
    }
    const bool ready = ::chdir(input.directory.c_str()) == 0 &&
                       redirect(STDIN_FILENO, input.standard_input, O_RDONLY) &&
                       redirect(STDOUT_FILENO, out, O_WRONLY | O_CREAT) &&
                       redirect(STDERR_FILENO, err, O_WRONLY | O_CREAT);
    if (ready) ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }
  ~Process() {
    if (id_ <= 0) return;
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal) const { ::kill(id_, signal); }

  /// Sends two signals so that the process does nothing between them, however long this one has to
  /// wait for a processor: it is stopped until both are there. Fails if it has ended.
  void send_both(int first, int second) {
    send(SIGSTOP);
    int status = 0;
    if (::waitpid(id_, &status, WUNTRACED) != id_ || !WIFSTOPPED(status)) {
      id_ = 0;
      throw std::runtime_error("the process ended early: " + errors_so_far());
    }
    send(first);
    send(second);
    send(SIGCONT);
  }

  /// What it has written to standard error so far.
  std::string errors_so_far() const {
    return std::filesystem::exists(captured_.file("err")) ? read_file(captured_.file("err")) : "";
  }

  /// Waits until `condition` holds. Fails after a minute, or if the process ends before.
  void wait_until(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      int status = 0;
      if (::waitpid(id_, &status, WNOHANG) == id_) {
        id_ = 0;
        throw std::runtime_error("the process ended early: " + errors_so_far());
      }
      if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waited too long");
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  }

  Outcome wait() {
    int status = 0;
    ::waitpid(id_, &status, 0);
    id_ = 0;
    const std::string out = captured_.file("out");
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
            std::filesystem::exists(out) ? read_file(out) : "", errors_so_far()};
  }

 private:
  static bool redirect(int descriptor, const std::string& path, int flags) {
    const int opened = ::open(path.c_str(), flags, 0600);
    return opened >= 0 && ::dup2(opened, descriptor) == descriptor && ::close(opened) == 0;
  }

  Temporary_directory captured_;
  pid_t id_ = 0;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_APPS_PROCESS_H
