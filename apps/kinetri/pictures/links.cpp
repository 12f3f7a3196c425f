// SPDX-License-Identifier: GPL-3.0-or-later
//
// The links between points within range of each other, as the page draws them (viewer/links.js).
#include <algorithm>
#include <array>
#include <cmath>

#include "pictures/scene.h"

namespace kinetri::app {
namespace {

constexpr double link_field = 24;       // pixels; the side in which links are measured
constexpr double links_cover = 0.3;     // of a field; links that would cover more are fainter
constexpr int link_levels = 18;         // of strength; two of them halve it
constexpr double thinnest_link = 0.02;  // pixels; what is thinner is a share of a pixel's color
constexpr double faintest_link = 0.4;

// Calls function(field, share) for places along the segment, half of a field apart at most, with
// the share of its length that each stands for.
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

// The level of each link, by the ink that all links would have in the fields along it.
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

// Between points that are within range of each other. In a crowd they are thinner and fainter, so
// that what is between and behind them is seen.
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
    // The line becomes thinner, since lines of one path that lie over each other add their widths
    // but not their strengths; only in the end it becomes fainter.
    const double ink = width / std::exp2(level / 2.0);
    drawing.lines(
        "links", by_level[static_cast<std::size_t>(level)],
        {scene.view.theme().link.faded(std::clamp(ink / thinnest_link, faintest_link, 1.0)),
         std::max(ink, thinnest_link), true});
  }
}

}  // namespace kinetri::app
