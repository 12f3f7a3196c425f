// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surroundings of a picture: color scale, scale bar, legend and time; and the counts of the
// heat map, whose maximum is in the legend.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "cli/text.h"
#include "kinetri/impl/io/text.h"
#include "pictures/scene.h"

namespace kinetri::app {
namespace {

constexpr double font = 12;
constexpr double side = 16;         // between the border and its neighbors
constexpr double line_height = 20;  // of the legend
constexpr double sample = 22;       // width of the sample in a line
constexpr double scale_height = 46;
constexpr double scale_width = 192;
constexpr double longest_bar = 130;

// The n-th of the numbers 1, 2 and 5 times a power of ten; the number 0 is 1.
double round_number(int n) {
  const int step = (n % 3 + 3) % 3;
  return std::array<double, 3>{1, 2, 5}[static_cast<std::size_t>(step)] *
         std::pow(10, (n - step) / 3);
}

// A line of the legend.
struct Legend_line {
  std::string text;
  // Draws the sample, given the position of its left end at half the height of the line.
  std::function<void(Svg_drawing&, Pixel)> draw;
};

// The lines for all shown layers.
std::vector<Legend_line> legend_lines(const Viewer_page& page, const View& view,
                                      const Coloring* coloring, const Heat* heat) {
  const Theme& theme = view.theme();
  const bool is_weighted = has_weights(page.recording);
  std::vector<Legend_line> result;
  const auto add_line = [&](bool is_shown, const std::string& text, const Stroke& stroke) {
    if (!is_shown) return;
    result.push_back({text, [stroke](Svg_drawing& drawing, Pixel at) {
                        drawing.lines("legend", {{at, {at.x + sample, at.y}}}, stroke);
                      }});
  };
  const auto add_field = [&](const std::string& text, const Color& color) {
    result.push_back({text, [color](Svg_drawing& drawing, Pixel at) {
                        drawing.rectangle("legend", {at.x + 5, at.y - 6}, 12, 12, color);
                      }});
  };
  if (view.has_legend) {
    const bool is_flat = !view.shows(Layer::wave);
    const auto shows = [&](Layer layer) { return is_flat && view.shows(layer); };
    const std::string kind = is_weighted ? "regular" : "Delaunay";
    add_line(view.shows(Layer::delaunay), joined("edge of the ", kind, " triangulation"),
             {shows(Layer::voronoi) ? theme.edge_behind : theme.edge, 2});
    add_line(shows(Layer::hull), "convex hull", {theme.hull, 3});
    add_line(shows(Layer::voronoi), is_weighted ? "power diagram" : "Voronoi diagram",
             {theme.voronoi, 2});
    add_line(shows(Layer::trails), "where points have been", {theme.trail, 3});
    add_line(shows(Layer::arrows), "velocity", {theme.arrow, 2});
    if (shows(Layer::links)) {
      add_line(true,
               joined("in range: at most ", page.settings.encounters->range,
                      view.unit.empty() ? "" : " ", view.unit),
               {theme.link, 2});
    }
    if (heat != nullptr && shows(Layer::heat)) {
      add_field(joined("events here, up to ", heat->most), {"#d55e00", 0.6});
    }
    if (is_weighted && is_flat) {
      result.push_back(
          {"hidden point", [&theme](Svg_drawing& drawing, Pixel at) {
             drawing.circles("legend", {{{at.x + sample / 2, at.y}, 5}}, {}, {theme.quiet, 1.25});
           }});
    }
    if (!page.recording.coincidences.empty() && is_flat) {
      result.push_back(
          {"points that coincide for a while", [&theme](Svg_drawing& drawing, Pixel at) {
             const Pixel middle = {at.x + sample / 2, at.y};
             drawing.circles("legend", {{middle, 3}}, theme.point);
             drawing.circles("legend", {{middle, 5.5}}, {}, {theme.point, 1.25});
           }});
    }
    add_line(true, "added now", {theme.added, 4});
    add_line(true, "removed now", {theme.removed, 2.5, true, "7 5"});
  }
  if (view.has_scale && coloring != nullptr && coloring->is_of_kinds()) {
    for (std::size_t i = 0; i < coloring->kinds().size(); ++i) {
      add_field(coloring->kinds()[i], kind_color(i));
    }
  }
  return result;
}

struct Tick {
  double place;  // in pixels
  std::string text;
};

// The multiples of a round number between `from` and `to`, at least `apart` pixels apart; none if
// binary64 numbers cannot distinguish them. `pixel` maps a coordinate to pixels.
template <class Pixel_of>
std::vector<Tick> ticks(double from, double to, double scale, double apart, const Pixel_of& pixel) {
  const int n = static_cast<int>(std::ceil(3 * std::log10(apart / scale))) + 1;
  double step = round_number(n);
  for (int i = n; round_number(i) * scale >= apart; --i) step = round_number(i);
  constexpr double most_exact = 0x1p53;
  std::vector<Tick> result;
  if (!(step > 0) || !(std::max(std::abs(from), std::abs(to)) / step < most_exact)) return result;
  const int decimals = static_cast<int>(std::clamp(std::ceil(-std::log10(step)), 0.0, 15.0));
  for (double k = std::ceil(from / step); k <= std::floor(to / step); ++k) {
    const double value = k * step + 0.0;
    const bool is_plain = std::abs(value) < 1e15 && step > 1e-15;
    result.push_back({pixel(value), is_plain ? fixed(value, decimals) : significant(value, 6)});
  }
  return result;
}

double width_of_line(const Legend_line& line) {
  return sample + 6 + width_of_text(line.text, font) + 18;
}

// Calls function(line, place) for each line, with its position relative to the upper left corner of
// the legend. Returns the height of the legend.
template <class Function>
double lay_out(const std::vector<Legend_line>& lines, double width, Function function) {
  Pixel at = {0, line_height / 2};
  for (const Legend_line& line : lines) {
    const double room = width_of_line(line);
    if (at.x > 0 && at.x + room > width - 2 * side) at = {0, at.y + line_height};
    function(line, at);
    at.x += room;
  }
  return lines.empty() ? 0 : at.y + line_height / 2;
}

bool has_scale_of_colors(const View& view, const Coloring* coloring) {
  return view.has_scale && coloring != nullptr && !coloring->is_of_kinds();
}

void draw_scale_of_colors(Svg_drawing& drawing, const Theme& theme, const Coloring& coloring,
                          const std::string& unit, double bottom) {
  const Text_style style = {theme.text, {}, font};
  const double step = scale_width / shades;
  std::vector<Filled_polygon> fields;
  const double top = bottom - 26;
  for (std::size_t i = 0; i < shades; ++i) {
    const double left = side + step * static_cast<double>(i);
    fields.push_back({{{left, top}, {left + step, top}, {left + step, top + 10}, {left, top + 10}},
                      {color_scale()[i]}});
  }
  drawing.polygons("scale", fields);
  drawing.text(coloring.title(unit), {side, top - 6}, style);
  const auto number = [&](double value, std::string_view beyond) {
    return joined(coloring.is_cut() ? beyond : "", significant(value, 3));
  };
  drawing.text(number(coloring.least(), "\u2264 "), {side, bottom - 3}, style);
  Text_style right = style;
  right.anchor = Anchor::end;
  drawing.text(number(coloring.greatest(), "\u2265 "), {side + scale_width, bottom - 3}, right);
}

// Draws the longest length of the form 1, 2 or 5 times a power of ten that fits.
void draw_scale_bar(Svg_drawing& drawing, const Scene& scene, double y) {
  const double scale = scene.camera.scale();
  int n = static_cast<int>(std::ceil(3 * std::log10(longest_bar / scale))) + 1;
  while (round_number(n) * scale > longest_bar) --n;
  const double right = scene.camera.width() - side;
  const double left = right - round_number(n) * scale;
  const Theme& theme = scene.view.theme();
  drawing.lines(
      "scale-bar",
      {{{left, y}, {right, y}}, {{left, y - 4}, {left, y + 4}}, {{right, y - 4}, {right, y + 4}}},
      {theme.text, 1.5});
  const std::string& unit = scene.view.unit;
  drawing.text(joined(significant(round_number(n), 6), unit.empty() ? "" : " ", unit),
               {(left + right) / 2, y - 8}, {theme.text, {}, font, Anchor::middle});
}

// Smooths the counts: each gives a quarter to either neighbor.
std::vector<double> spread(const std::vector<double>& counts, std::size_t columns, bool is_along) {
  std::vector<double> result(counts.size());
  const std::size_t step = is_along ? 1 : columns;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const bool has_before = is_along ? i % columns > 0 : i >= step;
    const bool has_after = is_along ? i % columns + 1 < columns : i + step < counts.size();
    result[i] =
        (2 * counts[i] + (has_before ? counts[i - step] : 0) + (has_after ? counts[i + step] : 0)) /
        4;
  }
  return result;
}

}  // namespace

