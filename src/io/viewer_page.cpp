// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/viewer_page.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/events/event.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/io/bytes.h"
#include "kinetri/impl/io/json_writer.h"
#include "kinetri/impl/simulation/playback.h"
#include "kinetri/version.h"
#include "viewer_assets.h"

namespace kinetri {
namespace {

// Point ids, with the width for the number of points.
class Id_bytes {
 public:
  explicit Id_bytes(std::size_t points) : is_short_(points <= 65'536) {}

  void add(Point_id id) {
    if (is_short_) return bytes_.add(static_cast<std::uint16_t>(id));
    bytes_.add(std::uint32_t{id});
  }
  void add(const Edge_ids& edge) {
    add(edge[0]);
    add(edge[1]);
  }
  void add(const Triangle_ids& corners) {
    for (const Point_id corner : corners) add(corner);
  }
  std::string base64() const { return bytes_.base64(); }

 private:
  Bytes bytes_;
  bool is_short_;
};

// Each id has a motion.
std::size_t number_of_points(const Recording& recording) {
  std::size_t result = 0;
  for (const Recorded_motion& motion : recording.motions) {
    result = std::max(result, std::size_t{motion.point} + 1);
  }
  return result;
}

int degree(const Recording& recording) {
  int result = 1;
  for (const Recorded_motion& recorded : recording.motions) {
    if (!recorded.motion) continue;
    const Vector_2 zero;
    if (recorded.motion->jerk != zero) return 3;
    if (recorded.motion->acceleration != zero) result = 2;
  }
  return result;
}

// The offsets of edges, encounters, or corners of triangles; not written in the plane.
class Offset_bytes {
 public:
  void add(const Lattice_offset_2& offset) {
    bytes_.add(static_cast<std::uint32_t>(offset.x));
    bytes_.add(static_cast<std::uint32_t>(offset.y));
  }
  void add(const std::array<Lattice_offset_2, 2>& offsets) {
    add(offsets[0]);
    add(offsets[1]);
  }
  void write(Json_writer& json, const char* key, const Recording& recording) const {
    if (recording.periodic_box) json.member(key, bytes_.base64());
  }

