// SPDX-License-Identifier: GPL-3.0-or-later
//
// The layers of the flat picture, drawn as on the page (viewer/flat_view.js, overlays.js).
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "kinetri/impl/io/text.h"
#include "pictures/scene.h"

namespace kinetri::app {
namespace {

constexpr int trail_parts = 5;           // each fainter than the previous one
constexpr int trail_steps = 4;           // per part, if the point accelerates
constexpr double coincident_ring = 2.5;  // from the dot to the ring about it
constexpr std::size_t most_arrows = 1500;
constexpr std::size_t most_events_shown =
    24;  // before and after the time, apart from those at the time

// Circles of radius(place) about the hidden points, or about the others; without those that
// coincide with the one that is shown.
template <class Radius>
std::vector<Circle> circles_of(const Scene& scene, bool are_hidden, const Radius& radius) {
  std::vector<Circle> result;
  for (Point_id i = 0; i < scene.places.size(); ++i) {
    const Recorded_place& place = scene.places[i];
    if (!place.is_there || place.is_hidden != are_hidden || scene.playback.shown(i) != i) continue;
    result.push_back({scene.pixels[i], radius(place)});
  }
  return result;
}

// Adds the path of a point from `end` back to `begin`, through its changes of motion.
void add_path(std::vector<Segment>& path, const Scene& scene, Point_id id, double begin,
              double end) {
  const Recording& recording = scene.playback.recording();
  for (auto index = scene.playback.index_of_motion(id); index;
       index = scene.playback.previous_motion(*index)) {
    const std::optional<std::size_t>& event = recording.motions[*index].event;
    const auto& motion = recording.motions[*index].motion;
    const double start = event ? recording.events[*event].time.nearest : recording.from;
    if (start >= end) continue;
    const double first = std::max(start, begin);
    if (motion) {
      const bool is_straight = motion->acceleration == Vector_2() && motion->jerk == Vector_2();
      const int steps = is_straight ? 1 : trail_steps;
      const auto pixel = [&](int step) {
        const double time = end + (first - end) * step / steps;
        const Recorded_place place = place_of(*motion, time);
        const Vector_2 move = scene.places.move_at(id, time);
        return scene.camera.pixel(place.x + move.x, place.y + move.y);
      };
      for (int step = 0; step < steps; ++step) path.push_back({pixel(step), pixel(step + 1)});
    }
    if (start <= begin) return;
    end = start;
  }
}

// The center of the triangle to the left of the edge from the place of p to the image q; none if
// there is no triangle.
std::optional<Vector_2> center_at(const Scene& scene, const Periodic_image& p,
                                  const Periodic_image& q, Point_id from) {
  const Periodic_image apex = scene.playback.apex(p, q);
  if (apex.id == no_point) return std::nullopt;
  const Places& places = scene.places;
  const bool is_forward = p.id == from && p.offset == Lattice_offset_2();
  const Periodic_image& other = is_forward ? q : p;
  const Vector_2 c =
      power_center(places[from], places.image(from, other), places.image(from, apex));
  if (!std::isfinite(c.x) || !std::isfinite(c.y)) return std::nullopt;
  return c;
}

// The two ends of an edge, as its first end sees them.
std::array<Periodic_image, 2> ends_of(const Periodic_edge& edge) {
  return {Periodic_image{edge.ids[0], {}}, Periodic_image{edge.ids[1], edge.offset}};
}

// The dual edge in the diagram: between the centers of the two triangles at the edge, or a ray from
// the center of its only triangle, or a line. Rays end outside of the picture. In a periodic box it
// is beside the first end.
Segment voronoi_edge(const Scene& scene, const Periodic_edge& edge) {
  const auto [first, second] = ends_of(edge);
  const Point_id a = first.id;
  const Point_id b = second.id;
  const auto pixel = [&](const std::optional<Vector_2>& c) -> std::optional<Pixel> {
    if (!c) return std::nullopt;
    return scene.camera.pixel(c->x, c->y);
  };
  const std::optional<Pixel> left = pixel(center_at(scene, first, second, a));
  const std::optional<Pixel> right = pixel(center_at(scene, second, first, a));
  if (left && right) return {*left, *right};
  const Pixel& p = scene.pixels[a];
  const Pixel& q = scene.pixels[b];
  const double dx = q.x - p.x;
  const double dy = q.y - p.y;
  const double length = std::hypot(dx, dy);
  const double scale = scene.camera.scale();
  // Where the edge of the diagram crosses the line of ab.
  const double part = 0.5 + (scene.places[a].weight - scene.places[b].weight) * scale * scale /
                                (2 * length * length);
  const Pixel crossing = {p.x + part * dx, p.y + part * dy};
  // In the picture y points down, so (dy, -dx) is to the left of ab.
  const double ux = dy / length;
  const double uy = -dx / length;
  // The center may be far from the picture, but the ray must cross the picture.
  const auto far_from = [&](const Pixel& from, double sign) {
    const double reach = 4 * (scene.camera.width() + scene.camera.height()) +
                         std::hypot(from.x - crossing.x, from.y - crossing.y);
    return Pixel{from.x + sign * reach * ux, from.y + sign * reach * uy};
  };
  return {left ? *left : far_from(right ? *right : crossing, 1),
          right ? *right : far_from(left ? *left : crossing, -1)};
}

std::vector<Periodic_edge> edges_at(const Scene& scene, Point_id id) {
  std::vector<Periodic_edge> result;
  for (const Periodic_edge& edge : scene.playback.edges()) {
    if (edge.ids[0] == id || edge.ids[1] == id) result.push_back(edge);
  }
  return result;
}

bool is_there(const Scene& scene, Point_id id) {
  return id < scene.places.size() && scene.places[id].is_there;
}

void draw_ring(Svg_drawing& drawing, const Scene& scene, std::string_view name, Point_id id,
               double more, const Color& color, double width) {
  if (!is_there(scene, id)) return;
  drawing.circles(name, {{scene.pixels[id], scene.detail.dot_radius() + more}}, {}, {color, width});
}

void draw_event(Svg_drawing& drawing, const Scene& scene, const Recorded_event& event,
                double strength, bool is_ahead) {
  const Theme& theme = scene.view.theme();
  if (std::ranges::find(scene.view.kinds, event.kind) == scene.view.kinds.end()) return;
  const auto can_be_drawn = [&](const std::optional<Edge_ids>& edge) {
    return edge && is_there(scene, (*edge)[0]) && is_there(scene, (*edge)[1]);
  };
  if (can_be_drawn(event.removed)) {
    drawing.lines("removed", scene.segments({*event.removed, event.removed_offset}),
                  {theme.removed.faded(strength), 2.5, true, "7 5"});
  }
  if (is_ahead) return;
  if (can_be_drawn(event.added)) {
    drawing.lines("added", scene.segments({*event.added, event.added_offset}),
                  {theme.added.faded(strength), 4, true});
  }
  for (const auto& point : {event.point_a, event.point_b}) {
    if (point) draw_ring(drawing, scene, "event", *point, 5, theme.added.faded(strength), 2.5);
  }
}

}  // namespace

std::vector<Segment> Scene::segments(const Periodic_edge& edge) const {
  const auto [a, b] = edge.ids;
  const Vector_2 shift = places.shift(a, {b, edge.offset});
  if (shift == Vector_2()) return {segment(edge.ids)};
  const Periodic_image back = {a, offset_between(edge.offset, {})};
  return {{pixels[a], pixel(a, {b, edge.offset})}, {pixels[b], pixel(b, back)}};
}

void draw_box(Svg_drawing& drawing, const Scene& scene) {
  if (const auto& box = scene.places.box()) {
    std::vector<Segment> sides;
    const auto corners = box->corners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector_2& p = corners[i];
      const Vector_2& q = corners[(i + 1) % corners.size()];
      sides.push_back({scene.camera.pixel(p.x, p.y), scene.camera.pixel(q.x, q.y)});
    }
    drawing.lines("box", sides, {scene.view.theme().box, 2, true});
    return;
  }
  if (!scene.page.settings.box) return;
  const Box_2& box = *scene.page.settings.box;
  const Pixel a = scene.camera.pixel(box.xmin, box.ymin);
  const Pixel c = scene.camera.pixel(box.xmax, box.ymax);
  const Pixel b = {c.x, a.y};
  const Pixel d = {a.x, c.y};
  drawing.lines("box", {{a, b}, {b, c}, {c, d}, {d, a}}, {scene.view.theme().box, 2, true});
}

