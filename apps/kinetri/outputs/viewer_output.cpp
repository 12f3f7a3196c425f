// SPDX-License-Identifier: GPL-3.0-or-later
#include "outputs/viewer_output.h"

#include <algorithm>

namespace kinetri::app {
namespace {

// So many events are played as they are; a longer run is thinned. Of many points more are kept:
// merging saves nothing as long as most edges have changed only once. But a page cannot hold any
// number.
std::size_t most_rows(std::size_t points) {
  constexpr std::size_t enough = 40'000;
  constexpr std::size_t too_many = 400'000;
  return std::clamp(20 * points, enough, too_many);
}

}  // namespace

Viewer_output::Viewer_output(const Any_simulation& simulation, const Run_source& source,
                             double until, const std::string& view) {
  source.describe(settings_);
  settings_.view = view;
  simulation.visit([&]<class Traits>(Simulation_2<Traits>& s) {
    settings_.box = s.options().box;
    settings_.radius = s.options().radius;
    auto recorder = std::make_unique<Recorder<Traits>>(s.triangulation(), until,
                                                       most_rows(source.number_of_points()));
    s.add_observer(*recorder);
    recorder_ = std::move(recorder);
  });
}

void Viewer_output::write(std::ostream& out) const {
  write_viewer_page(out, std::visit([](const auto& r) { return r->recording(); }, recorder_),
                    settings_);
}

}  // namespace kinetri::app