 private:
  Bytes bytes_;
};

// The edges at the start that are not sides of triangles.
std::string initial_edges(const Recording& recording, std::size_t points) {
  if (recording.periodic_box) return {};
  std::vector<Edge_ids> sides;
  for (const auto& [a, b, c] : recording.initial_triangles) {
    sides.insert(sides.end(), {edge_ids(a, b), edge_ids(b, c), edge_ids(c, a)});
  }
  std::ranges::sort(sides);
  Id_bytes ids(points);
  for (const Edge_ids& edge : recording.initial_edges) {
    if (!std::ranges::binary_search(sides, edge)) ids.add(edge);
  }
  return ids.base64();
}

// The triangles that a flip changes follow from its edges.
void write_triangles(Json_writer& json, const Recording& recording, std::size_t points) {
  Id_bytes initial(points);
  for (const Triangle_ids& corners : recording.initial_triangles) initial.add(corners);
  Offset_bytes initial_offsets;
  for (const auto& offsets : recording.initial_offsets) initial_offsets.add(offsets);
  Offset_bytes offsets;
  Bytes event;
  Bytes removed;
  Bytes added;
  Id_bytes ids(points);
  std::size_t count = 0;
  const auto& changes = recording.triangles;
  for (auto change = changes.begin(); change != changes.end();) {
    const std::size_t row = change->event;
    const bool is_flip = recording.events[row].kind == Event_kind::flip;
    std::array<std::uint32_t, 2> numbers = {0, 0};
    for (; change != changes.end() && change->event == row; ++change) {
      if (is_flip) continue;
      ++numbers[change->is_added ? 1 : 0];
      ids.add(change->corners);
      offsets.add(change->offsets);
    }
    if (is_flip) continue;
    ++count;
    event.add(static_cast<std::uint32_t>(row));
    removed.add(numbers[0]);
    added.add(numbers[1]);
  }
  json.begin_object();
  json.member("initial", initial.base64());
  initial_offsets.write(json, "initial_offsets", recording);
  json.member("count", count);
  json.member("event", event.base64());
  json.member("removed", removed.base64());
  json.member("added", added.base64());
  json.member("ids", ids.base64());
  offsets.write(json, "offsets", recording);
  json.end_object();
}

void write_motions(Json_writer& json, const Recording& recording, std::size_t points) {
  const int terms = degree(recording);
  std::size_t starting = 0;
  Bytes event;
  Id_bytes point(points);
  Bytes there;
  Bytes data;
  Bytes sizes;
  for (const Recorded_motion& recorded : recording.motions) {
    if (!recorded.event) ++starting;
    event.add(static_cast<std::uint32_t>(recorded.event.value_or(0)));
    point.add(recorded.point);
    there.add(static_cast<std::uint8_t>(recorded.motion.has_value()));
    const Polynomial_disc_motion_2 motion = recorded.motion.value_or(Polynomial_disc_motion_2());
    const std::array<Vector_2, 4> derivatives = {motion.position, motion.velocity,
                                                 motion.acceleration, motion.jerk};
    data.add(motion.epoch);
    for (int i = 0; i <= terms; ++i) {
      data.add(derivatives[static_cast<std::size_t>(i)].x);
      data.add(derivatives[static_cast<std::size_t>(i)].y);
    }
    for (const double size : {motion.radius, motion.growth, motion.weight}) sizes.add(size);
  }
  json.begin_object();
  json.member("count", recording.motions.size());
  json.member("degree", terms);
  json.member("starting", starting);
  json.member("event", event.base64());
  json.member("point", point.base64());
  json.member("there", there.base64());
  json.member("data", data.base64());
  if (has_weights(recording)) json.member("sizes", sizes.base64());
  json.end_object();
}

void write_coincidences(Json_writer& json, const Recording& recording, std::size_t points) {
  std::size_t starting = 0;
  Bytes event;
  Id_bytes point(points);
  Id_bytes shown(points);
  for (const Recorded_coincidence& coincidence : recording.coincidences) {
    if (!coincidence.event) ++starting;
    event.add(static_cast<std::uint32_t>(coincidence.event.value_or(0)));
    point.add(coincidence.point);
    shown.add(coincidence.shown);
  }
  json.key("coincidences");
  json.begin_object();
  json.member("count", recording.coincidences.size());
  json.member("starting", starting);
  json.member("event", event.base64());
  json.member("point", point.base64());
  json.member("shown", shown.base64());
  json.end_object();
}

std::uint8_t fields(const Recorded_event& event) {
  const auto& [nearest, bounds] = event.time;
  return static_cast<std::uint8_t>((event.removed ? 1 : 0) | (event.added ? 2 : 0) |
                                   (event.point_a ? 4 : 0) | (event.point_b ? 8 : 0) |
                                   (nearest < bounds.upper ? 16 : 0) |
                                   (nearest > bounds.lower ? 32 : 0));
}

void write_events(Json_writer& json, const Recording& recording, std::size_t points) {
  const bool are_all_there = !recording.events.empty() && !recording.is_thinned;
  const std::uint64_t first = are_all_there ? recording.events.front().number : 0;
  Bytes kind;
  Bytes present;
  Bytes time;
  Id_bytes ids(points);
  Offset_bytes offsets;
  for (const Recorded_event& event : recording.events) {
    kind.add(static_cast<std::uint8_t>(event.kind));
    present.add(fields(event));
    time.add(event.time.nearest);
    if (event.removed) ids.add(*event.removed);
    if (event.added) ids.add(*event.added);
    if (event.point_a) ids.add(*event.point_a);
    if (event.point_b) ids.add(*event.point_b);
    if (event.removed) offsets.add(event.removed_offset);
    if (event.added) offsets.add(event.added_offset);
  }
  json.begin_object();
  json.member("count", recording.events.size());
  json.member("first", first);
  json.key("kinds");
  json.begin_list();
  for (std::size_t i = 0; i < event_kinds; ++i) json.value(name(static_cast<Event_kind>(i)));
  json.end_list();
  json.key("colors");
  json.begin_list();
  for (std::size_t i = 0; i < event_kinds; ++i) {
    json.value(std::string(color(static_cast<Event_kind>(i))));
  }
  json.end_list();
  json.member("kind", kind.base64());
  json.member("fields", present.base64());
  json.member("time", time.base64());
  json.member("ids", ids.base64());
  offsets.write(json, "offsets", recording);
  json.end_object();
}

void write_box(Json_writer& json, const std::optional<Box_2>& box) {
  json.key("box");
  if (!box) return json.null();
  json.begin_list();
  for (const double side : {box->xmin, box->ymin, box->xmax, box->ymax}) json.value(side);
  json.end_list();
}

void write_periodic_box(Json_writer& json, const Periodic_box_2& box) {
  json.key("periodic");
  json.begin_list();
  for (const auto& [vector, rate, epoch] : {box.first(), box.second()}) {
    for (const double number : {epoch, vector.x, vector.y, rate.x, rate.y}) json.value(number);
  }
  json.end_list();
}

void write_wave(Json_writer& json, const std::optional<Wave_shape>& wave) {
  json.key("wave");
  if (!wave) return json.null();
  json.begin_object();
  json.member("height", wave->height);
  json.member("width", wave->width);
  json.end_object();
}

void write_encounters(Json_writer& json, const Viewer_encounters& encounters,
                      const Recording& recording, std::size_t points) {
  Id_bytes ids(points);
  Offset_bytes offsets;
  Bytes begin;
  Bytes end;
  for (const Viewer_encounter& encounter : encounters.all) {
    ids.add(encounter.points);
    offsets.add(encounter.offset);
    begin.add(encounter.begin);
    end.add(encounter.end);
  }
  json.key("encounters");
  json.begin_object();
  json.member("range", encounters.range);
  json.member("in_all", encounters.in_all);
  json.member("count", encounters.all.size());
  json.member("ids", ids.base64());
  offsets.write(json, "offsets", recording);
  json.member("begin", begin.base64());
  json.member("end", end.base64());
  json.end_object();
}

void write_thinned(Json_writer& json, const Recording& recording) {
  json.key("thinned");
  if (!recording.is_thinned) return json.null();
  json.begin_object();
  json.member("events", recording.events_in_all);
  json.end_object();
}

// Escapes JSON text so that it cannot end the enclosing HTML element.
std::string embedded(std::string_view json) {
  std::string result;
  for (const char c : json) {
    c == '<' ? result += "\\u003c" : result += c;
  }
  return result;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// Writes a script without indentation, empty lines, and lines that are comments but those about
// the license: with the module a page is large.
void write_code(std::ostream& out, std::string_view script) {
  bool is_comment = false;
  while (!script.empty()) {
    std::string_view line = script.substr(0, std::min(script.find('\n'), script.size() - 1) + 1);
    script.remove_prefix(line.size());
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    if (line.starts_with("/*")) is_comment = true;
    const bool is_left_out = is_comment || line.starts_with("//") || line == "\n";
    if (line.find("*/") != std::string_view::npos) is_comment = false;
    if (!is_left_out || line.find("SPDX") != std::string_view::npos) out << line;
  }
}

// Writes the page of the viewer with scripts as `write_script` writes each, and in it what
// `write_content` writes.
template <class Write_script, class Function>
void write_page(std::ostream& out, const std::string& title, const Write_script& write_script,
                const Function& write_content) {
  std::string_view rest = detail::viewer_page;
  const auto write_up_to = [&](std::string_view marker) {
    const std::size_t position = rest.find(marker);
    out << rest.substr(0, position);
    rest.remove_prefix(position + marker.size());
  };
  write_up_to("<!-- title -->");
  out << escaped(title);
  write_up_to("<!-- style -->");
  out << detail::viewer_style;
  write_up_to("<!-- recording -->");
  write_content();
  write_up_to("<!-- scripts -->");
  out << "<script>\n";
  for (const std::string_view script : detail::viewer_scripts) write_script(script);
  out << "</script>\n" << rest;
}

}  // namespace

std::string viewer_recording(const Recording& recording, const Viewer_settings& settings) {
  const std::size_t points = std::max(number_of_points(recording), settings.points);
  std::string text;
  Json_writer json(text);
  json.begin_object();
  json.member("format", recording.periodic_box ? 3 : 2);
  json.member("program", std::string("kinetri ") + version);
  json.member("title", settings.title);
  if (!settings.view.empty()) json.member("view", settings.view);
  json.member("from", recording.from);
  json.member("until", recording.until);
  json.member("points", points);
  write_box(json, settings.box);
  if (recording.periodic_box) write_periodic_box(json, *recording.periodic_box);
  json.member("radius", settings.radius);
  write_thinned(json, recording);
  write_wave(json, settings.wave);
  if (settings.encounters) write_encounters(json, *settings.encounters, recording, points);
  json.member("initial_edges", initial_edges(recording, points));
  json.key("triangles");
  write_triangles(json, recording, points);
  json.key("motions");
  write_motions(json, recording, points);
  if (!recording.coincidences.empty()) write_coincidences(json, recording, points);
  json.key("events");
  write_events(json, recording, points);
  if (!settings.names.empty()) {
    json.key("names");
    json.begin_list();
    for (const std::string& name : settings.names) json.value(name);
    json.end_list();
  }
  json.end_object();
  return text;
}

void write_viewer_page(std::ostream& out, const Recording& recording,
                       const Viewer_settings& settings) {
  const auto write_script = [&](std::string_view script) { out << script; };
  write_page(out, settings.title, write_script, [&] {
    out << "<script type=\"application/json\" id=\"recording\">"
        << embedded(viewer_recording(recording, settings)) << "</script>\n";
  });
}

bool has_live_module() {
  return !detail::live_module.empty();
}

void write_live_page(std::ostream& out, const Live_page& page) {
  KINETRI_PRECONDITION(has_live_module(), "a page without its module");
  const auto write_script = [&](std::string_view script) { write_code(out, script); };
  write_page(out, page.title, write_script, [&] {
    out << "<style>" << detail::live_style << "</style>\n";
    if (!page.points.empty()) {
      out << "<script type=\"text/csv\" id=\"points\" data-options='" << escaped(page.options)
          << "'>\n"
          << page.points << "</script>\n";
    }
    out << "<script type=\"text/plain\" id=\"module\">";
    for (const std::string_view piece : detail::live_module) out << piece;
    out << "</script>\n<script type=\"module\">\n";
    for (const std::string_view script : detail::live_scripts) write_script(script);
    out << "</script>\n";
  });
}

}  // namespace kinetri
