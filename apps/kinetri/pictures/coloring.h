// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points' colors, as on the page (viewer/coloring.js). The scale covers the numbers of the
// whole run, so that colors can be compared over time, except up to 2 % of them at either end.
#ifndef KINETRI_APPS_COLORING_H
#define KINETRI_APPS_COLORING_H

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/io/viewer_page.h"
#include "pictures/cells.h"
#include "pictures/svg_drawing.h"
#include "pictures/view_words.h"

namespace kinetri::app {

/// Whether the page has all encounters of the run.
bool has_encounters(const Viewer_page& page);

/// The pairs of points, in a periodic box of images, that are within range at a time by the
/// encounters of the page.
std::vector<Periodic_edge> encounters_at(const Viewer_page& page, double time);

/// The quantities by which the points of the run can be colored, `none` among them.
std::vector<Quantity> quantities_of(const Viewer_page& page);

class Coloring {
 public:
  /// Precondition: the quantity is one of quantities_of(page), and not `none`. `page` must outlive
  /// it.
  Coloring(const Viewer_page& page, Quantity quantity);

  /// The color of each point by id at the playback's time; none for a point without a number.
  std::vector<std::optional<Color>> colors(const Playback& playback, const Places& places,
                                           const std::vector<Cell>& cells) const;

  /// Whether colors stand for kinds or components, not for numbers on a scale.
  bool is_of_kinds() const {
    return quantity_ == Quantity::kind || quantity_ == Quantity::component;
  }
  /// The kinds of points in the order of their colors, if the quantity is `kind`.
  const std::vector<std::string>& kinds() const { return kinds_; }
  /// What the colors show, with the unit of lengths if it is known: "Cell area, in m^2".
  std::string title(const std::string& unit) const;
  /// The numbers at the ends of the scale.
  double least() const { return least_; }
  double greatest() const { return greatest_; }
  bool is_cut() const { return is_cut_; }

 private:
  std::vector<double> numbers(const Playback& playback, const Places& places,
                              const std::vector<Cell>& cells) const;
  void find_range();

  const Viewer_page& page_;
  Quantity quantity_;
  std::vector<std::string> kinds_;
  std::vector<double> kind_of_point_;
  double least_ = 0;
  double greatest_ = 0;
  bool is_logarithmic_ = false;
  bool is_cut_ = false;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_COLORING_H
