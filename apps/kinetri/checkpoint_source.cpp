// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "arguments.h"

namespace kinetri::app {

void Checkpoint_source::read() {
  checkpoint_ = read_checkpoint_file(path_);
  if (time() > Algebraic_number(until_)) {
    throw Usage_error(fmt::format("--until: {} is before the time of {}; expected at least {}",
                                  until_, input_name(path_), time().tight_interval().upper));
  }
}

std::size_t Checkpoint_source::number_of_points() const {
  const auto& motions = checkpoint_.simulation.triangulation.motions;
  return static_cast<std::size_t>(
      std::ranges::count_if(motions, [](const auto& motion) { return motion.has_value(); }));
}

std::unique_ptr<Simulation_2<>> Checkpoint_source::make_simulation(Arithmetic arithmetic) const {
  const auto* const response = std::ranges::find(
      named_responses, std::string_view(checkpoint_.response), &Named_response::name);
  const auto fail = [this](const std::string& problem) -> Input_error {
    return {input_name(path_), 0, problem + "; expected a checkpoint as kinetri writes it"};
  };
  if (response == named_responses.end()) {
    throw fail(fmt::format("the response '{}' is unknown", checkpoint_.response));
  }
  if ((response->response != nullptr) != checkpoint_.simulation.has_response) {
    throw fail(fmt::format("the response '{}' does not go with the state", response->name));
  }
  try {
    return std::make_unique<Simulation_2<>>(checkpoint_.simulation, response->response,
                                            Linear_kinetic_traits_2(arithmetic));
  } catch (const Snapshot_error& error) {
    throw fail(error.what());
  }
}

Input_error Checkpoint_source::coincidence(const Coincident_trajectories_error& error,
                                           double time) const {
  return Input_error(
      input_name(path_), 0,
      fmt::format("at t = {} a contact leaves points {} and {} in one place with one velocity; "
                  "expected trajectories that stay distinct",
                  time, error.first(), error.second()));
}

std::vector<std::string> Checkpoint_source::remarks() const {
  return {fmt::format("taken up after {} events; counts go on from there",
                      checkpoint_.simulation.triangulation.counters.number_of_events())};
}

}  // namespace kinetri::app
