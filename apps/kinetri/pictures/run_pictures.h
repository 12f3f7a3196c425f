// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of a recorded run, as SVG, without a browser. They have the same layers as the page,
// drawn in the same way (viewer/flat_view.js), and the same settings (view_words.h). Edges and
// triangles are those of the recording; positions are rounded.
//
// Changes of the page's picture must be repeated in this folder; viewer/test/exporting.py compares
// the two.
#ifndef KINETRI_APPS_RUN_PICTURES_H
#define KINETRI_APPS_RUN_PICTURES_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pictures/scene.h"

namespace kinetri::app {

struct Picture_options {
  int width = 960;   ///< pixels
  int height = 640;  ///< the same
  bool has_time = false;
  double highlight = 0;  ///< see View
};

/// View words, and their source for messages.
struct View_source {
  std::string name;
  View_words words;
};

class Run_pictures {
 public:
  /// Later sources override earlier ones. `page` must outlive it. Throws Usage_error if a word
  /// names something that the run does not have.
  Run_pictures(const Viewer_page& page, const std::vector<View_source>& sources,
               const Picture_options& options);

  /// The picture at a time. Precondition: the time is within the run.
  std::string at(double time);
  /// The picture just after the first `rows` rows of the recording. Precondition: it has that many.
  std::string after(std::size_t rows);
  /// The picture at the time or event of the sources; by default, at the start.
  std::string first();

 private:
  void follow(const View_source& source);
  void follow_switches(const View_source& source);
  void follow_time(const View_source& source);
  std::string draw();
  void draw_flat(Svg_drawing& drawing, Scene& scene) const;

  const Viewer_page& page_;
  Picture_options options_;
  bool has_weights_;
  bool has_discs_;
  View view_;
  Quantity color_ = Quantity::none;
  std::optional<double> time_;
  std::optional<std::size_t> row_;
  Playback playback_;
  Extents extents_;
  std::optional<Coloring> coloring_;
  std::optional<Heat> heat_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_RUN_PICTURES_H
