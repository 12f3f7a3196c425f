// SPDX-License-Identifier: GPL-3.0-or-later
//
// The words that select what is shown of a run: `t=2.5&color=area&hide=ids`, as they stand after
// `#` in the address of a page, in --html-view, and in --view of kinetri render.
//
// Names and the form of values are checked here. Whether the run has the edge, point, time or discs
// that a word needs is checked by Run_pictures.
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

/// Parts of a picture that can be switched on and off.
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

/// Quantities by which points can be colored.
enum class Quantity { none, area, density, speed, degree, changes, size, component, members, kind };

inline constexpr std::array<std::string_view, 10> quantity_names = {
    "none",    "area", "density",   "speed",   "degree",
    "changes", "size", "component", "members", "kind"};

/// The words with values. Absent ones mean the page's default.
struct View_words {
  std::optional<double> time;
  std::optional<std::uint64_t> event;            ///< number of events that have happened
  std::vector<std::pair<Layer, bool>> switches;  ///< in the order in which they apply
  std::optional<Edge_ids> edge;
  std::optional<Lattice_offset_2> edge_offset;  ///< in a periodic box, of `edge`
  std::optional<std::string> point;             ///< an id or a name
  std::optional<bool> follows_point;
  std::optional<Quantity> color;
  std::optional<std::array<double, 3>> at;  ///< x and y of the middle, and the width
  std::optional<std::vector<Event_kind>> kinds;
  std::optional<std::string> unit;  ///< of lengths
  std::optional<bool> has_legend;
  std::optional<bool> is_dark;
};

/// Parses the words; `source` is their option or file, for messages. Of several words of one name,
/// the last one counts. Throws Usage_error.
View_words view_words(std::string_view source, std::string_view text);

/// Throws Usage_error: the value is not possible for the word `name`.
[[noreturn]] void refuse_view_word(std::string_view source, std::string_view name,
                                   std::string_view value, std::string_view expected);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_VIEW_WORDS_H
