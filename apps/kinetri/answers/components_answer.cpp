// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <string>
#include <vector>

#include "answers/table_answer.h"
#include "cli/arguments.h"
#include "kinetri/impl/io/input_text.h"

namespace kinetri::app {
namespace {

// Calls `follow` if the simulation is one of points without radii.
template <class Traits, class Follow>
std::unique_ptr<Answer> of_points(const char* option, Simulation_2<Traits>& simulation,
                                  const Follow& follow) {
  if constexpr (!HasWeight<typename Traits::Motion>) {
    if (simulation.options().radius == 0) return follow(simulation);
  }
  throw Usage_error(
      joined(option, ": distances between discs are not supported; expected points without radii"));
}

// The points with this name in the input.
std::vector<Point_id> points_named(const std::string& name, const Run_source& source,
                                   Point_id next_id) {
  std::vector<Point_id> result = source.points_named(name);
  std::erase_if(result, [&](Point_id id) { return id >= next_id; });
  if (!result.empty()) return result;
  throw Usage_error(joined("--between: there is no point ", kinetri::in_quotes(name), " in ",
                           input_name(source.path()), "; expected ", source.expected_name()));
}

// All pairs of points with these names that may exist at the same time.
std::vector<Edge_ids> pairs_of_points(const std::array<std::string, 2>& names,
                                      const Run_source& source, Point_id next_id) {
  std::vector<Edge_ids> result;
  const std::vector<Point_id> first = points_named(names[0], source, next_id);
  const std::vector<Point_id> second = points_named(names[1], source, next_id);
  for (const Point_id a : first) {
    for (const Point_id b : second) {
      if (a == b) {
        throw Usage_error(joined("--between: ", kinetri::in_quotes(names[0]), " and ",
                                 kinetri::in_quotes(names[1]),
                                 " are the same; expected two that differ"));
      }
      if (source.are_there_together(a, b)) result.push_back({a, b});
    }
  }
  return result;
}

}  // namespace

std::unique_ptr<Answer> components_answer(const Answer_settings& settings,
                                          const Any_simulation& simulation,
                                          const Run_source& source) {
  return simulation.visit([&](auto& any) {
    return of_points("--components", any, [&]<class Traits>(Simulation_2<Traits>& s) {
      return table_answer<Connected_components<Traits>>(
          source, detail::Component_columns{PeriodicKineticTraits_2<Traits>}, s, settings.range);
    });
  });
}

std::unique_ptr<Answer> connected_answer(const Answer_settings& settings,
                                         const Any_simulation& simulation,
                                         const Run_source& source) {
  return simulation.visit([&](auto& any) {
    return of_points("--connected", any, [&]<class Traits>(Simulation_2<Traits>& s) {
      std::vector<std::vector<Edge_ids>> pairs;
      for (const auto& names : settings.between) {
        pairs.push_back(pairs_of_points(names, source, s.triangulation().next_id()));
      }
      return table_answer<detail::Connections<Traits>>(
          source, detail::Connection_columns<std::string>{settings.between}, s, settings.range,
          pairs);
    });
  });
}

}  // namespace kinetri::app