// The discs, or the cells.
void draw_colors(Svg_drawing& drawing, const Scene& scene, const Coloring& coloring) {
  const std::vector<Cell> all = cells(scene.playback, scene.places, scene.page.settings.box);
  const auto colors = coloring.colors(scene.playback, scene.places, all);
  if (scene.has_discs && scene.view.shows(Layer::discs)) {
    std::vector<Circle> discs;
    std::vector<Color> fills;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!colors[i] || scene.places[i].is_hidden) continue;
      discs.push_back({scene.pixels[i], scene.places[i].radius * scene.camera.scale()});
      fills.push_back(*colors[i]);
    }
    drawing.circles("colors", discs, fills);
    return;
  }
  std::vector<Filled_polygon> polygons;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!colors[i] || all[i].corners.empty()) continue;
    for (const Vector_2& move : scene.places.copies(all[i].corners)) {
      Filled_polygon& polygon = polygons.emplace_back();
      polygon.color = *colors[i];
      for (const Vector_2& p : all[i].corners) {
        polygon.corners.push_back(scene.camera.pixel(p.x + move.x, p.y + move.y));
      }
    }
  }
  drawing.polygons("colors", polygons);
}

void draw_heat(Svg_drawing& drawing, const Scene& scene, const Heat& heat) {
  for (std::size_t i = 0; i < heat.levels.size(); ++i) {
    if (heat.levels[i] == 0) continue;
    const double column = static_cast<double>(i % heat.columns);
    const double row = static_cast<double>(i / heat.columns);
    // Whole pixels, so that there are no gaps between fields.
    const double left = std::round(scene.camera.x(heat.left + column * heat.side));
    const double right = std::round(scene.camera.x(heat.left + (column + 1) * heat.side));
    const double top = std::round(scene.camera.y(heat.bottom + (row + 1) * heat.side));
    const double bottom = std::round(scene.camera.y(heat.bottom + row * heat.side));
    drawing.rectangle("heat", {left, top}, right - left, bottom - top,
                      {"#d55e00", 0.75 * heat.levels[i] / heat_levels});
  }
}