double height_of_legend(const Viewer_page& page, const View& view, const Coloring* coloring,
                        double width) {
  const bool has_scales = has_scale_of_colors(view, coloring) || view.shows(Layer::scale);
  // The maximum of the heat map hardly changes the width of its line.
  const Heat some_heat;
  const double lines = lay_out(legend_lines(page, view, coloring, &some_heat), width,
                               [](const Legend_line&, const Pixel&) {});
  if (!has_scales && lines == 0) return 0;
  return (has_scales ? scale_height : 0) + lines + side;
}

void draw_legend(Svg_drawing& drawing, const Scene& scene, const Coloring* coloring,
                 const Heat* heat) {
  const View& view = scene.view;
  const Theme& theme = view.theme();
  if (view.has_time) {
    drawing.text(joined("t = ", fixed(scene.playback.time(), view.decimals)), {side, side + 10},
                 {theme.text, theme.background, 15});
  }
  const double top = scene.camera.height();
  if (top == drawing.height()) return;
  drawing.rectangle("strip", {0, top}, drawing.width(), drawing.height() - top, theme.background);
  const double bottom = drawing.height() - side / 2;
  const bool has_scales = has_scale_of_colors(view, coloring) || view.shows(Layer::scale);
  lay_out(legend_lines(scene.page, view, coloring, heat), drawing.width(),
          [&](const Legend_line& line, const Pixel& at) {
            const Pixel place = {side + at.x, top + at.y};
            line.draw(drawing, place);
            drawing.text(line.text, {place.x + sample + 6, place.y + 4}, {theme.text, {}, font});
          });
  if (!has_scales) return;
  if (has_scale_of_colors(view, coloring)) {
    draw_scale_of_colors(drawing, theme, *coloring, view.unit, bottom);
  }
  if (view.shows(Layer::scale) && !view.shows(Layer::wave)) {
    draw_scale_bar(drawing, scene, bottom - 12);
  }
}

