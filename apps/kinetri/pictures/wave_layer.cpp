// SPDX-License-Identifier: GPL-3.0-or-later
//
// The wave: the triangulation as a surface, z = height exp(-d^2 / (2 width^2)) with d the distance
// in y to the mean of the points that move, seen from above at an angle without perspective, as on
// the page (viewer/wave_view.js). Triangles are drawn from back to front, so that the near ones
// cover the far ones.
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "pictures/scene.h"

namespace kinetri::app {
namespace {

// Lightness increases with the height, so that heights can be distinguished without color.
const std::vector<std::array<int, 3>> wave_ramp = {
    {24, 66, 106}, {0, 98, 148}, {0, 141, 158}, {98, 186, 160}, {206, 226, 170}, {255, 250, 228}};
constexpr double yaw = -0.5;
constexpr double pitch = 0.66;        // 0: from the side, pi / 2: from above
constexpr double dark_height = 0.45;  // fraction of the height below which lines are light
constexpr std::array<double, 3> light = {-0.42, -0.46, 0.78};

struct Raised {
  double z = 0;
  double depth = 0;  // greater is farther away
};

bool moves(const Polynomial_disc_motion_2& motion) {
  return motion.velocity != Vector_2() || motion.acceleration != Vector_2() ||
         motion.jerk != Vector_2();
}

// Computes the heights, and projects the points.
std::vector<Raised> raise(Scene& scene, const Box_2& extent, double width, double height) {
  const Wave_shape& wave = *scene.page.settings.wave;
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < scene.places.size(); ++i) {
    const auto* motion = scene.playback.motion(static_cast<Point_id>(i));
    if (motion == nullptr || !moves(*motion)) continue;
    sum += scene.places[i].y;
    ++count;
  }
  const double cx = extent.xmin / 2 + extent.xmax / 2;
  const double cy = extent.ymin / 2 + extent.ymax / 2;
  const double diagonal = std::hypot(extent.xmax - extent.xmin, extent.ymax - extent.ymin);
  const double tall = diagonal * std::sin(pitch) + std::abs(wave.height) * std::cos(pitch);
  const double scale = std::min(width / diagonal, height / tall);
  std::vector<Raised> result(scene.places.size());
  for (std::size_t i = 0; i < scene.places.size(); ++i) {
    const Recorded_place& place = scene.places[i];
    if (!place.is_there) continue;
    const double d = count == 0 ? 0 : (place.y - sum / count) / wave.width;
    const double z = count == 0 ? 0 : wave.height * std::exp(-d * d / 2);
    const double px = place.x - cx;
    const double py = place.y - cy;
    const double back = std::sin(yaw) * px + std::cos(yaw) * py;
    result[i] = {z, back * std::cos(pitch) - z * std::sin(pitch)};
    scene.pixels[i] = {
        width / 2 + scale * (std::cos(yaw) * px - std::sin(yaw) * py),
        height / 2 - scale * (back * std::sin(pitch) + (z - wave.height / 2) * std::cos(pitch))};
  }
  return result;
}

struct Face {
  Triangle_ids corners;
  double depth;
};

// The triangles from back to front.
std::vector<Face> faces(const Playback& playback, const std::vector<Raised>& raised) {
  std::vector<Face> result;
  for (const auto& [ids, offset] : playback.edges()) {
    const auto& [a, b] = ids;
    for (const Triangle_ids& corners :
         {Triangle_ids{a, b, playback.apex(a, b)}, Triangle_ids{b, a, playback.apex(b, a)}}) {
      const Point_id c = corners[2];
      // Each triangle once: at the edge between its two least corners.
      if (c == no_point || c < b) continue;
      result.push_back({corners, raised[a].depth + raised[b].depth + raised[c].depth});
    }
  }
  std::ranges::sort(result, [](const Face& f, const Face& g) {
    return f.depth != g.depth ? f.depth > g.depth : f.corners < g.corners;
  });
  return result;
}

// The brightness of the triangle, from 0 to 1.
double lit(const Scene& scene, const std::vector<Raised>& raised, const Triangle_ids& corners) {
  const auto& [a, b, c] = corners;
  const auto& places = scene.places;
  const double ux = places[b].x - places[a].x;
  const double uy = places[b].y - places[a].y;
  const double uz = raised[b].z - raised[a].z;
  const double vx = places[c].x - places[a].x;
  const double vy = places[c].y - places[a].y;
  const double vz = raised[c].z - raised[a].z;
  const double nx = uy * vz - uz * vy;
  const double ny = uz * vx - ux * vz;
  const double nz = ux * vy - uy * vx;
  const double length = std::sqrt(nx * nx + ny * ny + nz * nz);
  if (!(length > 0)) return 0;
  return std::max(0.0, (nx * light[0] + ny * light[1] + nz * light[2]) / length);
}

}  // namespace

void draw_wave(Svg_drawing& drawing, Scene& scene) {
  const Viewer_page& page = scene.page;
  const std::vector<Raised> raised =
      raise(scene, Extents(page).whole(), scene.camera.width(), scene.camera.height());
  const Theme& theme = scene.view.theme();
  std::deque<std::string> colors;  // whose elements do not move
  for (const auto& [corners, depth] : faces(scene.playback, raised)) {
    double level = 0;
    for (const Point_id id : corners) level += raised[id].z / (3 * page.settings.wave->height);
    // The same factors as on the page.
    const double strength = 0.5 + 0.56 * lit(scene, raised, corners);
    colors.push_back(color_between(wave_ramp, level, strength));
    const Color fill = {colors.back()};
    const Color line = !scene.view.shows(Layer::delaunay) ? fill
                       : level < dark_height              ? theme.wave_low_edge
                                                          : theme.wave_edge;
    drawing.polygon(
        "wave",
        {{scene.pixels[corners[0]], scene.pixels[corners[1]], scene.pixels[corners[2]]}, fill},
        {line, 0.8});
  }
  draw_selected_edge(drawing, scene);
  draw_events_around(drawing, scene);
  if (scene.view.shows(Layer::ids)) draw_ids(drawing, scene);
}

}  // namespace kinetri::app