// The other images of discs that reach into the periodic box.
std::vector<Circle> disc_images(const Scene& scene) {
  std::vector<Circle> result;
  for (Point_id i = 0; i < scene.places.size(); ++i) {
    const Recorded_place& place = scene.places[i];
    if (!place.is_there || place.is_hidden) continue;
    for (const Vector_2& move : scene.places.disc_copies(i)) {
      result.push_back({scene.camera.pixel(place.x + move.x, place.y + move.y),
                        place.radius * scene.camera.scale()});
    }
  }
  return result;
}

void draw_discs(Svg_drawing& drawing, const Scene& scene, bool are_colored) {
  const Theme& theme = scene.view.theme();
  const auto radius = [&](const Recorded_place& place) {
    return place.radius * scene.camera.scale();
  };
  drawing.circles("discs", circles_of(scene, false, radius),
                  are_colored ? Color() : theme.disc_fill, {theme.disc, scene.detail.line_width()});
  drawing.circles("hidden-discs", circles_of(scene, true, radius), {},
                  {theme.quiet, 1.25, false, "4 3"});
  if (!scene.places.box()) return;
  drawing.circles("disc-images", disc_images(scene),
                  are_colored ? Color() : theme.disc_fill.faded(leaving),
                  {theme.disc.faded(leaving), scene.detail.line_width()});
}

