// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words that say what is shown of a run: `t=2.5&color=area&hide=ids`, as they stand after `#`
// in the address of a page, in --html-view, and in --view of kinetri render.
//
// What can be judged without the run is judged here: names and values. Whether the run has what
// they name (an edge, a point, a time, discs) is judged where the run is known.
#ifndef KINETRI_APPS_VIEW_WORDS_H
#define KINETRI_APPS_VIEW_WORDS_H

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinetri/base/ids.h"
#include "kinetri/impl/events/basic_event.h"

namespace kinetri::app {

/// What can be switched on and off in a picture.
enum class Layer {
  wave,
  delaunay,
  hull,
  voronoi,
  circle,  ///< of the triangle under the pointer
  discs,
  trails,
  arrows,
  links,  ///< between points within range of each other
  heat,
  scale,
  axes,
  ids,
};

inline constexpr std::array<std::string_view, 13> layer_names = {
    "wave",   "delaunay", "hull", "voronoi", "circle", "discs", "trails",
    "arrows", "links",    "heat", "scale",   "axes",   "ids"};

/// What points can be colored by.
enum class Quantity { none, area, density, speed, degree, changes, size, component, members, kind };

inline constexpr std::array<std::string_view, 10> quantity_names = {
    "none",    "area", "density",   "speed",   "degree",
    "changes", "size", "component", "members", "kind"};

/// The words with values; what is not there is as the page shows it without a word.
struct View_words {
  std::optional<double> time;
  std::optional<std::uint64_t> event;            ///< so many events have happened
  std::vector<std::pair<Layer, bool>> switches;  ///< in the order in which they are followed
  std::optional<Edge_ids> edge;
  std::optional<std::string> point;  ///< an id or a name
  std::optional<bool> follows_point;
  std::optional<Quantity> color;
  std::optional<std::array<double, 3>> at;  ///< x and y of the middle, and the width
  std::optional<std::vector<Event_kind>> kinds;
  std::optional<std::string> unit;  ///< of lengths
  std::optional<bool> has_legend;
  std::optional<bool> is_dark;
};

/// Reads them; `source` is the option or the file from which they are. Of several words of one
/// name, the last one counts. Throws Usage_error.
View_words view_words(std::string_view source, std::string_view text);

/// Throws Usage_error: the word of that name cannot have the value.
[[noreturn]] void refuse_view_word(std::string_view source, std::string_view name,
                                   std::string_view value, std::string_view expected);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_VIEW_WORDS_H
