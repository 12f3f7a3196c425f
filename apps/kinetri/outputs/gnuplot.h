// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plots, drawn by the program gnuplot.
#ifndef KINETRI_APPS_GNUPLOT_H
#define KINETRI_APPS_GNUPLOT_H

#include <string>
#include <string_view>

namespace kinetri::app {

/// Throws Usage_error if gnuplot cannot be run. `otherwise`: how to change the command line so that
/// it is not needed.
void require_gnuplot(std::string_view otherwise);

/// A plot in the formats of gnuplot's terminals svg and pngcairo.
struct Plot {
  std::string svg;
  std::string png;
};

/// Draws a plot of `width` x `height` pixels. `script` is gnuplot's input without terminal and
/// output; colors, lines and grid are set up: `linestyle 1` to 6 have colors that color-blind
/// people can distinguish. Throws Output_error with gnuplot's message if it fails.
Plot draw(const std::string& script, int width, int height);

/// As draw, SVG alone.
std::string draw_svg(const std::string& script, int width, int height);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_GNUPLOT_H