void draw_trails(Svg_drawing& drawing, const Scene& scene) {
  const double length = scene.view.trail / trail_parts;
  const double from = scene.playback.recording().from;
  for (int part = 0; part < trail_parts; ++part) {
    const double end = scene.playback.time() - part * length;
    if (end <= from) break;
    std::vector<Segment> path;
    for (std::size_t id = 0; id < scene.places.size(); ++id) {
      add_path(path, scene, static_cast<Point_id>(id), std::max(end - length, from), end);
    }
    const double alpha = 0.95 * (1 - static_cast<double>(part) / trail_parts);
    drawing.lines("trails", path, {scene.view.theme().trail.faded(alpha), 2.2, true});
  }
}

void draw_edges(Svg_drawing& drawing, const Scene& scene) {
  const bool is_behind = scene.view.shows(Layer::voronoi);
  const double alpha = scene.detail.edge_strength(is_behind);
  if (alpha == 0) return;
  std::vector<Segment> edges;
  std::vector<Segment> leaving_edges;
  std::vector<Circle> images;
  for (const Periodic_edge& edge : scene.playback.edges()) {
    const std::vector<Segment> segments = scene.segments(edge);
    if (segments.size() == 1) {
      edges.push_back(segments[0]);
      continue;
    }
    for (const Segment& segment : segments) {
      leaving_edges.push_back(segment);
      images.push_back({segment.to, scene.detail.dot_radius()});
    }
  }
  const Theme& theme = scene.view.theme();
  const Color& color = is_behind ? theme.edge_behind : theme.edge;
  drawing.lines("edges", edges, {color.faded(alpha), scene.detail.line_width()});
  if (!scene.places.box()) return;
  drawing.lines("leaving-edges", leaving_edges,
                {color.faded(leaving * alpha), scene.detail.line_width()});
  drawing.circles("images", images, theme.point.faded(leaving * scene.detail.dot_strength()));
}

void draw_voronoi(Svg_drawing& drawing, const Scene& scene) {
  const double alpha = scene.detail.edge_strength();
  if (alpha == 0) return;
  std::vector<Segment> edges;
  for (const Periodic_edge& edge : scene.playback.edges()) {
    if (!scene.places.box()) {
      edges.push_back(voronoi_edge(scene, edge));
      continue;
    }
    const auto [a, b] = ends_of(edge);
    const auto left = center_at(scene, a, b, a.id);
    const auto right = center_at(scene, b, a, a.id);
    if (!left || !right) continue;  // numbers overflow
    for (const Vector_2& move : scene.places.copies(std::array{*left, *right})) {
      edges.push_back({scene.camera.pixel(left->x + move.x, left->y + move.y),
                       scene.camera.pixel(right->x + move.x, right->y + move.y)});
    }
  }
  drawing.lines("voronoi", edges,
                {scene.view.theme().voronoi.faded(alpha), scene.detail.line_width() + 0.2});
}

void draw_hull(Svg_drawing& drawing, const Scene& scene) {
  std::vector<Segment> hull;
  for (const Periodic_edge& edge : scene.playback.edges()) {
    const auto [a, b] = ends_of(edge);
    if (scene.playback.apex(a, b).id == no_point || scene.playback.apex(b, a).id == no_point) {
      hull.push_back(scene.segment(edge.ids));
    }
  }
  drawing.lines("hull", hull, {scene.view.theme().hull, 2, true});
}

