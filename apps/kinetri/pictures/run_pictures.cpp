// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures/run_pictures.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "cli/text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {
namespace {

constexpr std::size_t most_with_ids = 40;  // points up to which ids are shown by default
constexpr double whole_run = 30;           // seconds in which a page plays a run, approximately
constexpr double seconds_of_trail = 6;     // of such playing

// The speed at which a page plays: 1, 2 or 5 times a power of ten.
double speed_of_page(double span) {
  if (!(span > 0)) return 1;
  const auto n = static_cast<int>(std::round(3 * std::log10(span / whole_run)));
  const int step = (n % 3 + 3) % 3;
  return std::array<double, 3>{1, 2, 5}[static_cast<std::size_t>(step)] *
         std::pow(10, (n - step) / 3);
}

// A speed that few points exceed at the start of their motions.
double fast_speed(const Recording& recording) {
  std::vector<double> speeds;
  for (const Recorded_motion& recorded : recording.motions) {
    if (!recorded.motion) continue;
    const Vector_2 v = rounded_velocity(*recorded.motion, recorded.motion->epoch);
    speeds.push_back(std::hypot(v.x, v.y));
  }
  if (speeds.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(speeds.size() - 1));
  std::ranges::nth_element(speeds, speeds.begin() + place);
  return speeds[static_cast<std::size_t>(place)];
}

// Whether changes of motion are left out, so that past positions are unknown.
bool turns_are_left_out(const Recording& recording) {
  return recording.is_thinned &&
         std::ranges::any_of(recording.motions, [](const Recorded_motion& motion) {
           return motion.event.has_value();
         });
}

std::optional<Point_id> point_of(const Viewer_page& page, std::size_t points,
                                 const std::string& text) {
  Point_id id = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, id);
  if (error == std::errc() && end == last && id < points) return id;
  const auto& names = page.settings.names;
  const auto found = std::ranges::find(names, text);
  if (found == names.end()) return std::nullopt;
  return static_cast<Point_id>(found - names.begin());
}

template <class Names, class Enumerators>
std::string names_of(const Names& names, const Enumerators& enumerators) {
  std::vector<std::string> result;
  for (const auto one : enumerators) result.emplace_back(names[static_cast<std::size_t>(one)]);
  return separated(result, ", ");
}

}  // namespace

Run_pictures::Run_pictures(const Viewer_page& page, const std::vector<View_source>& sources,
                           const Picture_options& options)
    : page_(page),
      options_(options),
      has_weights_(has_weights(page.recording)),
      has_discs_(page.settings.radius > 0 || has_weights_),
      playback_(page.recording),
      extents_(page) {
  const auto show = [this](Layer layer, bool is_shown) {
    view_.is_shown[static_cast<std::size_t>(layer)] = is_shown;
  };
  show(Layer::wave, page.settings.wave.has_value());
  show(Layer::delaunay, true);
  show(Layer::hull, !page.recording.periodic_box);
  show(Layer::discs, has_discs_);
  show(Layer::links, has_encounters(page));
  show(Layer::ids, playback_.points() <= most_with_ids);
  const double span =
      std::min(page.recording.until - page.recording.from, std::numeric_limits<double>::max());
  view_.trail = seconds_of_trail * speed_of_page(span);
  view_.highlight = options.highlight;
  view_.fast = fast_speed(page.recording);
  view_.has_time = options.has_time;
  view_.decimals =
      span > 0 ? static_cast<int>(std::clamp(2 - std::floor(std::log10(span)), 0.0, 12.0)) : 3;
  for (std::size_t i = 0; i < event_kinds; ++i) view_.kinds.push_back(static_cast<Event_kind>(i));
  for (const View_source& source : sources) follow(source);
  if (color_ != Quantity::none) coloring_.emplace(page, color_);
  if (view_.shows(Layer::heat)) heat_ = heat_of(page, extents_.whole(), view_.kinds);
}

void Run_pictures::follow(const View_source& source) {
  const auto& [name, words] = source;
  follow_time(source);
  follow_switches(source);
  if (words.edge) {
    const auto [a, b] = *words.edge;
    if (b >= playback_.points()) {
      refuse_view_word(name, "edge", joined(a, "-", b),
                       joined("ids from 0 to ", playback_.points() - 1));
    }
    view_.edge = words.edge;
    view_.edge_offset = words.edge_offset;
  }
  if (words.point) {
    view_.point = point_of(page_, playback_.points(), *words.point);
    if (!view_.point) {
      refuse_view_word(name, "point", *words.point, "the id or the name of a point");
    }
  }
  if (words.color) {
    const std::vector<Quantity> possible = quantities_of(page_);
    if (std::ranges::find(possible, *words.color) == possible.end()) {
      refuse_view_word(name, "color", quantity_names[static_cast<std::size_t>(*words.color)],
                       "one of " + names_of(quantity_names, possible));
    }
    color_ = *words.color;
  }
  if (words.follows_point) view_.follows_point = *words.follows_point;
  if (words.at) view_.at = words.at;
  if (words.kinds) view_.kinds = *words.kinds;
  if (words.unit) view_.unit = *words.unit;
  if (words.has_legend) view_.has_legend = view_.has_scale = *words.has_legend;
  if (words.is_dark) view_.is_dark = *words.is_dark;
}

