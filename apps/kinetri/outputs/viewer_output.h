// SPDX-License-Identifier: GPL-3.0-or-later
//
// The page that plays a run.
#ifndef KINETRI_APPS_VIEWER_OUTPUT_H
#define KINETRI_APPS_VIEWER_OUTPUT_H

#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "kinetri/io/viewer_page.h"
#include "kinetri/simulation/recording.h"
#include "sources/any_simulation.h"
#include "sources/run_source.h"

namespace kinetri::app {

/// Records a run from its construction on. The simulation must outlive it.
class Viewer_output {
 public:
  /// `view`: what the page shows first, see Viewer_settings. With a `range`, the page has the
  /// encounters too.
  Viewer_output(const Any_simulation& simulation, const Run_source& source, double until,
                const std::string& view, std::optional<double> range);

  /// Writes the page of the run up to now.
  void write(std::ostream& out);

 private:
  template <class Traits>
  using Recorder_of = std::unique_ptr<Recorder<Traits>>;

  template <class Traits>
  void follow_encounters(Simulation_2<Traits>& simulation, double range);

  Viewer_settings settings_;
  std::variant<Recorder_of<Linear_kinetic_traits_2>, Recorder_of<Polynomial_kinetic_traits_2>,
               Recorder_of<Disc_kinetic_traits_2>, Recorder_of<Polynomial_disc_kinetic_traits_2>,
               Recorder_of<Periodic_kinetic_traits_2>, Recorder_of<Periodic_disc_kinetic_traits_2>>
      recorder_;
  std::function<Viewer_encounters()> encounters_;  // up to now; empty if there is no range
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_VIEWER_OUTPUT_H