// The length of an arrow is the way of its point in the time in which a fast point reaches its
// neighbor. If there are many points, only some have arrows.
void draw_arrows(Svg_drawing& drawing, const Scene& scene) {
  constexpr double head = 0.28;
  constexpr double turn = 0.45;
  const auto seen = static_cast<std::size_t>(std::ranges::count_if(
      scene.pixels, [&](const Pixel& pixel) { return scene.is_seen(pixel); }));
  const std::size_t step = std::max<std::size_t>((seen + most_arrows - 1) / most_arrows, 1);
  const double length =
      std::max(1.6 * scene.detail.spacing() * std::sqrt(static_cast<double>(step)), 14.0);
  const double per_unit = std::min(length, 60.0) / (scene.view.fast > 0 ? scene.view.fast : 1);
  std::vector<Segment> arrows;
  std::size_t number = 0;
  for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
    const Pixel& from = scene.pixels[i];
    if (!scene.is_seen(from) || number++ % step != 0) continue;
    const Vector_2 v =
        rounded_velocity(*scene.playback.motion(static_cast<Point_id>(i)), scene.playback.time());
    const Vector_2 rate = scene.places.rate(static_cast<Point_id>(i));
    const double dx = per_unit * (v.x + rate.x);
    const double dy = -per_unit * (v.y + rate.y);
    if (dx == 0 && dy == 0) continue;
    const Pixel to = {from.x + dx, from.y + dy};
    arrows.push_back({from, to});
    for (const double angle : {turn, -turn}) {
      const double cos = head * std::cos(angle);
      const double sin = head * std::sin(angle);
      arrows.push_back({to, {to.x - cos * dx + sin * dy, to.y - sin * dx - cos * dy}});
    }
  }
  drawing.lines("arrows", arrows, {scene.view.theme().arrow, 1.5, true});
}

// The selected edge, if it is there.
std::optional<Periodic_edge> selected_edge(const Scene& scene) {
  const auto& ids = scene.view.edge;
  if (!ids) return std::nullopt;
  for (const Periodic_edge& edge : scene.playback.edges()) {
    if (edge.ids != *ids) continue;
    if (!scene.places.box() || !scene.view.edge_offset || edge.offset == *scene.view.edge_offset) {
      return edge;
    }
  }
  return std::nullopt;
}

// The selected edge with its quadrilateral.
void draw_selected_edge(Svg_drawing& drawing, const Scene& scene) {
  const std::optional<Periodic_edge> edge = selected_edge(scene);
  if (!edge) return;
  const auto [a, b] = ends_of(*edge);
  const Theme& theme = scene.view.theme();
  const Pixel& p = scene.pixels[a.id];
  const Pixel q = scene.pixel(a.id, b);
  std::vector<Segment> sides;
  std::vector<Filled_polygon> triangles;
  for (const Periodic_image& c : {scene.playback.apex(a, b), scene.playback.apex(b, a)}) {
    if (c.id == no_point) continue;
    const Pixel r = scene.pixel(a.id, c);
    sides.push_back({p, r});
    sides.push_back({r, q});
    triangles.push_back({{p, r, q}, theme.selected_fill});
  }
  drawing.polygons("quadrilateral", triangles);
  drawing.lines("quadrilateral", sides, {theme.selected, 1.5, false, "2 4"});
  drawing.lines("selected", scene.segments(*edge), {theme.background, 7});
  drawing.lines("selected", scene.segments(*edge), {theme.selected, 4});
}

// The selected point with its cell and its edges.
void draw_selected_point(Svg_drawing& drawing, const Scene& scene) {
  if (!scene.view.point) return;
  const Theme& theme = scene.view.theme();
  std::vector<Segment> sides;
  std::vector<Segment> edges;
  for (const Periodic_edge& edge : edges_at(scene, *scene.view.point)) {
    const Segment side = voronoi_edge(scene, edge);
    if (edge.ids[0] == *scene.view.point) sides.push_back(side);
    if (edge.ids[1] == *scene.view.point) {
      // In a periodic box, beside the second end.
      const Vector_2 shift = scene.places.shift(edge.ids[0], {edge.ids[1], edge.offset});
      const double scale = scene.camera.scale();
      const auto moved = [&](const Pixel& pixel) {
        return Pixel{pixel.x - shift.x * scale, pixel.y + shift.y * scale};
      };
      sides.push_back({moved(side.from), moved(side.to)});
    }
    const std::vector<Segment> segments = scene.segments(edge);
    edges.insert(edges.end(), segments.begin(), segments.end());
  }
  drawing.lines("cell", sides, {theme.background, 5, true});
  drawing.lines("cell", sides, {theme.voronoi, 3, true});
  drawing.lines("selected", edges, {theme.selected, 1.8});
}

