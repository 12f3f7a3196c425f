// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/arguments.h"
#include "cli/spelling.h"
#include "cli/text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

using Request = Invocation::Request;

CLI::Option* declare_option(CLI::App& app, const Option& option) {
  const std::string names = separated(option.names, ",");
  return std::visit(
      [&](auto* target) -> CLI::Option* {
        if constexpr (std::is_same_v<decltype(target), bool*>) {
          // CLI11 has added --help and --version itself.
          return target == nullptr ? app.get_option(option.name()) : app.add_flag(names, *target);
        } else if constexpr (std::is_same_v<decltype(target), std::vector<std::string>*>) {
          return app.add_option(names, *target)->allow_extra_args(false);  // one value each time
        } else {
          return app.add_option(names, *target);
        }
      },
      option.target);
}

void declare(CLI::App& app, const Command& command) {
  for (const Option& option : command.options) {
    declare_option(app, option)->required(option.required && option.alternative.empty());
  }
  for (const Option& option : command.options) {
    CLI::Option* const declared = app.get_option(option.name());
    if (!option.needs.empty()) declared->needs(app.get_option(option.needs));
    if (!option.excludes.empty()) declared->excludes(app.get_option(option.excludes));
  }
  for (const Command& inner : command.commands) declare(*app.add_subcommand(inner.name), inner);
  if (!command.commands.empty()) app.require_subcommand(1);
}

// The command that the command line names.
struct Chosen {
  const CLI::App* app;
  const Command* command;
  std::string name;
};

Chosen chosen_command(const CLI::App& app, const Command& program) {
  Chosen result = {&app, &program, program.name};
  for (auto next = app.get_subcommands(); !next.empty(); next = result.app->get_subcommands()) {
    const std::string name = next.back()->get_name();
    result = {next.back(), result.command->find_command(name), result.name + " " + name};
  }
  return result;
}

std::vector<std::string> names_of_commands(const Command& command) {
  std::vector<std::string> result;
  for (const Command& inner : command.commands) result.push_back(inner.name);
  return result;
}

std::vector<std::string> names_of_options(const Command& command) {
  std::vector<std::string> result;
  for (const Option& option : command.options) {
    if (!option.positional()) result.push_back(option.name());
  }
  return result;
}

// The message for a word that is not known to `command`.
std::string unknown_problem(const std::string& word, const Command& command) {
  const bool is_option = word.starts_with('-');
  const std::vector<std::string> names =
      is_option ? names_of_options(command) : names_of_commands(command);
  if (const std::string_view near = nearest_name(word, names); !near.empty()) {
    return joined("'", word, "' is unknown; did you mean ", near, "?");
  }
  const std::string expected = command.commands.empty() ? "only what --help lists"
                                                        : alternatives(names_of_commands(command));
  return joined("'", word, "' is unknown; expected ", expected);
}

// The message for a required option or argument that is missing.
std::string missing_problem(const Chosen& chosen) {
  for (const Option& option : chosen.command->options) {
    if (!option.required || chosen.app->get_option(option.name())->count() > 0) continue;
    const std::string expected = !option.positional()    ? option.name() + " " + option.type
                                 : option.type == "FILE" ? "a path, or - for a pipe"
                                                         : option.type;
    return joined(option.name(), " is missing; expected ", expected);
  }
  return {};
}

// The message for an option that does not have exactly one value. CLI11's message begins with its
// name.
std::string mismatch_problem(const CLI::App& app, const std::string& message) {
  const std::string name = message.substr(0, message.find(':'));
  const CLI::Option* const option = app.get_option_no_throw(name);
  if (option != nullptr && option->get_items_expected_max() > 1) {
    return joined(name, ": has no value; expected one each time");
  }
  const bool is_repeated = option != nullptr && option->count() > 1;
  return joined(name, ": ", is_repeated ? "is given more than once" : "has no value",
                "; expected it once, with one value");
}

// The message for a command line that CLI11 rejects.
std::string usage_problem(const CLI::App& program, const Chosen& chosen,
                          const CLI::ParseError& error) {
  // Unknown words first: one may be a misspelling of a missing option.
  if (const auto rest = chosen.app->remaining(); !rest.empty()) {
    const auto option = std::find_if(rest.begin(), rest.end(), [](const std::string& word) {
      return word.size() > 1 && word.starts_with('-');
    });
    return unknown_problem(option == rest.end() ? rest.front() : *option, *chosen.command);
  }
  if (!chosen.command->commands.empty()) {
    return "nothing to do; expected " + alternatives(names_of_commands(*chosen.command));
  }
  if (const auto rest = program.remaining(true); !rest.empty()) {
    return joined("'", rest.front(), "' is before the command; expected it after");
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    return mismatch_problem(*chosen.app, error.what());
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) return missing_problem(chosen);
  const std::string problem = error.what();
  if (dynamic_cast<const CLI::RequiresError*>(&error) != nullptr) {
    return problem + "; expected both";
  }
  if (dynamic_cast<const CLI::ExcludesError*>(&error) != nullptr) {
    return problem + "; expected one of them";
  }
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
    return problem + "; expected it without a value";
  }
  return problem;
}

// `kinetri help generate uniform`.
Invocation help_for(const Command& program, int count, const char* const* words) {
  Invocation result = {&program, program.name, Request::help};
  for (int i = 0; i < count; ++i) {
    const Command* const inner = result.command->find_command(words[i]);
    if (inner == nullptr) {
      return {program.find_command("help"), program.name + " help", Request::nothing,
              unknown_problem(words[i], *result.command)};
    }
    result.command = inner;
    result.name += " " + inner->name;
  }
  return result;
}

}  // namespace

Invocation parse(const Command& program, int argc, const char* const* argv) {
  const bool asks_for_help = argc > 1 && std::string_view(argv[1]) == "help" &&
                             (argc == 2 || !std::string_view(argv[2]).starts_with('-'));
  if (asks_for_help) return help_for(program, argc - 2, argv + 2);

  CLI::App app("", program.name);
  app.set_version_flag("--version", std::string());
  declare(app, program);
  Invocation result = {&program, program.name, Request::run};
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion&) {
    result.request = Request::version;
  } catch (const CLI::Success&) {
    result.request = Request::help;
  } catch (const CLI::ParseError& error) {
    result.request = Request::nothing;
    result.problem = usage_problem(app, chosen_command(app, program), error);
  }
  const Chosen chosen = chosen_command(app, program);
  result.command = chosen.command;
  result.name = chosen.name;
  return result;
}

}  // namespace kinetri::app
