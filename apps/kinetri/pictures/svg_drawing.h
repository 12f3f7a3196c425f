// SPDX-License-Identifier: GPL-3.0-or-later
//
// A drawing that writes SVG: lines, circles, polygons and texts, later ones above earlier ones.
// Positions and lengths are in pixels, with y pointing down; coordinates are rounded to hundredths
// of a pixel. Parts outside of the drawing are clipped, since programs that show SVG compute with
// low precision; parts at positions that are not finite are left out.
#ifndef KINETRI_APPS_SVG_DRAWING_H
#define KINETRI_APPS_SVG_DRAWING_H

#include <string>
#include <string_view>
#include <vector>

namespace kinetri::app {

struct Pixel {
  double x = 0;
  double y = 0;
};

struct Segment {
  Pixel from;
  Pixel to;
};

struct Circle {
  Pixel middle;
  double radius = 0;
};

/// A color as `#0072b2`, and its opacity.
struct Color {
  std::string_view hex = "none";
  double alpha = 1;

  Color faded(double factor) const { return {hex, alpha * factor}; }
};

struct Stroke {
  Color color;
  double width = 1;
  bool is_round = false;       ///< at its ends
  std::string_view dash = {};  ///< lengths of dashes and gaps, as SVG has them
};

/// A polygon and its color. Adjacent polygons are drawn without a gap.
struct Filled_polygon {
  std::vector<Pixel> corners;
  Color color;
};

enum class Anchor { start, middle, end };

struct Text_style {
  Color color;
  Color halo;        ///< about the letters, so that they can be read above lines
  double size = 11;  ///< of the font
  Anchor anchor = Anchor::start;
};

/// Each function draws one layer, an element with `name` as its class; nothing if the layer is
/// empty.
class Svg_drawing {
 public:
  /// `title`: the SVG element of that name.
  Svg_drawing(int width, int height, Color background, std::string_view title);

  double width() const { return width_; }
  double height() const { return height_; }

  /// One path, with a line `M x yL x y` for each segment.
  void lines(std::string_view name, const std::vector<Segment>& segments, const Stroke& stroke);
  /// A group of circles of one color. Without a filling, `fill` is `none`.
  void circles(std::string_view name, const std::vector<Circle>& circles, const Color& fill,
               const Stroke& stroke = {});
  /// A group of circles, each with the color of the same index.
  void circles(std::string_view name, const std::vector<Circle>& circles,
               const std::vector<Color>& colors);
  /// A group of paths.
  void polygons(std::string_view name, const std::vector<Filled_polygon>& polygons);
  /// One path with an outline.
  void polygon(std::string_view name, const Filled_polygon& polygon, const Stroke& outline);
  void rectangle(std::string_view name, Pixel corner, double width, double height,
                 const Color& fill);
  void text(std::string_view text, Pixel place, const Text_style& style);

  /// The file.
  std::string svg() const { return svg_ + "</svg>\n"; }

 private:
  bool clip(Segment& segment) const;
  std::vector<Pixel> clipped(std::vector<Pixel> corners) const;
  void add_circle(const Circle& circle, std::string_view more);
  template <class... Pieces>
  void add(const Pieces&... pieces);
  void add_color(std::string_view attribute, const Color& color);
  void add_stroke(const Stroke& stroke);
  void add_outline(const std::vector<Pixel>& corners);

  double width_;
  double height_;
  std::string svg_;
};

/// The approximate width of a text.
double width_of_text(std::string_view text, double size);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SVG_DRAWING_H
