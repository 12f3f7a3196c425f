// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/svg_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

// All in pixels.
constexpr double widest = 912;
constexpr double highest = 672;
constexpr double margin = 24;
constexpr double caption_height = 32;
constexpr double least_width = 400;  // so that the caption fits

// The map from the plane to the drawing.
class Canvas {
 public:
  explicit Canvas(const Svg_view& view) {
    const auto& [xmin, ymin, xmax, ymax] = view.extent;
    // Halves, since the difference of two large numbers may be infinite.
    x_ = xmin / 2 + xmax / 2;
    y_ = ymin / 2 + ymax / 2;
    const auto with_discs = [&](double half) {
      return std::min(half + view.radius, std::numeric_limits<double>::max());
    };
    half_width_ = with_discs(xmax / 2 - xmin / 2);
    double half_height = with_discs(ymax / 2 - ymin / 2);
    if (half_width_ == 0 && half_height == 0) half_width_ = half_height = 1;
    // A strip for collinear points.
    constexpr double flattest = 0.3;
    half_width_ = std::max(half_width_, flattest * half_height);
    half_height = std::max(half_height, flattest * half_width_);
    const double ratio = half_width_ / half_height;
    drawn_width_ = std::min(widest, highest * ratio);
    drawn_height_ = drawn_width_ / ratio;
    width_ = even(std::max(drawn_width_ + 2 * margin, least_width));
    height_ = even(drawn_height_ + 2 * margin + caption_height);
  }

  double width() const { return width_; }
  double height() const { return height_; }
  double x(double x) const { return width_ / 2 + (x / 2 - x_ / 2) / half_width_ * drawn_width_; }
  double y(double y) const {
    return margin + drawn_height_ / 2 - (y / 2 - y_ / 2) / half_width_ * drawn_width_;
  }
  double length(double length) const { return length / half_width_ * drawn_width_ / 2; }

  // The side of a square whose area is the drawn area per point.
  double spacing(std::size_t points) const {
    return std::sqrt(drawn_width_ * drawn_height_ /
                     static_cast<double>(std::max<std::size_t>(points, 1)));
  }

 private:
  static double even(double size) { return 2 * std::ceil(size / 2); }

  double x_;
  double y_;
  double half_width_;
  double drawn_width_;
  double drawn_height_;
  double width_;
  double height_;
};

// A number of pixels, in hundredths; without a sign if it is 0.
double pixels(double value) {
  return std::round(100 * value) / 100 + 0.0;
}

struct Pixel {
  double x;
  double y;

  bool is_finite() const { return std::isfinite(x) && std::isfinite(y); }
};

struct Line {
  Pixel from;
  Pixel to;
};

class Picture {
 public:
  Picture(const Frame_2& frame, const Svg_view& view) : frame_(frame), view_(view), canvas_(view) {
    for (const Vector_2& place : frame.places) places_.push_back(pixel(place));
  }

  void write(std::ostream& out) {
    begin();
    if (view_.box) add_box(*view_.box);
    if (frame_.periodic) add_corners(frame_.periodic->corners);
    const auto disc = [&](std::size_t i) { return canvas_.length((*frame_.discs)[i].radius); };
    if (frame_.discs) {
      add_circles("discs", "fill=\"#56b4e9\" fill-opacity=\"0.35\" stroke=\"#0072b2\"", false,
                  disc);
      add_circles("hidden-discs", "fill=\"none\" stroke=\"#808080\" stroke-dasharray=\"4 3\"", true,
                  disc);
      if (frame_.periodic) add_disc_images(frame_.periodic->corners);
    }
    const double spacing = canvas_.spacing(view_.points);
    const double line = std::clamp(0.03 * spacing, 0.25, 1.2);
    if (frame_.periodic) {
      add_periodic_edges(*frame_.periodic, line, std::clamp(0.08 * spacing, 0.5, 3.4));
    } else {
      std::vector<std::array<std::size_t, 2>> inner;
      std::ranges::set_difference(frame_.edges, frame_.hull, std::back_inserter(inner));
      add_lines("edges", "#6f8fa8", line, lines_of(inner));
      add_lines("hull", "#0072b2", std::max(2 * line, 0.8), lines_of(frame_.hull));
    }
    const auto dot = [&](std::size_t) { return std::clamp(0.08 * spacing, 0.5, 3.4); };
    // Below the others, with which they may coincide.
    add_circles("hidden-points", "fill=\"#fdfdfb\" stroke=\"#808080\"", true, dot);
    add_circles("points", "fill=\"#d55e00\"", false, dot);
    add_caption();
    add("</svg>\n");
    out << text_;
  }

