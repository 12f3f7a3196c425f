// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/checkpoint_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/arguments.h"

namespace kinetri::app {

void Checkpoint_source::read() {
  checkpoint_ = read_checkpoint_file(path_);
  if (time() > Algebraic_number(until_)) {
    throw Usage_error(fmt::format("--until: {} is before the time of {}; expected at least {}",
                                  until_, input_name(path_), time().tight_interval().upper));
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
    throw fail(fmt::format("the response '{}' is unknown", checkpoint_.response));
  }
  const auto restored = [&]<class Traits>(const Simulation_snapshot<Traits>& snapshot) {
    if ((response->response != nullptr) != snapshot.has_response) {
      throw fail(fmt::format("the response '{}' does not go with the state", response->name));
    }
    return Any_simulation(
        std::make_unique<Simulation_2<Traits>>(snapshot, response->response, Traits(arithmetic)));
  };
  try {
    return std::visit(restored, checkpoint_.simulation);
  } catch (const Snapshot_error& error) {
    throw fail(error.what());
  }
}

std::vector<std::string> Checkpoint_source::remarks() const {
  const auto events = std::visit(
      [](const auto& snapshot) { return snapshot.triangulation.counters.number_of_events(); },
      checkpoint_.simulation);
  return {fmt::format("taken up after {} events; counts go on from there", events)};
}

}  // namespace kinetri::app
