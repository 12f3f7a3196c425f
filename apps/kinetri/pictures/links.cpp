// SPDX-License-Identifier: GPL-3.0-or-later
//
// The links between points within range of each other, drawn as on the page (viewer/links.js).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

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

// One segment, or two if the link leaves a periodic box.
using Link = std::vector<Segment>;

// The level of each link, from the ink of all links in the fields along it.
std::vector<int> levels_of_links(const Camera& camera, const std::vector<Link>& links,
                                 double width) {
  std::vector<double> ink(static_cast<std::size_t>(std::ceil(camera.width() / link_field) *
                                                   std::ceil(camera.height() / link_field)));
  for (const Link& link : links) {
    for (const Segment& part : link) {
      const double length = std::hypot(part.to.x - part.from.x, part.to.y - part.from.y);
      walk_fields(camera, part,
                  [&](std::size_t field, double share) { ink[field] += width * length * share; });
    }
  }
  std::vector<int> result;
  for (const Link& link : links) {
    double sum = 0;
    double fields = 0;
    for (const Segment& part : link) {
      walk_fields(camera, part, [&](std::size_t field, double) {
        sum += ink[field];
        ++fields;
      });
    }
    const double cover = fields > 0 ? sum / fields / (link_field * link_field) : 0;
    const double level = cover > 0 ? std::round(2 * std::log2(cover / links_cover)) : 0;
    result.push_back(static_cast<int>(std::clamp(level, 0.0, link_levels - 1.0)));
  }
  return result;
}

}  // namespace

// Draws the links. Dense ones are thinner and fainter, so that what is behind them is seen. Links
// that leave a periodic box are fainter.
void draw_links(Svg_drawing& drawing, const Scene& scene) {
  // By level; first the links that leave the box, then the others.
  std::array<std::array<std::vector<Segment>, 2>, link_levels> by_level;
  const double width = 1.6 * scene.detail.line_width();
  std::vector<Link> links;
  for (const Periodic_edge& pair : encounters_at(scene.page, scene.playback.time())) {
    links.push_back(scene.segments(pair));
  }
  const std::vector<int> levels = levels_of_links(scene.camera, links, width);
  for (std::size_t i = 0; i < links.size(); ++i) {
    auto& list = by_level[static_cast<std::size_t>(levels[i])][links[i].size() > 1 ? 0 : 1];
    list.insert(list.end(), links[i].begin(), links[i].end());
  }
  for (int level = link_levels - 1; level >= 0; --level) {
    // Lines become thinner before they become fainter: overlapping lines of one path do not add
    // their strengths.
    const double ink = width / std::exp2(level / 2.0);
    const double alpha = std::clamp(ink / thinnest_link, faintest_link, 1.0);
    for (const bool is_within : {false, true}) {
      const Color color = scene.view.theme().link.faded(is_within ? alpha : leaving * alpha);
      drawing.lines("links", by_level[static_cast<std::size_t>(level)][is_within],
                    {color, std::max(ink, thinnest_link), true});
    }
  }
}

}  // namespace kinetri::app
