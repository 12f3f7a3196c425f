// SPDX-License-Identifier: GPL-3.0-or-later
//
// The colors of pictures: those of the page (viewer/style.css, viewer/colors.js), in light and
// dark. Colors with a meaning are those of Masataka Okabe and Kei Ito (Color universal design,
// 2008). Numbers are shown by viridis: nine of its colors, evenly spaced, as Stefan van der Walt
// and Nathaniel Smith published them (matplotlib 1.5, 2015), and between them straight lines.
#ifndef KINETRI_APPS_THEME_H
#define KINETRI_APPS_THEME_H

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "pictures/svg_drawing.h"

namespace kinetri::app {

struct Theme {
  Color background, text, quiet, edge, edge_behind, hull, point, box, disc, disc_fill, trail,
      voronoi, removed, added, selected, selected_fill, arrow, link, wave_edge, wave_low_edge;
};

inline constexpr Theme light_theme = {
    {"#fdfdfe"},      {"#18212c"}, {"#5a6675"}, {"#93a0b0"},       {"#d5dbe2"},
    {"#3d4a5a"},      {"#18212c"}, {"#5a6675"}, {"#2b86bd"},       {"#56b4e9", 0.22},
    {"#cc79a7"},      {"#009e73"}, {"#d55e00"}, {"#0072b2"},       {"#111111"},
    {"#0072b2", 0.1}, {"#7a4fa3"}, {"#a04000"}, {"#0a192d", 0.32}, {"#bedef5", 0.22}};

inline constexpr Theme dark_theme = {
    {"#0e1217"},       {"#e8edf3"}, {"#a0acba"}, {"#5b6878"},      {"#2b333d"},
    {"#b6c1ce"},       {"#eef2f6"}, {"#8a97a6"}, {"#56b4e9"},      {"#56b4e9", 0.2},
    {"#cc79a7"},       {"#2fc79a"}, {"#ff8a3c"}, {"#56b4e9"},      {"#ffffff"},
    {"#56b4e9", 0.16}, {"#c9a3ee"}, {"#f0a070"}, {"#040a12", 0.4}, {"#bedef5", 0.18}};

/// The number of colors in the scale.
inline constexpr std::size_t shades = 64;

/// The colors of the scale, from the least number to the greatest.
const std::array<std::string, shades>& color_scale();

/// The color of the i-th kind of points, modulo the number of colors.
Color kind_color(std::size_t i);

/// Interpolates a list of colors, from `share` 0 for the first to 1 for the last, times `strength`.
std::string color_between(const std::vector<std::array<int, 3>>& colors, double share,
                          double strength = 1);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_THEME_H