void draw_point_rings(Svg_drawing& drawing, const Scene& scene) {
  if (!scene.view.point) return;
  const Theme& theme = scene.view.theme();
  const Point_id point = *scene.view.point;
  for (const auto& [ids, offset] : edges_at(scene, point)) {
    const auto& [a, b] = ids;
    draw_ring(drawing, scene, "neighbor", a == point ? b : a, 3, theme.selected, 1.5);
  }
  draw_ring(drawing, scene, "selected", point, 6, theme.background, 6);
  draw_ring(drawing, scene, "selected", point, 6, theme.added, 3);
}

// Draws removed edges dashed, added ones bold.
void draw_events_around(Svg_drawing& drawing, const Scene& scene) {
  const Recording& recording = scene.playback.recording();
  const double time = scene.playback.time();
  const std::size_t rows = scene.playback.rows();
  const double reach = scene.view.highlight;
  for (std::size_t row = rows; row-- > 0;) {
    const double since = time - shown_time(recording, row);
    const bool is_now = since == 0 && recording.events[row].time == recording.events[rows - 1].time;
    if (!is_now && !(since < reach && row + most_events_shown >= rows)) break;
    draw_event(drawing, scene, recording.events[row], is_now ? 1 : 1 - since / reach, false);
  }
  for (std::size_t row = rows; row < recording.events.size() && row < rows + most_events_shown;
       ++row) {
    const double ahead = recording.events[row].time.nearest - time;
    if (!(ahead < reach)) break;
    draw_event(drawing, scene, recording.events[row], 0.8 * (1 - std::max(ahead, 0.0) / reach),
               true);
  }
}

void draw_points(Svg_drawing& drawing, const Scene& scene) {
  const Theme& theme = scene.view.theme();
  const auto radius = [&](const Recorded_place&) { return scene.detail.dot_radius(); };
  drawing.circles("points", circles_of(scene, false, radius),
                  theme.point.faded(scene.detail.dot_strength()));
  drawing.circles("hidden-points", circles_of(scene, true, radius), theme.background,
                  {theme.quiet, 1.25});
  const std::vector<std::size_t> coincident = scene.playback.numbers_of_coincident();
  std::vector<Circle> rings;
  for (std::size_t i = 0; i < coincident.size(); ++i) {
    if (coincident[i] == 0) continue;
    rings.push_back({scene.pixels[i], scene.detail.dot_radius() + coincident_ring});
  }
  drawing.circles("coincident", rings, {}, {theme.point, 1.25});
}

// Draws as many ids as fit, lesser ones first: "3", or "3 +2" if two others coincide with it.
void draw_ids(Svg_drawing& drawing, const Scene& scene) {
  constexpr double size = 11;
  struct Label {
    double left, top, right, bottom;
  };
  std::vector<Label> labels;
  const Theme& theme = scene.view.theme();
  const std::vector<std::size_t> coincident = scene.playback.numbers_of_coincident();
  for (Point_id i = 0; i < scene.pixels.size(); ++i) {
    const Pixel& pixel = scene.pixels[i];
    if (!scene.is_seen(pixel) || scene.playback.shown(i) != i) continue;
    std::string name = name_of(scene.page, i);
    if (coincident[i] > 0) append(name, " +", coincident[i]);
    const Pixel place = {pixel.x + 6, pixel.y - 5};
    const Label label = {place.x, place.y - size, place.x + width_of_text(name, size), place.y + 2};
    const bool is_taken = std::ranges::any_of(labels, [&](const Label& other) {
      return label.left < other.right && other.left < label.right && label.top < other.bottom &&
             other.top < label.bottom;
    });
    if (is_taken) continue;
    labels.push_back(label);
    drawing.text(name, place, {theme.text, theme.background, size});
  }
}

std::string name_of(const Viewer_page& page, Point_id id) {
  return page.settings.names.empty() ? joined(id) : page.settings.names[id];
}

}  // namespace kinetri::app
