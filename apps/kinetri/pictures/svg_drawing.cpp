// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/svg_drawing.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kinetri/impl/io/text.h"
#include "pictures/polygon_clipping.h"

namespace kinetri::app {
namespace {

constexpr double seen_margin = 16;   // pixels outside of the drawing that are kept
constexpr double most_radius = 1e6;  // larger circles are left out

// Rounds to hundredths; turns -0 into 0.
double hundredths(double value) {
  return std::round(100 * value) / 100 + 0.0;
}

bool is_finite(const Pixel& pixel) {
  return std::isfinite(pixel.x) && std::isfinite(pixel.y);
}

std::string escaped_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else {
      result += code < 32 ? ' ' : c;  // XML has no control characters
    }
  }
  return result;
}

}  // namespace

template <class... Pieces>
void Svg_drawing::add(const Pieces&... pieces) {
  append(svg_, pieces...);
}

Svg_drawing::Svg_drawing(int width, int height, Color background, std::string_view title)
    : width_(width), height_(height) {
  add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", width, "\" height=\"", height,
      "\" viewBox=\"0 0 ", width, ' ', height,
      "\" stroke-linejoin=\"round\" font-family=\"system-ui, sans-serif\">\n<title>",
      escaped_text(title), "</title>\n");
  rectangle("background", {0, 0}, width, height, background);
}

void Svg_drawing::add_color(std::string_view attribute, const Color& color) {
  add(' ', attribute, "=\"", color.hex, '"');
  if (color.alpha < 1) add(' ', attribute, "-opacity=\"", hundredths(color.alpha), '"');
}

void Svg_drawing::add_stroke(const Stroke& stroke) {
  if (stroke.color.hex == "none") return;
  add_color("stroke", stroke.color);
  add(" stroke-width=\"", hundredths(stroke.width), '"');
  if (stroke.is_round) add(" stroke-linecap=\"round\"");
  if (!stroke.dash.empty()) add(" stroke-dasharray=\"", stroke.dash, '"');
}

// Clips the segment to the visible area, and returns whether anything is left (Liang and Barsky, A
// new concept and method for line clipping, ACM Transactions on Graphics 3, 1984).
bool Svg_drawing::clip(Segment& segment) const {
  if (!is_finite(segment.from) || !is_finite(segment.to)) return false;
  double enter = 0;
  double leave = 1;
  const Pixel from = segment.from;
  const double dx = segment.to.x - from.x;
  const double dy = segment.to.y - from.y;
  const auto cut = [&](double run, double room) {  // inside if run * t <= room
    if (run == 0) return room >= 0;
    run < 0 ? enter = std::max(enter, room / run) : leave = std::min(leave, room / run);
    return true;
  };
  const bool is_seen = cut(-dx, from.x + seen_margin) && cut(dx, width_ + seen_margin - from.x) &&
                       cut(-dy, from.y + seen_margin) && cut(dy, height_ + seen_margin - from.y);
  if (!is_seen || !(enter <= leave)) return false;
  if (leave < 1) segment.to = {from.x + leave * dx, from.y + leave * dy};
  if (enter > 0) segment.from = {from.x + enter * dx, from.y + enter * dy};
  return true;
}

std::vector<Pixel> Svg_drawing::clipped(std::vector<Pixel> corners) const {
  if (!std::ranges::all_of(corners, is_finite)) return {};
  const auto is_inside = [&](const Pixel& p) {
    return p.x >= -seen_margin && p.y >= -seen_margin && p.x <= width_ + seen_margin &&
           p.y <= height_ + seen_margin;
  };
  if (std::ranges::all_of(corners, is_inside)) return corners;
  corners = part_inside(corners, [](const Pixel& p) { return p.x + seen_margin; });
  corners = part_inside(corners, [](const Pixel& p) { return p.y + seen_margin; });
  corners = part_inside(corners, [&](const Pixel& p) { return width_ + seen_margin - p.x; });
  return part_inside(corners, [&](const Pixel& p) { return height_ + seen_margin - p.y; });
}

void Svg_drawing::lines(std::string_view name, const std::vector<Segment>& segments,
                        const Stroke& stroke) {
  bool is_empty = true;
  for (Segment segment : segments) {
    if (!clip(segment)) continue;
    if (is_empty) {
      add("<path class=\"", name, "\" fill=\"none\"");
      add_stroke(stroke);
      add(" d=\"");
      is_empty = false;
    }
    add('M', hundredths(segment.from.x), ' ', hundredths(segment.from.y), 'L',
        hundredths(segment.to.x), ' ', hundredths(segment.to.y));
  }
  if (!is_empty) add("\"/>\n");
}

