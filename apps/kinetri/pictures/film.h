// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures as PNG, and films, made from SVG by two programs: rsvg-convert (librsvg) draws, ffmpeg
// encodes. As programs, not libraries, they are needed neither to build kinetri nor to write SVG,
// and one painter, that of SVG, is enough. Drawings and frames are passed in files without names,
// which are deleted however the process ends.
#ifndef KINETRI_APPS_FILM_H
#define KINETRI_APPS_FILM_H

#include <iosfwd>
#include <string>
#include <string_view>

#include "outputs/child_process.h"

namespace kinetri::app {

/// Throws Usage_error if rsvg-convert, or for a film ffmpeg, cannot be run. `otherwise`: how to
/// change the command line so that it is not needed.
void require_drawing_tool(std::string_view otherwise);
void require_film_tool(std::string_view otherwise);

/// The drawing as PNG of the same size in pixels. Throws Output_error.
std::string png_of(const std::string& svg);

enum class Film_format { gif, webp, webm, mp4 };

/// A film of frames of one size.
class Film {
 public:
  Film() : frames_(nameless_file()) {}

  /// Adds a frame. Cost: an execution of rsvg-convert. Throws Output_error.
  void add(const std::string& svg);

  /// The encoded film. The same frames give the same bytes with the same ffmpeg. Throws
  /// Output_error. Precondition: there is a frame, and the frames are of an even width and height
  /// if the format is webm or mp4.
  std::string encoded(Film_format format, double frames_per_second) const;

 private:
  Nameless_file frames_;  // PNG files, concatenated
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_FILM_H
