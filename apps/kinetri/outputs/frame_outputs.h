// SPDX-License-Identifier: GPL-3.0-or-later
//
// Frames of a run at regular times: pictures, and files for ParaView and VTK.
#ifndef KINETRI_APPS_FRAME_OUTPUTS_H
#define KINETRI_APPS_FRAME_OUTPUTS_H

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "kinetri/impl/io/output_directory.h"
#include "kinetri/io/svg_frame.h"
#include "kinetri/io/vtu_file.h"
#include "outputs/run_outputs.h"
#include "runs/run_settings.h"
#include "sources/any_simulation.h"
#include "sources/run_source.h"

namespace kinetri::app {

/// The frames: frame_000000.svg and so on in one directory, frame_000000.vtu and so on and
/// frames.pvd in the other.
class Frame_outputs {
 public:
  /// Each directory may be null; both must outlive this object. Without a rate there are 101
  /// frames.
  Frame_outputs(Output_directory* svg, Output_directory* vtu, std::optional<Frame_rate> rate)
      : svg_(svg), vtu_(vtu), rate_(std::move(rate)) {}

  /// Chooses the times, from the first binary64 number that is not before the start on, and what
  /// the pictures show. Throws Usage_error if there are too many frames.
  void start(const Run_source& source, const Any_simulation& simulation, double until);

  /// The time of the next frame; none after the last.
  std::optional<double> next_time() const;

  /// Writes the next frame. Throws Output_error. Precondition: next_time() is the time of the
  /// simulation.
  void write(const Any_simulation& simulation);

  /// Writes frames.pvd, the list of all frames so far.
  void finish();

 private:
  Output_directory* svg_;
  Output_directory* vtu_;
  std::optional<Frame_rate> rate_;
  std::vector<double> times_;
  std::size_t next_ = 0;
  Svg_view view_;
  std::vector<Vtu_frame> series_;
};

/// The frames of these outputs; none if no frames are written.
std::optional<Frame_outputs> frame_outputs(Run_outputs& outputs,
                                           const std::optional<Frame_rate>& rate);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_FRAME_OUTPUTS_H
