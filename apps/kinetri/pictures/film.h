// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures as PNG, and films, made from SVG by two programs that systems package: rsvg-convert
// (librsvg) draws, ffmpeg encodes. Programs, not libraries: cairo alone would draw PNG but no film,
// and the SVG, which is the exact picture, would have to be drawn by a second painter; so one
// painter is enough, the program needs nothing more to be built, and where only SVG is asked for
// nothing more to be run. Drawings and frames go to them through files without names, which are
// gone however the process ends.
#ifndef KINETRI_APPS_FILM_H
#define KINETRI_APPS_FILM_H

#include <iosfwd>
#include <string>
#include <string_view>

#include "outputs/child_process.h"

namespace kinetri::app {

/// Throws Usage_error if rsvg-convert, or for a film ffmpeg, cannot be run. `otherwise` is what the
/// command line may say so that it is not needed.
void require_drawing_tool(std::string_view otherwise);
void require_film_tool(std::string_view otherwise);

/// The drawing as PNG; a pixel of the one is a pixel of the other. Throws Output_error.
std::string png_of(const std::string& svg);

enum class Film_format { gif, webp, webm, mp4 };

/// Frames of one size, one after the other.
class Film {
 public:
  Film() : frames_(nameless_file()) {}

  /// Adds a frame. Cost: an execution of rsvg-convert. Throws Output_error.
  void add(const std::string& svg);

  /// The film, with so many frames a second. The same frames make the same bytes with the same
  /// ffmpeg. Throws Output_error. Precondition: there is a frame, and the frames are of an even
  /// width and height if the format is webm or mp4.
  std::string encoded(Film_format format, double frames_per_second) const;

 private:
  Nameless_file frames_;  // as PNG, one behind the other
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_FILM_H
