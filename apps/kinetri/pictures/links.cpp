// SPDX-License-Identifier: GPL-3.0-or-later
//
// The links between points within range of each other, drawn as on the page (viewer/links.js).
#include <algorithm>
#include <array>
#include <cmath>

#include "pictures/scene.h"

namespace kinetri::app {
namespace {

constexpr double link_field = 24;  // pixels; side of the fields in which ink is measured
constexpr double links_cover =
    0.3;  // greatest fraction of a field that is covered; denser links are fainter
constexpr int link_levels = 18;         // of strength, which two levels halve
constexpr double thinnest_link = 0.02;  // pixels; thinner lines become fainter instead
constexpr double faintest_link = 0.4;

// Samples the segment at most half a field apart, and calls function(field, share) with the
// fraction of its length for each sample.
template <class Function>
void walk_fields(const Camera& camera, const Segment& segment, const Function& function) {
  const double columns = std::ceil(camera.width() / link_field);
  const double rows = std::ceil(camera.height() / link_field);
  const auto& [from, to] = segment;
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const double steps = std::min(std::ceil(2 * std::hypot(dx, dy) / link_field), columns + rows);
  for (double step = 0; step < steps; ++step) {
    const double share = (step + 0.5) / steps;
    const double column = std::floor((from.x + share * dx) / link_field);
    const double row = std::floor((from.y + share * dy) / link_field);
    if (column >= 0 && row >= 0 && column < columns && row < rows) {
      function(static_cast<std::size_t>(row * columns + column), 1 / steps);
    }
  }
}

// The level of each link, from the ink of all links in the fields along it.
std::vector<int> levels_of_links(const Camera& camera, const std::vector<Segment>& links,
                                 double width) {
  std::vector<double> ink(static_cast<std::size_t>(std::ceil(camera.width() / link_field) *
                                                   std::ceil(camera.height() / link_field)));
  for (const Segment& link : links) {
    const double length = std::hypot(link.to.x - link.from.x, link.to.y - link.from.y);
    walk_fields(camera, link,
                [&](std::size_t field, double share) { ink[field] += width * length * share; });
  }
  std::vector<int> result;
  for (const Segment& link : links) {
    double sum = 0;
    double fields = 0;
    walk_fields(camera, link, [&](std::size_t field, double) {
      sum += ink[field];
      ++fields;
    });
    const double cover = fields > 0 ? sum / fields / (link_field * link_field) : 0;
    const double level = cover > 0 ? std::round(2 * std::log2(cover / links_cover)) : 0;
    result.push_back(static_cast<int>(std::clamp(level, 0.0, link_levels - 1.0)));
  }
  return result;
}

}  // namespace

// Draws the links. Dense ones are thinner and fainter, so that what is behind them is seen.
void draw_links(Svg_drawing& drawing, const Scene& scene) {
  std::array<std::vector<Segment>, link_levels> by_level;
  const double width = 1.6 * scene.detail.line_width();
  std::vector<Segment> links;
  for (const Edge_ids& pair : encounters_at(scene.page, scene.playback.time())) {
    links.push_back(scene.segment(pair));
  }
  const std::vector<int> levels = levels_of_links(scene.camera, links, width);
  for (std::size_t i = 0; i < links.size(); ++i) {
    by_level[static_cast<std::size_t>(levels[i])].push_back(links[i]);
  }
  for (int level = link_levels - 1; level >= 0; --level) {
    // Lines become thinner before they become fainter: overlapping lines of one path do not add
    // their strengths.
    const double ink = width / std::exp2(level / 2.0);
    drawing.lines(
        "links", by_level[static_cast<std::size_t>(level)],
        {scene.view.theme().link.faded(std::clamp(ink / thinnest_link, faintest_link, 1.0)),
         std::max(ink, thinnest_link), true});
  }
}

}  // namespace kinetri::app
