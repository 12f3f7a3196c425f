// SPDX-License-Identifier: GPL-3.0-or-later
//
// The area of each point at regular times.
#ifndef KINETRI_APPS_AREA_OUTPUT_H
#define KINETRI_APPS_AREA_OUTPUT_H

#include <cstddef>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/answer_settings.h"
#include "kinetri/observers/cell_areas.h"
#include "runs/run_settings.h"
#include "sources/any_simulation.h"
#include "sources/run_source.h"

namespace kinetri::app {

/// The bounds of the cells that `option` measures. Reads the walkable area from its file or the
/// source; a periodic box needs none. Throws Input_error, and Usage_error if cells have no bounds.
Cell_limits cell_limits(const Answer_settings& settings, const Run_source& source, bool is_periodic,
                        const char* option);

/// A table with a row for each point and frame. If the source has labels, the last column contains
/// them.
class Area_output {
 public:
  /// Without a rate the frames are those of the input, or 101 if the input has no frames.
  Area_output(std::shared_ptr<const Cell_limits> limits, std::optional<Frame_rate> rate)
      : limits_(std::move(limits)), rate_(std::move(rate)) {}

  /// Chooses the times of frames, from the least binary64 number not before the start on. Throws
  /// Usage_error if there are too many.
  void start(const Run_source& source, const Any_simulation& simulation, double until);

  /// The time of the next frame; none after the last.
  std::optional<double> next_time() const;

  /// Writes the next frame, and a header before the first one. Precondition: next_time() is the
  /// time of the simulation.
  void write(std::ostream& out, const Any_simulation& simulation);

 private:
  std::shared_ptr<const Cell_limits> limits_;
  std::optional<Frame_rate> rate_;
  std::vector<double> times_;
  std::vector<std::string> labels_;  // of the points; empty if they have none
  std::size_t next_ = 0;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_AREA_OUTPUT_H
