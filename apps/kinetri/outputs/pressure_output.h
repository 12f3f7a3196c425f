// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mean pressure in a periodic box between regular times.
#ifndef KINETRI_APPS_PRESSURE_OUTPUT_H
#define KINETRI_APPS_PRESSURE_OUTPUT_H

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/observers/mean_pressure.h"
#include "runs/run_settings.h"
#include "sources/any_simulation.h"

namespace kinetri::app {

/// A table with a row for each interval between two frames, and for the rest after the last one.
class Pressure_output {
 public:
  /// Without a rate there are 100 intervals.
  explicit Pressure_output(std::optional<Frame_rate> rate) : rate_(std::move(rate)) {}

  /// Chooses the times from now to `until`, measures from now on, and writes the header. Throws
  /// Usage_error in the plane, and if there are too many times. The simulation must outlive this
  /// object.
  void start(std::ostream& out, const Any_simulation& simulation, double until);

  /// The time at which the next interval ends; none after the last.
  std::optional<double> next_time() const;

  /// Writes the row of the interval that ends at next_time(). Precondition: that is the time of the
  /// simulation.
  void write(std::ostream& out);

 private:
  std::optional<Frame_rate> rate_;
  std::vector<double> times_;  // the first is the start
  std::size_t next_ = 1;
  std::function<Pressure_2()> measure_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_PRESSURE_OUTPUT_H
