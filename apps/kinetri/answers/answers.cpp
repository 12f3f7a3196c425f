// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "answers/answer.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

struct Answer_row {
  Output output;
  std::unique_ptr<Answer> (*follow)(const Answer_settings&, const Any_simulation&,
                                    const Run_source&);
};

constexpr std::array<Answer_row, 10> answers = {{
    {Output::closest, &closest_answer},
    {Output::neighbors, &neighbors_answer},
    {Output::exchanges, &exchanges_answer},
    {Output::nearest, &nearest_answer},
    {Output::components, &components_answer},
    {Output::connected, &connected_answer},
    {Output::spanning_tree, &spanning_tree_answer},
    {Output::mean_areas, &mean_areas_answer},
    {Output::encounters, &encounters_answer},
    {Output::contact_plan, &contact_plan_answer},
}};

}  // namespace

std::vector<Followed_answer> follow_answers(Run_outputs& outputs, const Answer_settings& settings,
                                            const Any_simulation& simulation,
                                            const Run_source& source) {
  std::vector<Followed_answer> result;
  for (const auto& [output, follow] : answers) {
    if (outputs.has(output)) result.push_back({output, follow(settings, simulation, source)});
  }
  return result;
}

std::string time_bounds(const Algebraic_number& time) {
  const auto [lower, upper] = time.tight_interval();
  return joined(lower, ",", upper);
}

}  // namespace kinetri::app