 private:
  template <class... Pieces>
  void add(const Pieces&... pieces) {
    append(text_, pieces...);
  }

  void begin() {
    const double width = canvas_.width();
    const double height = canvas_.height();
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", width, "\" height=\"", height,
        "\" viewBox=\"0 0 ", width, ' ', height, "\">\n");
    add("<title>t = ", frame_.time, "</title>\n");
    add("<rect width=\"", width, "\" height=\"", height, "\" fill=\"#fdfdfb\"/>\n");
  }

  void add_box(const Box_2& box) {
    const Pixel corner = {pixels(canvas_.x(box.xmin)), pixels(canvas_.y(box.ymax))};
    add("<rect class=\"box\" x=\"", corner.x, "\" y=\"", corner.y, "\" width=\"",
        pixels(canvas_.x(box.xmax) - corner.x), "\" height=\"",
        pixels(canvas_.y(box.ymin) - corner.y),
        "\" fill=\"none\" stroke=\"#404040\" stroke-width=\"1.5\"/>\n");
  }

  // The outline of a periodic box.
  void add_corners(const std::array<Vector_2, 4>& corners) {
    add("<path class=\"box\" d=\"");
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Pixel corner = pixel(corners[i]);
      if (!corner.is_finite()) break;
      add(i == 0 ? 'M' : 'L', corner.x, ' ', corner.y);
    }
    add("Z\" fill=\"none\" stroke=\"#404040\" stroke-width=\"1.5\"/>\n");
  }

  // The other images of discs that reach into the box, fainter.
  void add_disc_images(const std::array<Vector_2, 4>& corners) {
    const Vector_2& u = corners[1];
    const Vector_2& v = corners[3];
    begin_group(
        "disc-images",
        "fill=\"#56b4e9\" fill-opacity=\"0.16\" stroke=\"#0072b2\" stroke-opacity=\"0.45\"");
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Vector_2& place = frame_.places[i];
      const double radius = (*frame_.discs)[i].radius;
      if (is_hidden(i)) continue;
      const auto [left, right] = copies_along(place, radius, u, v);
      const auto [lower, upper] = copies_along(place, radius, v, u);
      constexpr double most = 100;
      if (!((right - left + 1) * (upper - lower + 1) <= most)) continue;
      for (double k = left; k <= right; ++k) {
        for (double l = lower; l <= upper; ++l) {
          const Pixel center = pixel({place.x - k * u.x - l * v.x, place.y - k * u.y - l * v.y});
          if ((k != 0 || l != 0) && center.is_finite()) add_circle(center, canvas_.length(radius));
        }
      }
    }
    add("</g>\n");
  }

  // The first and the last copy of the box along its side u into which a disc may reach.
  static std::array<double, 2> copies_along(const Vector_2& place, double radius, const Vector_2& u,
                                            const Vector_2& v) {
    const double area = u.x * v.y - u.y * v.x;
    const double middle = (place.x * v.y - place.y * v.x) / area;
    const double reach = radius * std::hypot(v.x, v.y) / std::abs(area);
    return {std::floor(middle - reach), std::floor(middle + reach)};
  }

  // An edge that leaves the box is drawn at both ends, up to the image of the other one.
  void add_periodic_edges(const Frame_2::Periodic& periodic, double width, double radius) {
    std::vector<Line> within;
    std::vector<Line> leaving;
    for (std::size_t i = 0; i < frame_.edges.size(); ++i) {
      const auto [a, b] = frame_.edges[i];
      const Vector_2& shift = periodic.edge_shifts[i];
      const Vector_2& from = frame_.places[a];
      const Vector_2& to = frame_.places[b];
      if (shift == Vector_2()) {
        within.push_back({places_[a], places_[b]});
      } else {
        leaving.push_back({places_[a], pixel({to.x + shift.x, to.y + shift.y})});
        leaving.push_back({places_[b], pixel({from.x - shift.x, from.y - shift.y})});
      }
    }
    add_lines("edges", "#6f8fa8", width, within);
    add_lines("leaving-edges", "#a9bccb", width, leaving);
    begin_group("images", "fill=\"#e9b48c\"");
    for (const auto& [from, to] : leaving) {
      if (to.is_finite()) add_circle(to, radius);
    }
    add("</g>\n");
  }

  Pixel pixel(const Vector_2& place) const {
    return {pixels(canvas_.x(place.x)), pixels(canvas_.y(place.y))};
  }

  std::vector<Line> lines_of(const std::vector<std::array<std::size_t, 2>>& edges) const {
    std::vector<Line> result;
    for (const auto& [a, b] : edges) result.push_back({places_[a], places_[b]});
    return result;
  }

  void add_lines(std::string_view name, std::string_view color, double width,
                 const std::vector<Line>& lines) {
    add("<path class=\"", name, "\" fill=\"none\" stroke=\"", color, "\" stroke-width=\"",
        pixels(width), "\" stroke-linecap=\"round\" d=\"");
    for (const auto& [from, to] : lines) {
      if (!from.is_finite() || !to.is_finite()) continue;
      add('M', from.x, ' ', from.y, 'L', to.x, ' ', to.y);
    }
    add("\"/>\n");
  }

  bool is_hidden(std::size_t i) const { return frame_.discs && (*frame_.discs)[i].is_hidden; }

  // Adds circles of the hidden points or of the others, with radius(i) for the i-th one. An empty
  // group of hidden points is omitted.
  template <class Radius>
  void add_circles(std::string_view name, std::string_view style, bool are_hidden,
                   const Radius& radius) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Pixel& place = places_[i];
      if (is_hidden(i) != are_hidden || !place.is_finite()) continue;
      if (number++ == 0) begin_group(name, style);
      add_circle(place, radius(i));
    }
    if (number == 0 && are_hidden) return;
    if (number == 0) begin_group(name, style);
    add("</g>\n");
  }

  void add_circle(const Pixel& center, double radius) {
    add("<circle cx=\"", center.x, "\" cy=\"", center.y, "\" r=\"", pixels(radius), "\"/>\n");
  }

  void begin_group(std::string_view name, std::string_view style) {
    add("<g class=\"", name, "\" ", style, ">\n");
  }

  void add_caption() {
    const auto events =
        std::accumulate(frame_.events.begin(), frame_.events.end(), std::uint64_t{0});
    const double baseline = canvas_.height() - 18;
    add("<g font-family=\"sans-serif\" font-size=\"15\" fill=\"#202020\">\n");
    add("<text x=\"", margin, "\" y=\"", baseline, "\">t = ", frame_.time, "</text>\n");
    add("<text x=\"", canvas_.width() - margin, "\" y=\"", baseline,
        "\" text-anchor=\"end\" fill=\"#606060\">", frame_.ids.size(),
        frame_.ids.size() == 1 ? " point, " : " points, ", events,
        events == 1 ? " event" : " events", "</text>\n</g>\n");
  }

  const Frame_2& frame_;
  const Svg_view& view_;
  Canvas canvas_;
  std::vector<Pixel> places_;
  std::string text_;
};

}  // namespace

void write_svg_frame(std::ostream& out, const Frame_2& frame, const Svg_view& view) {
  Picture(frame, view).write(out);
}

}  // namespace kinetri
