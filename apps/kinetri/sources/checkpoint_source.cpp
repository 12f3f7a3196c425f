// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/checkpoint_source.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "cli/arguments.h"
#include "cli/text.h"
#include "kinetri/impl/io/checkpoint_logs.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/checkpoint_file.h"
#include "sources/any_simulation.h"

namespace kinetri::app {
namespace {

class Checkpoint_source final : public Run_source {
 public:
  Checkpoint_source(std::string path, std::optional<double> until)
      : path_(std::move(path)), until_(until) {}

  std::string path() const override { return path_; }
  void read() override;
  void expect_logs(const std::vector<std::string>& replaced) override;
  std::size_t number_of_points() const override;
  double from() const override { return time().to_double(); }
  std::optional<double> until() const override { return until_; }
  std::string response() const override { return checkpoint_.response; }
  Any_simulation make_simulation(Arithmetic arithmetic) const override;
  std::vector<std::string> remarks() const override;

 private:
  const Algebraic_number& time() const {
    return std::visit(
        [](const auto& snapshot) -> auto& { return snapshot.triangulation.time; },
        checkpoint_.simulation);
  }

  std::string path_;
  std::optional<double> until_;
  Checkpoint checkpoint_;
  std::vector<std::string> missing_;  // of its logs
};

void Checkpoint_source::read() {
  checkpoint_ = read_checkpoint_file(path_);
  if (until_ && time() > Algebraic_number(*until_)) {
    throw Usage_error(joined("--until: ", *until_, " is before the time of ", input_name(path_),
                             "; expected at least ", time().tight_interval().upper));
  }
}

void Checkpoint_source::expect_logs(const std::vector<std::string>& replaced) {
  for (const Checkpoint_log& log : checkpoint_.logs) {
    const std::filesystem::path path = path_of(log, path_);
    std::error_code ignored;
    const std::string identity =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored)
            .string();
    if (std::ranges::find(replaced, identity) != replaced.end()) continue;
    if (!expect_log(log, path_)) {
      missing_.push_back(
          joined(path.string(), ", which --", log.output, " wrote, is not there to be compared"));
    }
  }
}

std::size_t Checkpoint_source::number_of_points() const {
  return std::visit(
      [](const auto& snapshot) {
        return static_cast<std::size_t>(std::ranges::count_if(
            snapshot.triangulation.motions, [](const auto& motion) { return motion.has_value(); }));
      },
      checkpoint_.simulation);
}

Any_simulation Checkpoint_source::make_simulation(Arithmetic arithmetic) const {
  const auto* const response = std::ranges::find(
      named_responses, std::string_view(checkpoint_.response), &Named_response::name);
  const auto fail = [this](const std::string& problem) -> Input_error {
    return {input_name(path_), 0, problem + "; expected a checkpoint as kinetri writes it"};
  };
  if (response == named_responses.end()) {
    throw fail(joined("the response '", checkpoint_.response, "' is unknown"));
  }
  const auto restored = [&]<class Traits>(const Simulation_snapshot<Traits>& snapshot) {
    if ((response->response != nullptr) != snapshot.has_response) {
      throw fail(joined("the response '", response->name, "' does not match the state"));
    }
    using Simulation = Simulation_2<Traits>;
    const auto traits = [&] {
      if constexpr (PeriodicKineticTraits_2<Traits>) {
        return Traits(*checkpoint_.periodic_box, arithmetic);
      } else {
        return Traits(arithmetic);
      }
    };
    return Any_simulation(std::unique_ptr<Simulation>(
        new Simulation(Simulation::restore(snapshot, response->response, traits()))));
  };
  try {
    return std::visit(restored, checkpoint_.simulation);
  } catch (const Snapshot_error& error) {
    throw fail(error.what());
  } catch (const Periodic_box_error& error) {  // a point is too far away
    throw fail(error.what());
  }
}

std::vector<std::string> Checkpoint_source::remarks() const {
  const auto events = std::visit(
      [](const auto& snapshot) { return snapshot.triangulation.counters.number_of_events(); },
      checkpoint_.simulation);
  std::vector<std::string> result = missing_;
  result.push_back(
      joined("taken up after ", counted(events, "event"), "; counts go on from there"));
  return result;
}

}  // namespace

std::unique_ptr<Run_source> checkpoint_source(const std::string& path,
                                              std::optional<double> until) {
  return std::make_unique<Checkpoint_source>(path, until);
}

}  // namespace kinetri::app
