// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pictures of a recorded run, as SVG, without a browser. They have the layers of the page that
// plays the run, drawn in the same way (viewer/flat_view.js), and are asked for in the same words
// (view_words.h). Edges and triangles are those of the recording; places are rounded.
//
// Where the picture of the page is changed, this folder has to be changed too;
// viewer/test/taking.py compares the colors of both.
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

/// A source of words, for messages, and the words.
struct View_source {
  std::string name;
  View_words words;
};

class Run_pictures {
 public:
  /// Later sources count more. `page` must outlive it. Throws Usage_error where the run does not
  /// have what a word names.
  Run_pictures(const Viewer_page& page, const std::vector<View_source>& sources,
               const Picture_options& options);

  /// The picture at a time. Precondition: it is one of the run.
  std::string at(double time);
  /// The picture just after so many rows of the recording. Precondition: there are so many.
  std::string after(std::size_t rows);
  /// The one that the sources ask for; without such words, that of the start.
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
