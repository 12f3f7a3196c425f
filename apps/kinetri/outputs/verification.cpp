// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/verification.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <concepts>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "cli/arguments.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"
#include "outputs/edge_output.h"
#include "outputs/motion_output.h"
#include "sources/run_source.h"

namespace kinetri::app {
namespace {

namespace fs = std::filesystem;

std::string path_of_verifier() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return "kinetri-verify";  // without /proc, PATH may contain it
  const fs::path path = program.parent_path() / "kinetri-verify";
  if (::access(path.c_str(), X_OK) == 0) return path.string();
  throw Usage_error(
      joined("--verify: ", path.string(),
             " cannot be executed; expected the program kinetri-verify, which is built and "
             "installed with kinetri"));
}

// Whether the output can be read after the run.
bool is_lasting(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return path != "-" && (!fs::exists(status) || fs::is_regular_file(status));
}

// Whether the points move linearly and have no contacts.
bool is_plain(const Any_simulation& simulation) {
  return simulation.visit([]<class Traits>(const Simulation_2<Traits>& s) {
    return std::same_as<typename Traits::Motion, Linear_motion_2> && !s.options().box &&
           !s.options().response;
  });
}

// The current time rounded up to a binary64 number. An event lies between the two only if two
// events are that close.
double upper_bound_of_now(const Any_simulation& simulation) {
  return simulation.visit([](const auto& s) { return s.current_time().tight_interval().upper; });
}

// The options for the periodic box; none in the plane.
std::vector<std::string> periodic_options(const Any_simulation& simulation) {
  const std::optional<Periodic_box_2> box = simulation.periodic_box();
  if (!box) return {};
  const auto& [a, a_rate, a_epoch] = box->first();
  const auto& [b, b_rate, b_epoch] = box->second();
  return {"--periodic", joined(a.x, ',', a.y, ',', b.x, ',', b.y),
          "--rates",    joined(a_rate.x, ',', a_rate.y, ',', b_rate.x, ',', b_rate.y),
          "--epochs",   joined(a_epoch, ',', b_epoch)};
}

// The options of the box with walls and of the discs.
std::vector<std::string> options_of(const Any_simulation& simulation, const Run_source& source) {
  std::vector<std::string> result;
  simulation.visit([&](const auto& s) {
    if (!s.options().box) return;
    const auto& [xmin, ymin, xmax, ymax] = *s.options().box;
    result = {"--box", joined(xmin, ',', ymin, ',', xmax, ',', ymax)};
    if (s.options().rim_touches) result.emplace_back("--rim");
  });
  result.insert(result.end(), {"--collisions", source.response()});
  return result;
}

}  // namespace

Verification::Verification(const Output_paths& outputs) : program_(path_of_verifier()) {
  constexpr std::array<Output, number_of_files> of_kind = {Output::events, Output::motions,
                                                           Output::initial_edges, Output::edges};
  for (std::size_t i = 0; i < files_.size(); ++i) {
    File& file = files_[i];
    const auto& output = outputs[of_kind[i]];
    if (output && is_lasting(*output)) {
      file.path = *output;
      continue;
    }
    file.own = nameless_file();
    file.path = path_of(file.own);
    file.stream.open(file.path);
  }
}

void Verification::start(const Any_simulation& simulation) {
  from_ = upper_bound_of_now(simulation);
  if (files_[initial_edges].own) write_present_edges(files_[initial_edges].stream, simulation);
  if (files_[events].own) {
    event_log_.emplace(files_[events].stream, simulation.event_columns());
    simulation.visit([this](auto& s) { s.add_observer(*event_log_); });
  }
  if (files_[motions].own) motion_log_ = follow_motions(files_[motions].stream, simulation);
}

void Verification::finish(const Any_simulation& simulation) {
  if (files_[edges].own) write_present_edges(files_[edges].stream, simulation);
  for (File& file : files_) {
    if (!file.own) continue;
    errno = 0;
    file.stream.close();
    if (file.stream) continue;
    throw Output_error(joined("/tmp: writing a temporary file for --verify failed: ",
                              std::generic_category().message(errno != 0 ? errno : EIO),
                              "; expected space for the logs, or --events, --motions, "
                              "--initial-edges and --edges with files elsewhere"));
  }
}

Exit_code Verification::run(const Any_simulation& simulation, const Run_source& source,
                            Stream answer) const {
  const std::string points_file = source.points_file();
  const bool has_points = !points_file.empty() && is_lasting(points_file);
  std::vector<std::string> arguments = {has_points ? points_file : files_[motions].path,
                                        files_[events].path,
                                        "--from",
                                        joined(from_),
                                        "--until",
                                        joined(upper_bound_of_now(simulation)),
                                        "--initial-edges",
                                        files_[initial_edges].path,
                                        "--edges",
                                        files_[edges].path};
  // Else the points file contains all motions.
  if (!has_points || !is_plain(simulation)) {
    arguments.insert(arguments.end(), {"--motions", files_[motions].path});
  }
  for (const auto& options : {periodic_options(simulation), options_of(simulation, source)}) {
    arguments.insert(arguments.end(), options.begin(), options.end());
  }
  const auto status = run_child(
      program_, arguments,
      {STDIN_FILENO, answer == Stream::output ? STDOUT_FILENO : STDERR_FILENO, STDERR_FILENO});
  if (status && WIFEXITED(*status)) {
    switch (WEXITSTATUS(*status)) {
      case 0:
        return Exit_code::done;
      case 1:
        return Exit_code::audit_failed;
      case 2:
        return Exit_code::bad_input;
      default:
        break;
    }
  }
  report("kinetri", joined(program_,
                           " ended without an answer; expected that it verifies the run, "
                           "or says what is wrong"));
  return Exit_code::internal_error;
}

}  // namespace kinetri::app