// Draws the axes: strips at the left and the bottom, with ticks at round numbers.
void draw_axes(Svg_drawing& drawing, const Scene& scene) {
  constexpr double tick = 5;
  constexpr double strip = 24;
  constexpr double size = 11;
  const Camera& camera = scene.camera;
  const Theme& theme = scene.view.theme();
  const double bottom = camera.height() - strip;
  // The inverse of the camera.
  const double middle_x = camera.width() / 2;
  const auto plane_x = [&](double x) { return (x - camera.x(0)) / camera.scale(); };
  const auto plane_y = [&](double y) { return (camera.y(0) - y) / camera.scale(); };
  const auto vertical =
      ticks(plane_y(bottom), plane_y(0), camera.scale(), 32, [&](double y) { return camera.y(y); });
  double left = width_of_text(scene.view.unit, size);
  for (const Tick& one : vertical) left = std::max(left, width_of_text(one.text, size));
  left = std::ceil(left) + tick + 9;
  const double apart = std::min(std::max(64.0, 1.4 * left), middle_x);
  const auto horizontal = ticks(plane_x(left), plane_x(camera.width()), camera.scale(), apart,
                                [&](double x) { return camera.x(x); });
  drawing.rectangle("strip", {0, 0}, left, camera.height(), theme.background);
  drawing.rectangle("strip", {0, bottom}, drawing.width(), strip, theme.background);
  std::vector<Segment> lines = {{{left, 0}, {left, bottom}},
                                {{left, bottom}, {drawing.width(), bottom}}};
  const Text_style style = {theme.text, {}, size, Anchor::middle};
  Text_style beside = style;
  beside.anchor = Anchor::end;
  for (const auto& [place, text] : horizontal) {
    lines.push_back({{place, bottom}, {place, bottom + tick}});
    const double half = width_of_text(text, size) / 2;
    if (place - half > left && place + half < drawing.width() - 2) {
      drawing.text(text, {place, bottom + tick + 12}, style);
    }
  }
  for (const auto& [place, text] : vertical) {
    lines.push_back({{left - tick, place}, {left, place}});
    if (place > 8 && place < bottom - 4) drawing.text(text, {left - tick - 3, place + 4}, beside);
  }
  drawing.lines("axes", lines, {theme.text, 1});
  if (!scene.view.unit.empty()) {
    drawing.text(scene.view.unit, {left - tick - 3, bottom + tick + 12}, beside);
  }
}