void Svg_drawing::add_circle(const Circle& circle, std::string_view more) {
  const auto& [middle, radius] = circle;
  if (!is_finite(middle) || !(radius < most_radius)) return;
  const double reach = radius + seen_margin;
  if (middle.x < -reach || middle.y < -reach || middle.x > width_ + reach ||
      middle.y > height_ + reach) {
    return;
  }
  add("<circle cx=\"", hundredths(middle.x), "\" cy=\"", hundredths(middle.y), "\" r=\"",
      hundredths(radius), "\"", more, "/>\n");
}

void Svg_drawing::circles(std::string_view name, const std::vector<Circle>& circles,
                          const Color& fill, const Stroke& stroke) {
  if (circles.empty()) return;
  add("<g class=\"", name, "\"");
  add_color("fill", fill);
  add_stroke(stroke);
  add(">\n");
  for (const Circle& circle : circles) add_circle(circle, "");
  add("</g>\n");
}

void Svg_drawing::circles(std::string_view name, const std::vector<Circle>& circles,
                          const std::vector<Color>& colors) {
  if (circles.empty()) return;
  add("<g class=\"", name, "\">\n");
  for (std::size_t i = 0; i < circles.size(); ++i) {
    add_circle(circles[i], joined(" fill=\"", colors[i].hex, '"'));
  }
  add("</g>\n");
}

void Svg_drawing::polygons(std::string_view name, const std::vector<Filled_polygon>& polygons) {
  bool is_empty = true;
  for (const auto& [all_corners, color] : polygons) {
    const std::vector<Pixel> corners = clipped(all_corners);
    if (corners.size() < 3) continue;
    if (is_empty) add("<g class=\"", name, "\" stroke-width=\"0.7\">\n");
    is_empty = false;
    add("<path");
    add_color("fill", color);
    // Covers the gaps between antialiased neighbors.
    if (color.alpha == 1) add_color("stroke", color);
    add_outline(corners);
  }
  if (!is_empty) add("</g>\n");
}

void Svg_drawing::polygon(std::string_view name, const Filled_polygon& polygon,
                          const Stroke& outline) {
  const std::vector<Pixel> corners = clipped(polygon.corners);
  if (corners.size() < 3) return;
  add("<path class=\"", name, '"');
  add_color("fill", polygon.color);
  add_stroke(outline);
  add_outline(corners);
}

// Adds the path, and ends the element.
void Svg_drawing::add_outline(const std::vector<Pixel>& corners) {
  add(" d=\"");
  char letter = 'M';
  for (const Pixel& corner : corners) {
    add(letter, hundredths(corner.x), ' ', hundredths(corner.y));
    letter = 'L';
  }
  add("Z\"/>\n");
}

void Svg_drawing::rectangle(std::string_view name, Pixel corner, double width, double height,
                            const Color& fill) {
  add("<rect class=\"", name, "\" x=\"", hundredths(corner.x), "\" y=\"", hundredths(corner.y),
      "\" width=\"", hundredths(width), "\" height=\"", hundredths(height), "\"");
  add_color("fill", fill);
  add("/>\n");
}

void Svg_drawing::text(std::string_view text, Pixel place, const Text_style& style) {
  if (!is_finite(place)) return;
  constexpr std::string_view anchors[] = {"start", "middle", "end"};
  add("<text x=\"", hundredths(place.x), "\" y=\"", hundredths(place.y), "\" font-size=\"",
      style.size, "\" text-anchor=\"", anchors[static_cast<std::size_t>(style.anchor)], '"');
  add_color("fill", style.color);
  if (style.halo.hex != "none") {
    add_color("stroke", style.halo);
    add(" stroke-width=\"3\" paint-order=\"stroke\"");
  }
  add('>', escaped_text(text), "</text>\n");
}

double width_of_text(std::string_view text, double size) {
  // Continuation bytes of UTF-8 are not counted.
  const auto letters = std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; });
  constexpr double mean_width = 0.62;  // of digits and letters in a plain font
  return mean_width * size * static_cast<double>(letters);
}

}  // namespace kinetri::app
