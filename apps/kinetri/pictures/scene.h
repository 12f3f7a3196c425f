// SPDX-License-Identifier: GPL-3.0-or-later
//
// The state to draw at one time, and the layers of a picture.
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
#include "pictures/places.h"
#include "pictures/svg_drawing.h"
#include "pictures/theme.h"
#include "pictures/view_words.h"

namespace kinetri::app {

/// The heat map: counts of events on a grid over the extent of the run.
struct Heat {
  double left = 0;
  double bottom = 0;
  double side = 1;  ///< of a field
  std::size_t columns = 0;
  std::vector<int> levels;  ///< from 0 to heat_levels, by rows of the grid from the bottom
  double most = 0;          ///< events in a field
};

inline constexpr int heat_levels = 12;

/// The settings of all pictures of a run, checked against the run.
struct View {
  std::array<bool, layer_names.size()> is_shown = {};
  std::optional<Point_id> point;  ///< that is selected
  bool follows_point = false;
  std::optional<Edge_ids> edge;  ///< that is selected
  /// Its offset in a periodic box; none: the first such edge.
  std::optional<Lattice_offset_2> edge_offset;
  std::optional<std::array<double, 3>> at;
  std::string unit;
  std::vector<Event_kind> kinds;  ///< of the events that are marked, and counted for the heat
  bool has_legend = false;
  bool has_scale = true;  ///< of colors, if there are any
  bool has_time = false;
  bool is_dark = false;
  double trail = 0;      ///< duration of trails
  double highlight = 0;  ///< time before and after an event in which it is marked
  double fast = 0;       ///< a speed that few points exceed
  int decimals = 0;      ///< of the time

  bool shows(Layer layer) const { return is_shown[static_cast<std::size_t>(layer)]; }
  const Theme& theme() const { return is_dark ? dark_theme : light_theme; }
};

/// Strength of what is outside of a periodic box.
constexpr double leaving = 0.45;

/// The state at one time, with the points on the picture.
struct Scene {
  const Viewer_page& page;
  const Playback& playback;
  const View& view;
  const Camera& camera;
  Detail detail;
  Places places;              ///< in the plane, by id
  std::vector<Pixel> pixels;  ///< on the picture; not finite if the point does not exist
  bool has_weights = false;
  bool has_discs = false;

  bool is_seen(const Pixel& p) const {
    return p.x >= 0 && p.y >= 0 && p.x <= camera.width() && p.y <= camera.height();
  }
  Segment segment(const Edge_ids& edge) const { return {pixels[edge[0]], pixels[edge[1]]}; }
  /// Of an image, as of Places::image.
  Pixel pixel(Point_id from, const Periodic_image& to) const {
    const Recorded_place place = places.image(from, to);
    return place.is_there ? camera.pixel(place.x, place.y) : pixels[to.id];
  }
  /// The segment of the edge; of one that leaves a periodic box both, one from each end.
  std::vector<Segment> segments(const Periodic_edge& edge) const;
};

// ---- layers of the flat picture, the lowest first ----

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

/// Draws the surface of `kinetri wave`, seen at an angle.
void draw_wave(Svg_drawing& drawing, Scene& scene);

// ---- around the picture ----

/// The height of the strip for scale and legend at the lower side; 0 if there is none.
double height_of_legend(const Viewer_page& page, const View& view, const Coloring* coloring,
                        double width);
/// Draws color scale, scale bar and legend in that strip, and the time.
void draw_legend(Svg_drawing& drawing, const Scene& scene, const Coloring* coloring,
                 const Heat* heat);

/// The heat map of the run's events of these kinds.
Heat heat_of(const Viewer_page& page, const Box_2& extent, const std::vector<Event_kind>& kinds);

/// "3-7", or the names of the points.
std::string name_of(const Viewer_page& page, Point_id id);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SCENE_H
