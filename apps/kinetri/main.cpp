// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program kinetri: chooses the command, and turns every exception into a message and an exit
// code.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "commands/completion_command.h"
#include "commands/experiment_command.h"
#include "commands/generate_command.h"
#include "commands/manual_command.h"
#include "commands/resume_command.h"
#include "commands/simulate_command.h"
#include "commands/tracks_command.h"
#include "commands/wave_command.h"
#include "io/output_file.h"
#include "kinetri/base/error.h"
#include "kinetri/simulation/simulation_2.h"
#include "kinetri/version.h"

namespace kinetri::app {
namespace {

// The command that the command line got to, and its full name.
struct Command {
  const CLI::App* app;
  std::string name;
};

Command chosen_command(const CLI::App& program) {
  Command command = {&program, "kinetri"};
  for (auto chosen = program.get_subcommands(); !chosen.empty();
       chosen = command.app->get_subcommands()) {
    command = {chosen.back(), command.name + " " + chosen.back()->get_name()};
  }
  return command;
}

// The option, or the argument, that `app` cannot do without and does not have.
std::string missing_problem(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_required() || option->count() > 0) continue;
    const std::string name = option->get_name();
    const std::string type = option->get_type_name();
    const std::string expected = !option->get_positional() ? fmt::format("{} {}", name, type)
                                 : type == "FILE"          ? "a path, or - for standard input"
                                                           : type;
    return fmt::format("{} is missing; expected {}", name, expected);
  }
  return {};
}

// What is wrong with an option that has not exactly one value. CLI11's message begins with its
// name.
std::string mismatch_problem(const CLI::App& app, const std::string& message) {
  const std::string name = message.substr(0, message.find(':'));
  const CLI::Option* const option = app.get_option_no_throw(name);
  const bool is_repeated = option != nullptr && option->count() > 1;
  return fmt::format("{}: {}; expected it once, with one value", name,
                     is_repeated ? "is there more than once" : "has no value");
}

// What is wrong with a command line that CLI11 rejects when it has got to `app`.
std::string usage_problem(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& app = *chosen_command(program).app;
  const std::vector<std::string> rest = app.remaining();
  const auto commands = app.get_subcommands(nullptr);
  if (commands.empty()) {
    if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
      if (rest.empty()) {
        return fmt::format("'{}' is before the command; expected it after",
                           program.remaining(true).front());
      }
      return fmt::format("'{}' is unknown; expected only what --help lists", rest.front());
    }
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
      return mismatch_problem(app, error.what());
    }
    if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing_problem(app);
    if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) {
      return fmt::format("{}; expected both", error.what());
    }
    if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
      return fmt::format("{}; expected one of them", error.what());
    }
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
      return fmt::format("{}; expected it without a value", error.what());
    }
    return error.what();
  }
  std::vector<std::string> storage;
  for (const CLI::App* command : commands) storage.push_back(command->get_name());
  const std::vector<std::string_view> names(storage.begin(), storage.end());
  return fmt::format("{}; expected {}",
                     rest.empty() ? "nothing to do" : fmt::format("'{}' is unknown", rest.front()),
                     alternatives(names));
}

Exit_code report_usage(const CLI::App& program, const std::string& problem) {
  const std::string name = chosen_command(program).name;
  fmt::print(stderr, "{}: {}\nRun '{} --help' for what is possible.\n", name, problem, name);
  return Exit_code::bad_input;
}

Exit_code report(Exit_code code, std::string_view message) {
  fmt::print(stderr, "{}\n", message);
  return code;
}

Exit_code run(int argc, char** argv) {
  CLI::App program("Exact kinetic Delaunay triangulation of moving points in the plane.",
                   "kinetri");
  program.set_version_flag("--version", fmt::format("kinetri {}", version));
  program.require_subcommand(1);
  program.footer(
      "Example:\n"
      "  kinetri generate uniform --points 100 --seed 1 > points.csv\n"
      "  kinetri simulate points.csv --until 10 --events events.csv --audit end");
  Generate_command generate(program);
  Simulate_command simulate(program);
  Resume_command resume(program);
  Tracks_command tracks(program);
  Wave_command wave(program);
  Experiment_command experiment(program);
  Completion_command completion(program);
  Manual_command manual(program);
  try {
    program.parse(argc, argv);
    if (generate.chosen()) return generate.run();
    if (simulate.chosen()) return simulate.run();
    if (resume.chosen()) return resume.run();
    if (tracks.chosen()) return tracks.run();
    if (wave.chosen()) return wave.run();
    if (experiment.chosen()) return experiment.run();
    return completion.chosen() ? completion.run() : manual.run();
  } catch (const CLI::Success& success) {
    program.exit(success, std::cout, std::cerr);
    return Exit_code::done;
  } catch (const CLI::ParseError& error) {
    return report_usage(program, usage_problem(program, error));
  } catch (const Usage_error& error) {
    return report_usage(program, error.what());
  }
}

Exit_code guarded_run(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Input_error& error) {
    return report(Exit_code::bad_input, error.what());
  } catch (const Output_error& error) {
    return report(Exit_code::bad_input, error.what());
  } catch (const Endless_contacts_error& error) {
    return report(Exit_code::bad_input, fmt::format("kinetri: {}", error.what()));
  } catch (const std::bad_alloc&) {
    return report(Exit_code::bad_input,
                  "kinetri: there is not enough memory; expected fewer points, or more memory");
  } catch (const Internal_error& error) {
    return report(Exit_code::internal_error, fmt::format("kinetri: {}", error.what()));
  } catch (const std::exception& error) {
    return report(Exit_code::internal_error,
                  fmt::format("kinetri: unexpected error: {}; please report this with the input "
                              "that caused it",
                              error.what()));
  }
}

}  // namespace
}  // namespace kinetri::app

int main(int argc, char** argv) {
  kinetri::app::install_signal_handlers();
  return static_cast<int>(kinetri::app::guarded_run(argc, argv));
}