void Run_pictures::follow_time(const View_source& source) {
  const Recording& recording = page_.recording;
  const auto& [name, words] = source;
  if (words.time) {
    if (*words.time < recording.from || *words.time > recording.until) {
      refuse_view_word(name, "t", joined(*words.time),
                       joined("a time of the run, from ", recording.from, " to ", recording.until));
    }
    time_ = words.time;
    row_.reset();
  }
  if (words.event) {
    if (*words.event > recording.events.size()) {
      refuse_view_word(name, "event", joined(*words.event),
                       joined("a whole number from 0 to ", recording.events.size()));
    }
    row_ = static_cast<std::size_t>(*words.event);
  }
}

void Run_pictures::follow_switches(const View_source& source) {
  const bool has_paths = !turns_are_left_out(page_.recording);
  std::vector<Layer> possible;
  for (std::size_t i = 0; i < layer_names.size(); ++i) {
    const auto layer = static_cast<Layer>(i);
    const bool is_possible = layer == Layer::wave    ? page_.settings.wave.has_value()
                             : layer == Layer::hull  ? !page_.recording.periodic_box
                             : layer == Layer::discs ? has_discs_
                             : layer == Layer::links ? has_encounters(page_)
                             : layer == Layer::heat  ? !page_.recording.events.empty()
                             : layer == Layer::trails || layer == Layer::arrows ? has_paths
                                                                                : true;
    if (is_possible) possible.push_back(layer);
  }
  for (const auto& [layer, is_on] : source.words.switches) {
    if (std::ranges::find(possible, layer) == possible.end()) {
      refuse_view_word(source.name, is_on ? "show" : "hide",
                       layer_names[static_cast<std::size_t>(layer)],
                       "of " + names_of(layer_names, possible));
    }
    view_.is_shown[static_cast<std::size_t>(layer)] = is_on;
  }
}

std::string Run_pictures::at(double time) {
  playback_.go_to(time);
  return draw();
}

std::string Run_pictures::after(std::size_t rows) {
  // All rows of an instant.
  const auto& events = page_.recording.events;
  while (rows > 0 && rows < events.size() && events[rows].time == events[rows - 1].time) ++rows;
  playback_.go_to_row(rows);
  return draw();
}

std::string Run_pictures::first() {
  return time_ && !row_ ? at(*time_) : after(row_.value_or(0));
}

std::string Run_pictures::draw() {
  const Coloring* coloring = coloring_ ? &*coloring_ : nullptr;
  const double strip = height_of_legend(page_, view_, coloring, options_.width);
  Camera camera(options_.width, options_.height, strip);
  const Box_2 extent = extents_.at(playback_.time());
  camera.fit(extent, view_.shows(Layer::axes));
  if (view_.at) camera.look((*view_.at)[0], (*view_.at)[1], (*view_.at)[2]);
  Places places(playback_);
  if (!has_weights_) places.set_radius(page_.settings.radius);
  if (view_.follows_point && view_.point && places[*view_.point].is_there) {
    camera.center(places[*view_.point].x, places[*view_.point].y);
  }
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  std::vector<Pixel> pixels;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Recorded_place& place = places[i];
    pixels.push_back(place.is_there ? camera.pixel(place.x, place.y) : Pixel{nowhere, nowhere});
  }
  Scene scene = {
      page_,        playback_, view_, camera, Detail(), std::move(places), std::move(pixels),
      has_weights_, has_discs_};
  const auto seen = static_cast<std::size_t>(std::ranges::count_if(
      scene.pixels, [&](const Pixel& pixel) { return scene.is_seen(pixel); }));
  scene.detail = Detail(camera.spacing(extent, seen));
  const std::string when = joined("t = ", playback_.time());
  const std::string& title = page_.settings.title;
  Svg_drawing drawing(options_.width, options_.height, view_.theme().background,
                      title.empty() ? when : joined(title, ", ", when));
  view_.shows(Layer::wave) ? draw_wave(drawing, scene) : draw_flat(drawing, scene);
  draw_legend(drawing, scene, coloring, heat_ ? &*heat_ : nullptr);
  return drawing.svg();
}

void Run_pictures::draw_flat(Svg_drawing& drawing, Scene& scene) const {
  if (coloring_) draw_colors(drawing, scene, *coloring_);
  if (heat_) draw_heat(drawing, scene, *heat_);
  draw_box(drawing, scene);
  if (view_.shows(Layer::discs)) draw_discs(drawing, scene, coloring_.has_value());
  if (view_.shows(Layer::trails)) draw_trails(drawing, scene);
  if (view_.shows(Layer::delaunay)) draw_edges(drawing, scene);
  if (view_.shows(Layer::voronoi)) draw_voronoi(drawing, scene);
  if (view_.shows(Layer::links)) draw_links(drawing, scene);
  if (view_.shows(Layer::hull)) draw_hull(drawing, scene);
  if (view_.shows(Layer::arrows)) draw_arrows(drawing, scene);
  draw_selected_edge(drawing, scene);
  draw_selected_point(drawing, scene);
  draw_events_around(drawing, scene);
  draw_points(drawing, scene);
  draw_point_rings(drawing, scene);
  if (view_.shows(Layer::ids)) draw_ids(drawing, scene);
  if (view_.shows(Layer::axes)) draw_axes(drawing, scene);
}

}  // namespace kinetri::app
