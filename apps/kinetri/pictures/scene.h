// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is to be drawn at one time, and the layers of which a picture consists.
#ifndef KINETRI_APPS_SCENE_H
#define KINETRI_APPS_SCENE_H

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "kinetri/impl/simulation/playback.h"
#include "kinetri/io/viewer_page.h"
#include "pictures/camera.h"
#include "pictures/cells.h"
#include "pictures/coloring.h"
#include "pictures/svg_drawing.h"
#include "pictures/theme.h"
#include "pictures/view_words.h"

namespace kinetri::app {

/// How many events happen where, on a grid over the extent of the run.
struct Heat {
  double left = 0;
  double bottom = 0;
  double side = 1;  ///< of a field
  std::size_t columns = 0;
  std::vector<int> levels;  ///< from 0 to heat_levels, by rows of the grid from the bottom
  double most = 0;          ///< events in a field
};

inline constexpr int heat_levels = 12;

/// What all pictures of a run have in common. All of it is known to be possible in the run.
struct View {
  std::array<bool, layer_names.size()> is_shown = {};
  std::optional<Point_id> point;  ///< that is selected
  bool follows_point = false;
  std::optional<Edge_ids> edge;  ///< that is selected
  std::optional<std::array<double, 3>> at;
  std::string unit;
  std::vector<Event_kind> kinds;  ///< of the events that are marked, and counted for the heat
  bool has_legend = false;
  bool has_scale = true;  ///< of colors, if there are any
  bool has_time = false;
  bool is_dark = false;
  double trail = 0;      ///< time that trails last
  double highlight = 0;  ///< time around an event in which it is marked, besides its own instant
  double fast = 0;       ///< a speed that few points exceed
  int decimals = 0;      ///< of the time

  bool shows(Layer layer) const { return is_shown[static_cast<std::size_t>(layer)]; }
  const Theme& theme() const { return is_dark ? dark_theme : light_theme; }
};

/// One moment, with the points on the picture.
struct Scene {
  const Viewer_page& page;
  const Playback& playback;
  const View& view;
  const Camera& camera;
  Detail detail;
  std::vector<Recorded_place> places;  ///< in the plane, by id
  std::vector<Pixel> pixels;           ///< the same on the picture; not finite if not there
  bool has_weights = false;
  bool has_discs = false;

  bool is_seen(const Pixel& p) const {
    return p.x >= 0 && p.y >= 0 && p.x <= camera.width() && p.y <= camera.height();
  }
  Segment segment(const Edge_ids& edge) const { return {pixels[edge[0]], pixels[edge[1]]}; }
};

// ---- layers of the flat picture, from the lowest on ----

void draw_box(Svg_drawing& drawing, const Scene& scene);
void draw_colors(Svg_drawing& drawing, const Scene& scene, const Coloring& coloring);
void draw_heat(Svg_drawing& drawing, const Scene& scene, const Heat& heat);
void draw_discs(Svg_drawing& drawing, const Scene& scene, bool are_colored);
void draw_trails(Svg_drawing& drawing, const Scene& scene);
void draw_edges(Svg_drawing& drawing, const Scene& scene);
void draw_voronoi(Svg_drawing& drawing, const Scene& scene);
void draw_links(Svg_drawing& drawing, const Scene& scene);
void draw_hull(Svg_drawing& drawing, const Scene& scene);
void draw_arrows(Svg_drawing& drawing, const Scene& scene);
void draw_selected_edge(Svg_drawing& drawing, const Scene& scene);
void draw_selected_point(Svg_drawing& drawing, const Scene& scene);
void draw_events_around(Svg_drawing& drawing, const Scene& scene);
void draw_points(Svg_drawing& drawing, const Scene& scene);
void draw_point_rings(Svg_drawing& drawing, const Scene& scene);
void draw_ids(Svg_drawing& drawing, const Scene& scene);
void draw_axes(Svg_drawing& drawing, const Scene& scene);

/// The surface of `kinetri wave`, seen at an angle; draws all of it.
void draw_wave(Svg_drawing& drawing, Scene& scene);

// ---- around the picture ----

/// The height of the strip at the lower side that they need; 0 if there are none.
double height_of_legend(const Viewer_page& page, const View& view, const Coloring* coloring,
                        double width);
/// The scale of colors, the scale bar and the legend, in that strip; the time.
void draw_legend(Svg_drawing& drawing, const Scene& scene, const Coloring* coloring,
                 const Heat* heat);

/// The heat of the run's events of these kinds.
Heat heat_of(const Viewer_page& page, const Box_2& extent, const std::vector<Event_kind>& kinds);

/// "3-7", or the names of the points.
std::string name_of(const Viewer_page& page, Point_id id);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SCENE_H
