// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/viewer_output.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "kinetri/observers/encounters.h"

namespace kinetri::app {
namespace {

// The greatest number of events of a page; a longer run is thinned. It is greater for many points,
// since merging saves nothing while most edges have changed only once, but limited by what a
// browser can load.
std::size_t most_rows(std::size_t points) {
  constexpr std::size_t enough = 40'000;
  constexpr std::size_t too_many = 400'000;
  return std::clamp(20 * points, enough, too_many);
}

// A page with more encounters would open too slowly.
constexpr std::size_t most_encounters = 400'000;

// The encounter with times rounded inward. One that has not ended is shown at the end of the run
// too.
Viewer_encounter shown(const Encounter& encounter, const Algebraic_number& now) {
  const double end =
      encounter.end == now ? now.to_double() : -std::numeric_limits<double>::infinity();
  return {encounter.points, encounter.begin.tight_interval().upper,
          std::max(end, encounter.end.tight_interval().lower), encounter.offset};
}

}  // namespace

Viewer_output::Viewer_output(const Any_simulation& simulation, const Run_source& source,
                             double until, const std::string& view, std::optional<double> range) {
  source.describe(settings_);
  settings_.view = view;
  simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    settings_.box = s.options().box;
    settings_.radius = s.options().radius;
    const std::size_t rows = most_rows(s.triangulation().number_of_points());
    auto recorder = std::make_unique<Recorder<Traits>>(s.triangulation(), until, rows);
    s.add_observer(*recorder);
    recorder_ = std::move(recorder);
  });
  if (range) {
    simulation.visit([&](auto& s) { follow_encounters(s, *range); });
  }
}

template <class Traits>
void Viewer_output::follow_encounters(Simulation_2<Traits>& simulation, double range) {
  // std::function must be copyable, hence the shared_ptr.
  encounters_ = [&simulation, observer = std::make_shared<Encounters<Traits>>(simulation, range)] {
    const std::vector<Encounter> encounters = observer->encounters();
    Viewer_encounters result = {observer->range(), {}, encounters.size()};
    if (encounters.size() > most_encounters) return result;
    const Algebraic_number& now = simulation.current_time();
    for (const Encounter& encounter : encounters) result.all.push_back(shown(encounter, now));
    return result;
  };
}

void Viewer_output::write(std::ostream& out) {
  if (encounters_) settings_.encounters = encounters_();
  write_viewer_page(out, std::visit([](const auto& r) { return r->recording(); }, recorder_),
                    settings_);
}

}  // namespace kinetri::app
