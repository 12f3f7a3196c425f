// SPDX-License-Identifier: GPL-3.0-or-later
//
// The part of the plane that a picture shows, and its level of detail, as on the page
// (viewer/extents.js, camera.js, detail.js).
#ifndef KINETRI_APPS_CAMERA_H
#define KINETRI_APPS_CAMERA_H

#include <cstddef>
#include <optional>
#include <vector>

#include "kinetri/io/viewer_page.h"
#include "pictures/svg_drawing.h"

namespace kinetri::app {

/// The part of the plane that the points cover: one for the whole run, or, if they spread much, one
/// for each time. A few outliers may be outside.
class Extents {
 public:
  explicit Extents(const Viewer_page& page);

  /// The extent at a time of the run.
  Box_2 at(double time) const;
  /// The extent of the whole run.
  const Box_2& whole() const { return whole_; }

 private:
  void sample(const Viewer_page& page);

  double from_;
  double until_;
  Box_2 whole_;
  std::vector<Box_2> samples_;  // at evenly spaced times; empty if there is one for the whole run
};

/// Maps the plane to the picture.
class Camera {
 public:
  /// The lowest `strip` pixels are for the legend.
  Camera(int width, int height, double strip) : width_(width), height_(height), strip_(strip) {}

  /// Shows the whole extent, beside the axes if shown.
  void fit(const Box_2& extent, bool has_axes);
  /// Shows the given width of the plane, centered at (x, y).
  void look(double x, double y, double width);
  /// Centers the view at (x, y).
  void center(double x, double y);

  double scale() const { return scale_; }  ///< pixels per unit of length
  double width() const { return width_; }
  /// Without the strip.
  double height() const { return height_ - strip_; }
  double x(double x) const { return (x - x_) * scale_ + width_ / 2; }
  double y(double y) const { return height() / 2 - (y - y_) * scale_; }
  Pixel pixel(double px, double py) const { return {x(px), y(py)}; }
  /// The distance of neighbors in pixels, if `points` points were evenly spread over the extent.
  double spacing(const Box_2& extent, std::size_t points) const;

 private:
  double width_;
  double height_;
  double strip_;
  double x_ = 0;
  double y_ = 0;
  double scale_ = 1;
};

/// Dots shrink and lines become thinner and fainter as points get closer.
class Detail {
 public:
  explicit Detail(double spacing = 1e9) : spacing_(spacing) {}

  double spacing() const { return spacing_; }
  double dot_radius() const;
  double dot_strength() const;
  /// From 0 (lines would cover each other) to 1. Lines behind others fade earlier.
  double edge_strength(bool is_behind = false) const;
  double line_width() const;

 private:
  double spacing_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_CAMERA_H
