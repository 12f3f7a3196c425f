// SPDX-License-Identifier: GPL-3.0-or-later
//
// The room of each point at regular times.
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

/// What bounds the cells that `option` measures. Reads the walkable area, which may be that of the
/// source. Throws Input_error, and Usage_error if nothing bounds them.
Cell_limits cell_limits(const Answer_settings& settings, const Run_source& source,
                        const char* option);

/// A table with a row for each point and frame. Its last column has the labels of the points, if
/// the source has labels.
class Area_output {
 public:
  /// Without a rate the frames are those of the input, or, if it has none, 101.
  Area_output(std::shared_ptr<const Cell_limits> limits, std::optional<Frame_rate> rate)
      : limits_(std::move(limits)), rate_(std::move(rate)) {}

  /// Chooses the times, from the first binary64 number that is not before the start on. Throws
  /// Usage_error if there are too many frames.
  void start(const Run_source& source, const Any_simulation& simulation, double until);

  /// The time of the next frame, none after the last.
  std::optional<double> next_time() const;

  /// Writes the next frame, the first one below a header. Precondition: next_time() is the time of
  /// the simulation.
  void write(std::ostream& out, const Any_simulation& simulation);

 private:
  std::shared_ptr<const Cell_limits> limits_;
  std::optional<Frame_rate> rate_;
  std::vector<double> times_;
  std::vector<std::string> labels_;  // of the points, if they have any
  std::size_t next_ = 0;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_AREA_OUTPUT_H