Heat heat_of(const Viewer_page& page, const Box_2& extent, const std::vector<Event_kind>& kinds) {
  const Recording& recording = page.recording;
  const double width = extent.xmax - extent.xmin;
  const double height = extent.ymax - extent.ymin;
  const double fields =
      std::clamp(std::sqrt(2 * static_cast<double>(recording.events.size())), 16.0, 72.0);
  Heat result;
  result.left = extent.xmin;
  result.bottom = extent.ymin;
  result.side = std::max(width, height) / std::round(fields);
  const auto fields_along = [&](double length) {
    const double number = std::min(std::ceil(length / result.side), std::round(fields) + 1);
    return number >= 1 ? static_cast<std::size_t>(number) : 1;  // 1 if the length overflows
  };
  result.columns = fields_along(width);
  const std::size_t lines = fields_along(height);
  std::vector<double> counts(result.columns * lines);
  Playback playback(recording);
  for (std::size_t row = 0; row < recording.events.size(); ++row) {
    playback.go_to_row(row);
    const Recorded_event& event = recording.events[row];
    if (std::ranges::find(kinds, event.kind) == kinds.end()) continue;
    const auto& edge = event.removed ? event.removed : event.added;
    if (!edge && !event.point_a) continue;
    const Edge_ids ends = edge ? *edge : Edge_ids{*event.point_a, *event.point_a};
    double x = 0;
    double y = 0;
    bool is_there = true;
    for (const Point_id end : ends) {
      const auto* motion = playback.motion(end);
      is_there = is_there && motion != nullptr;
      if (!is_there) break;
      const Recorded_place place = place_of(*motion, event.time.nearest);
      x += place.x / 2;
      y += place.y / 2;
    }
    if (recording.periodic_box && is_there) {
      const Periodic_box_2& box = *recording.periodic_box;
      const double time = event.time.nearest;
      const Lattice_offset_2& offset = event.removed ? event.removed_offset : event.added_offset;
      const Vector_2 end = rounded_place(Image_motion_2{{}, offset, &box}, time);
      const auto image = Drawn_box_2(box, time).image({x + end.x / 2, y + end.y / 2});
      x = image.place.x;
      y = image.place.y;
    }
    const double column = std::floor((x - result.left) / result.side);
    const double line = std::floor((y - result.bottom) / result.side);
    if (is_there && column >= 0 && line >= 0 && column < static_cast<double>(result.columns) &&
        line < static_cast<double>(lines)) {
      ++counts[static_cast<std::size_t>(line) * result.columns + static_cast<std::size_t>(column)];
    }
  }
  result.most = *std::ranges::max_element(counts);
  counts = spread(spread(counts, result.columns, true), result.columns, false);
  const double most = *std::ranges::max_element(counts);
  for (const double count : counts) {
    const double share = most > 0 ? std::sqrt(count / most) : 0;
    result.levels.push_back(static_cast<int>(std::round(heat_levels * share)));
  }
  return result;
}

}  // namespace kinetri::app
