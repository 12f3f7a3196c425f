// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_options.h"

#include <CLI/CLI.hpp>
#include <array>
#include <string_view>

#include "arguments.h"

namespace kinetri::app {
namespace {

// In the order of the enumerators that they name.
constexpr std::array<std::string_view, 3> audit_modes = {"none", "end", "events"};
constexpr std::array<std::string_view, 3> progress_modes = {"auto", "always", "never"};

}  // namespace

void Run_options::add_to(CLI::App& command) {
  const auto add = [&command](const char* option, auto& value, const char* type, const char* help) {
    command.add_option(option, value, help)->type_name(type);
  };
  add("--events", events_, "FILE", "Write the events here; - is standard output");
  add("--initial-edges", initial_edges_, "FILE", "Write the edges just after the start here");
  add("--edges", edges_, "FILE", "Write the edges at the end here");
  add("--stats", stats_, "FILE", "Write counts and times here, as JSON");
  add("--audit", audit_, "none|end|events",
      "Check everything exactly: never (default), at the end, or after every event too (there "
      "without "
      "recomputing all failure times)");
  command.add_flag(
      "--exact-only", exact_only_,
      "Decide everything by exact arithmetic, without filters: the same events, slower");
  add("--progress", progress_, "auto|always|never",
      "Show a progress line; auto (default): on a terminal");
  command.add_flag("--quiet", quiet_, "Neither a progress line nor a summary");
}

void Run_options::add_checkpoint_to(CLI::App& command) {
  command
      .add_option("--checkpoint", checkpoint_,
                  "Write the state at the end here, for kinetri resume; when interrupted, too")
      ->type_name("FILE");
}

Run_settings Run_options::settings() const {
  Run_settings result;
  result.events = events_;
  result.initial_edges = initial_edges_;
  result.edges = edges_;
  result.stats = stats_;
  result.checkpoint = checkpoint_;
  result.audit = static_cast<Audit_mode>(choice_argument("--audit", audit_, audit_modes));
  if (exact_only_) result.arithmetic = Arithmetic::exact_only;
  result.progress =
      static_cast<Progress_mode>(choice_argument("--progress", progress_, progress_modes));
  if (quiet_) result.progress = Progress_mode::never;
  result.quiet = quiet_;
  return result;
}

}  // namespace kinetri::app
