// SPDX-License-Identifier: GPL-3.0-or-later
// The reader of pages; viewer_page.h describes the JSON object.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <istream>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "json_value.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/bytes.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/impl/simulation/triangle_map.h"
#include "kinetri/io/viewer_page.h"

namespace kinetri {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

[[noreturn]] void fail_damaged(const Json_value& value, std::string_view problem) {
  value.fail(joined(problem, "; expected the page as it was written"));
}

// The packed numbers or ids of a member, read in order.
class Packed_numbers {
 public:
  // `points` determines the width of ids.
  Packed_numbers(const Json_value& object, const char* key, std::size_t points)
      : value_(object.member(key)), points_(points), are_ids_short_(points <= 65'536) {
    auto bytes = bytes_of_base64(value_.text());
    if (!bytes) fail("is not base64");
    bytes_ = std::move(*bytes);
  }

  [[noreturn]] void fail(std::string_view problem) const { fail_damaged(value_, problem); }

  bool is_at_end() const { return place_ == bytes_.size(); }

  void expect_end() const {
    if (!is_at_end()) fail("is too long");
  }

  template <std::unsigned_integral Number>
  Number take() {
    if (bytes_.size() - place_ < sizeof(Number)) {
      fail("is too short");
    }
    const auto result = number_at<Number>(bytes_, place_);
    place_ += sizeof(Number);
    return result;
  }

  double take_finite() {
    const double result = std::bit_cast<double>(take<std::uint64_t>());
    if (!std::isfinite(result)) fail("has a number that is not finite");
    return result;
  }

  Vector_2 take_vector() {
    const double x = take_finite();
    return {x, take_finite()};
  }

  Point_id take_id() {
    const Point_id id = are_ids_short_ ? take<std::uint16_t>() : take<std::uint32_t>();
    if (id < points_) return id;
    fail(joined("names the point ", id, ", but the ids end with ", points_ - 1));
  }

  Edge_ids take_edge() {
    const Point_id a = take_id();
    const Point_id b = take_id();
    if (a == b) fail(joined("has an edge from point ", a, " to itself"));
    return edge_ids(a, b);
  }

  // With the offset from that list; none in the plane.
  Periodic_edge take_edge(Packed_numbers* offsets) {
    if (offsets == nullptr) return {take_edge(), {}};
    const Point_id a = take_id();
    const Point_id b = take_id();
    const Lattice_offset_2 offset = offsets->take_offset();
    if (a == b && offset == Lattice_offset_2()) {
      fail(joined("has an edge from point ", a, " to itself"));
    }
    return periodic_edge(a, b, offset);
  }

  // The same with the offsets of corners.
  Periodic_triangle take_triangle(Packed_numbers* offsets) {
    const Point_id a = take_id();
    const Point_id b = take_id();
    const Point_id c = take_id();
    const Lattice_offset_2 to_b = offsets == nullptr ? Lattice_offset_2() : offsets->take_offset();
    const Lattice_offset_2 to_c = offsets == nullptr ? Lattice_offset_2() : offsets->take_offset();
    const Periodic_triangle result = periodic_triangle({a, {}}, {b, to_b}, {c, to_c});
    const auto [p, q, r] = detail::images_of(result);
    const Lattice_offset_2 across = offset_between(q.offset, r.offset);
    if (p == q || q == r || r == p || !is_possible(across.x) || !is_possible(across.y)) {
      fail(joined("has a triangle whose corners are ", a, ", ", b, " and ", c));
    }
    return result;
  }

  Lattice_offset_2 take_offset() {
    const std::int32_t x = take_offset_number();
    return {x, take_offset_number()};
  }

 private:
  // The opposite number is possible too.
  static bool is_possible(std::int32_t offset) {
    return offset != std::numeric_limits<std::int32_t>::min();
  }

  std::int32_t take_offset_number() {
    const auto result = static_cast<std::int32_t>(take<std::uint32_t>());
    if (!is_possible(result)) fail("has an offset of -2^31");
    return result;
  }

  Json_value value_;
  std::size_t points_;
  bool are_ids_short_;
  std::string bytes_;
  std::size_t place_ = 0;
};

// Checks each change of the edges and triangles of a recording. In the plane offsets are zero.
class Followed_topology {
 public:
  explicit Followed_topology(const Json_value& json) : json_(json) {}

  void add(const Periodic_edge& edge, const std::string& what) {
    if (edges_.insert(edge).second) return;
    fail_damaged(json_, joined(what, " adds the edge ", name(edge), ", which is there already"));
  }
  void remove(const Periodic_edge& edge, const std::string& what) {
    if (edges_.erase(edge) == 1) return;
    fail_damaged(json_, joined(what, " removes the edge ", name(edge), ", which is not there"));
  }

  void add(const Periodic_triangle& triangle, const std::string& what) {
    const auto corners = detail::images_of(triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      if (triangles_.apex(corners[k], corners[(k + 1) % 3]).id == no_point) continue;
      fail_damaged(json_, joined(what, " adds the triangle ", name(triangle),
                                 ", which overlaps another one"));
    }
    triangles_.insert(corners);
  }
  void remove(const Periodic_triangle& triangle, const std::string& what) {
    const auto corners = detail::images_of(triangle);
    const auto& [a, b, c] = corners;
    const bool is_there = triangles_.apex(a, b) == c && triangles_.apex(b, c) == a;
    if (!is_there) {
      fail_damaged(json_,
                   joined(what, " removes the triangle ", name(triangle), ", which is not there"));
    }
    triangles_.erase(corners);
  }

  // The triangles that a flip removes, then those that it adds.
  std::array<Periodic_triangle, 4> flipped(const Recorded_event& event,
                                           const std::string& what) const {
    if (!event.removed || !event.added)
      fail_damaged(json_, joined(what, " is a flip without two edges"));
    const Periodic_image a = {(*event.removed)[0], {}};
    const Periodic_image b = {(*event.removed)[1], event.removed_offset};
    const Periodic_image c = triangles_.apex(a, b);
    const Periodic_image d = triangles_.apex(b, a);
    if (c.id == no_point || d.id == no_point ||
        detail::edge_between(c, d) != Periodic_edge{*event.added, event.added_offset}) {
      fail_damaged(json_,
                   joined(what, " adds an edge that is not the other diagonal of the triangles at ",
                          "the removed one"));
    }
    std::array<Periodic_triangle, 4> result = {
        periodic_triangle(a, b, c), periodic_triangle(b, a, d), periodic_triangle(a, d, c),
        periodic_triangle(d, b, c)};
    if (result[1] < result[0]) std::swap(result[0], result[1]);
    if (result[3] < result[2]) std::swap(result[2], result[3]);
    return result;
  }

 private:
  static std::string name(const Periodic_edge& edge) {
    const auto& [ids, offset] = edge;
    std::string result = joined(ids[0], "-", ids[1]);
    if (offset != Lattice_offset_2()) append(result, " (", offset.x, ", ", offset.y, ")");
    return result;
  }
  static std::string name(const Periodic_triangle& triangle) {
    const auto& ids = triangle.corners;
    return joined(ids[0], "-", ids[1], "-", ids[2]);
  }

  const Json_value& json_;
  std::set<Periodic_edge> edges_;
  detail::Triangle_map<Periodic_image> triangles_;
};

class Page_reader {
 public:
  explicit Page_reader(const Json_value& json) : json_(json) {}

  Viewer_page read() {
    const Json_value format = json_.member("format");
    const std::uint32_t expected = json_.has_member("periodic") ? 3 : 2;
    if (format.whole_number<std::uint32_t>() != expected) {
      format.fail(joined("is not ", expected,
                         ", which this version reads; expected a page of this version"));
    }
    recording_.from = json_.member("from").number();
    recording_.until = json_.member("until").number();
    if (recording_.from > recording_.until) {
      json_.member("until").fail("is before the start of the run; expected a later time");
    }
    points_ = json_.member("points").whole_number<std::size_t>(no_point);
    read_settings();
    read_events(json_.member("events"));
    read_motions(json_.member("motions"));
    if (json_.has_member("coincidences")) read_coincidences(json_.member("coincidences"));
    read_topology();
    if (json_.has_member("encounters")) read_encounters(json_.member("encounters"));
    return {std::move(recording_), std::move(settings_)};
  }

 private:
  static double positive(const Json_value& value) {
    const double result = value.number();
    if (!(result > 0)) value.fail("is not positive; expected a number greater than 0");
    return result;
  }

  void read_settings() {
    settings_.title = json_.member("title").text();
    if (json_.has_member("view")) settings_.view = json_.member("view").text();
    if (json_.has_member("names")) {
      const Json_value names = json_.member("names");
      names.expect_size(points_);
      names.for_each([this](const Json_value& name) { settings_.names.push_back(name.text()); });
    }
    if (const Json_value box = json_.member("box"); !box.is_null()) {
      box.expect_size(4);
      settings_.box = Box_2{box.element(0).number(), box.element(1).number(),
                            box.element(2).number(), box.element(3).number()};
    }
    if (json_.has_member("periodic")) read_periodic_box(json_.member("periodic"));
    settings_.radius = json_.member("radius").number();
    if (settings_.radius < 0) json_.member("radius").fail("is negative; expected 0 or more");
    if (const Json_value wave = json_.member("wave"); !wave.is_null()) {
      settings_.wave = Wave_shape{wave.member("height").number(), positive(wave.member("width"))};
    }
    if (const Json_value thinned = json_.member("thinned"); !thinned.is_null()) {
      recording_.is_thinned = true;
      recording_.events_in_all = thinned.member("events").whole_number<std::uint64_t>();
    }
  }

  void read_periodic_box(const Json_value& json) {
    json.expect_size(10);
    std::array<Linear_motion_2, 2> vectors;
    for (std::size_t i = 0; i < 2; ++i) {
      const auto number = [&](std::size_t k) { return json.element(5 * i + k).number(); };
      vectors[i] = {{number(1), number(2)}, {number(3), number(4)}, number(0)};
    }
    try {
      recording_.periodic_box.emplace(vectors[0], vectors[1]);
      recording_.periodic_box->require_area(Algebraic_number(recording_.from),
                                            Algebraic_number(recording_.until));
    } catch (const Periodic_box_error&) {
      fail_damaged(json, "has no area at a time of the run");
    }
  }

  // The offsets of a list; none in the plane.
  std::optional<Packed_numbers> offsets(const Json_value& json, const char* key) const {
    if (!recording_.periodic_box) return std::nullopt;
    return Packed_numbers(json, key, points_);
  }

  void read_encounters(const Json_value& json) {
    Viewer_encounters& encounters = settings_.encounters.emplace();
    encounters.range = json.member("range").number();
    encounters.in_all = json.member("in_all").whole_number<std::size_t>();
    const auto count = json.member("count").whole_number<std::uint64_t>();
    Packed_numbers ids(json, "ids", points_);
    Packed_numbers begin(json, "begin", points_);
    Packed_numbers end(json, "end", points_);
    std::optional<Packed_numbers> offsets = this->offsets(json, "offsets");
    for (std::uint64_t i = 0; i < count; ++i) {
      Viewer_encounter& encounter = encounters.all.emplace_back();
      const Periodic_edge pair = ids.take_edge(offsets ? &*offsets : nullptr);
      encounter.points = pair.ids;
      encounter.offset = pair.offset;
      encounter.begin = begin.take_finite();
      encounter.end = end.take_finite();
    }
    for (const Packed_numbers* list : {&ids, &begin, &end}) list->expect_end();
    if (offsets) offsets->expect_end();
  }

  // The kinds by their indices in the page.
  static std::vector<Event_kind> kinds(const Json_value& json) {
    std::vector<Event_kind> result;
    json.for_each([&](const Json_value& value) {
      std::size_t i = 0;
      while (i < event_kinds && name(static_cast<Event_kind>(i)) != value.text()) ++i;
      if (i == event_kinds) fail_damaged(value, "is no kind of event");
      result.push_back(static_cast<Event_kind>(i));
    });
    return result;
  }

  void read_events(const Json_value& json) {
    const std::vector<Event_kind> kind_of_index = kinds(json.member("kinds"));
    const auto count = json.member("count").whole_number<std::uint64_t>();
    auto number = json.member("first").whole_number<std::uint64_t>();
    Packed_numbers kind(json, "kind", points_);
    Packed_numbers fields(json, "fields", points_);
    Packed_numbers time(json, "time", points_);
    Packed_numbers ids(json, "ids", points_);
    std::optional<Packed_numbers> offsets = this->offsets(json, "offsets");
    const auto take_edge = [&](std::optional<Edge_ids>& edge, Lattice_offset_2& offset) {
      const Periodic_edge taken = ids.take_edge(offsets ? &*offsets : nullptr);
      edge = taken.ids;
      offset = taken.offset;
    };
    for (std::uint64_t row = 0; row < count; ++row) {
      Recorded_event event;
      const auto index = kind.take<std::uint8_t>();
      if (index >= kind_of_index.size())
        kind.fail(joined("has a kind without a name for event ", row));
      event.kind = kind_of_index[index];
      const auto field = fields.take<std::uint8_t>();
      const double nearest = time.take_finite();
      event.time = {nearest,
                    {(field & 32) != 0 ? std::nextafter(nearest, -infinity) : nearest,
                     (field & 16) != 0 ? std::nextafter(nearest, infinity) : nearest}};
      if ((field & 1) != 0) take_edge(event.removed, event.removed_offset);
      if ((field & 2) != 0) take_edge(event.added, event.added_offset);
      if ((field & 4) != 0) event.point_a = ids.take_id();
      if ((field & 8) != 0) event.point_b = ids.take_id();
      if (!recording_.events.empty()) {
        const Double_interval& before = recording_.events.back().time.bounds;
        const Double_interval& bounds = event.time.bounds;
        if (before.lower > bounds.lower || before.upper > bounds.upper) {
          time.fail(joined("has event ", row, " before event ", row - 1));
        }
      }
      const bool is_counted = (field & 15) != 0 && !recording_.is_thinned;
      if (!recording_.is_thinned) event.number = number;
      if (is_counted) {
        ++number;
        ++recording_.events_in_all;
      }
      recording_.events.push_back(event);
    }
    for (const Packed_numbers* list : {&kind, &fields, &time, &ids}) list->expect_end();
    if (offsets) offsets->expect_end();
  }

  void read_motions(const Json_value& json) {
    const auto count = json.member("count").whole_number<std::uint64_t>();
    const int degree = json.member("degree").small_number(1, 3);
    const auto starting = json.member("starting").whole_number<std::uint64_t>(count);
    Packed_numbers event(json, "event", points_);
    Packed_numbers point(json, "point", points_);
    Packed_numbers there(json, "there", points_);
    Packed_numbers data(json, "data", points_);
    std::optional<Packed_numbers> sizes;
    if (json.has_member("sizes")) sizes.emplace(json, "sizes", points_);
    std::size_t points = 0;
    std::size_t last_row = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      Recorded_motion recorded;
      const std::size_t row = event.take<std::uint32_t>();
      if (i >= starting) {
        if (row >= recording_.events.size() || row < last_row) {
          event.fail(joined("has the motion ", i, " at event ", row,
                            ", which is not there, or too early"));
        }
        recorded.event = last_row = row;
      }
      recorded.point = point.take_id();
      points = std::max(points, std::size_t{recorded.point} + 1);
      const bool is_there = there.take<std::uint8_t>() != 0;
      if (!is_there && i < starting) there.fail(joined("lacks the motion ", i, " of the start"));
      Polynomial_disc_motion_2 motion;
      motion.epoch = data.take_finite();
      motion.position = data.take_vector();
      motion.velocity = data.take_vector();
      if (degree > 1) motion.acceleration = data.take_vector();
      if (degree > 2) motion.jerk = data.take_vector();
      if (sizes) {
        motion.radius = sizes->take_finite();
        motion.growth = sizes->take_finite();
        motion.weight = sizes->take_finite();
      }
      if (is_there) recorded.motion = motion;
      recording_.motions.push_back(recorded);
    }
    for (const Packed_numbers* list : {&event, &point, &there, &data}) list->expect_end();
    if (sizes) sizes->expect_end();
    if (points != points_) {
      json_.member("points").fail(
          joined("is ", points_, ", but the motions are those of ", points, "; expected as many"));
    }
  }

  void read_coincidences(const Json_value& json) {
    const auto count = json.member("count").whole_number<std::uint64_t>();
    const auto starting = json.member("starting").whole_number<std::uint64_t>(count);
    Packed_numbers event(json, "event", points_);
    Packed_numbers point(json, "point", points_);
    Packed_numbers shown(json, "shown", points_);
    std::size_t last_row = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      Recorded_coincidence& coincidence = recording_.coincidences.emplace_back();
      const std::size_t row = event.take<std::uint32_t>();
      if (i >= starting) {
        if (row >= recording_.events.size() || row < last_row) {
          event.fail(joined("has the coincidence ", i, " at event ", row,
                            ", which is not there, or too early"));
        }
        coincidence.event = last_row = row;
      }
      coincidence.point = point.take_id();
      coincidence.shown = shown.take_id();
    }
    for (const Packed_numbers* list : {&event, &point, &shown}) list->expect_end();
  }

  void read_topology() {
    Followed_topology topology(json_);
    const Json_value json = json_.member("triangles");
    const std::string start = "the start";
    std::set<Periodic_edge> sides;
    Packed_numbers initial(json, "initial", points_);
    std::optional<Packed_numbers> initial_offsets = offsets(json, "initial_offsets");
    while (!initial.is_at_end()) {
      const Periodic_triangle triangle =
          initial.take_triangle(initial_offsets ? &*initial_offsets : nullptr);
      topology.add(triangle, start);
      recording_.initial_triangles.push_back(triangle.corners);
      if (initial_offsets) recording_.initial_offsets.push_back(triangle.offsets);
      const auto corners = detail::images_of(triangle);
      for (std::size_t k = 0; k < 3; ++k) {
        sides.insert(detail::edge_between(corners[k], corners[(k + 1) % 3]));
      }
    }
    if (initial_offsets) initial_offsets->expect_end();
    Packed_numbers others(json_, "initial_edges", points_);
    for (const Periodic_edge& side : sides) {
      topology.add(side, start);
      recording_.initial_edges.push_back(side.ids);
    }
    while (!others.is_at_end()) {
      recording_.initial_edges.push_back(others.take_edge());
      topology.add({recording_.initial_edges.back(), {}}, start);
    }
    std::ranges::sort(recording_.initial_edges);

    Packed_numbers rows(json, "event", points_);
    Packed_numbers removed(json, "removed", points_);
    Packed_numbers added(json, "added", points_);
    Packed_numbers ids(json, "ids", points_);
    std::optional<Packed_numbers> offsets = this->offsets(json, "offsets");
    const auto next_row = [&] {
      return rows.is_at_end() ? recording_.events.size() : rows.take<std::uint32_t>();
    };
    std::size_t groups = 0;
    std::size_t group = next_row();
    for (std::size_t row = 0; row < recording_.events.size(); ++row) {
      const Recorded_event& event = recording_.events[row];
      const std::string what = joined("event ", row);
      const std::size_t first = recording_.triangles.size();
      if (event.kind == Event_kind::flip) {
        const std::array<Periodic_triangle, 4> flipped = topology.flipped(event, what);
        for (std::size_t i = 0; i < 4; ++i) add_triangle(row, i > 1, flipped[i]);
      }
      if (event.removed) topology.remove({*event.removed, event.removed_offset}, what);
      if (event.added) topology.add({*event.added, event.added_offset}, what);
      if (group == row) {
        const std::size_t goes = removed.take<std::uint32_t>();
        const std::size_t comes = added.take<std::uint32_t>();
        for (std::size_t i = 0; i < goes + comes; ++i) {
          add_triangle(row, i >= goes, ids.take_triangle(offsets ? &*offsets : nullptr));
        }
        ++groups;
        group = next_row();
        if (group <= row) rows.fail("is not in order");
      }
      for (std::size_t i = first; i < recording_.triangles.size(); ++i) {
        const auto& [of_row, is_added, corners, of_corners] = recording_.triangles[i];
        const Periodic_triangle triangle = {corners, of_corners};
        is_added ? topology.add(triangle, what) : topology.remove(triangle, what);
      }
    }
    if (group < recording_.events.size() || !rows.is_at_end() ||
        groups != json.member("count").whole_number<std::uint64_t>()) {
      rows.fail("names an event that is not there");
    }
    for (const Packed_numbers* list : {&removed, &added, &ids}) list->expect_end();
    if (offsets) offsets->expect_end();
  }

  void add_triangle(std::size_t row, bool is_added, const Periodic_triangle& triangle) {
    recording_.triangles.push_back({row, is_added, triangle.corners, triangle.offsets});
  }

  const Json_value& json_;
  std::size_t points_ = 0;
  Recording recording_;
  Viewer_settings settings_;
};

// The recording's text, which does not contain '<'.
std::string_view recording_in(std::string_view page, const std::string& name) {
  constexpr std::string_view begin = "<script type=\"application/json\" id=\"recording\">";
  constexpr std::string_view end = "</script>";
  const std::size_t first = page.find(begin);
  if (first == std::string_view::npos) {
    throw Input_error(name, 0, "has no recording; expected a page that --html has written");
  }
  page.remove_prefix(first + begin.size());
  const std::size_t last = page.find('<');
  if (last == std::string_view::npos || !page.substr(last).starts_with(end)) {
    throw Input_error(name, 0,
                      "ends within its recording; expected the whole page as it was written");
  }
  return page.substr(0, last);
}

// The text of the page. Stops early if the input is not a page; it may be endless.
std::string text_of_page(std::istream& in, const std::string& name) {
  constexpr std::string_view first = "<!doctype html>";
  std::string page;
  std::array<char, 1 << 16> buffer;
  do {
    in.read(buffer.data(), buffer.size());
    page.append(buffer.data(), static_cast<std::size_t>(in.gcount()));
  } while (in && page.starts_with(first));
  if (in.bad()) throw Input_error(name, 0, "cannot be read to its end; expected a readable file");
  if (page.starts_with(first)) return page;
  throw Input_error(name, 0, "has no recording; expected a page that --html has written");
}

}  // namespace

Viewer_page read_viewer_page(std::istream& in, const std::string& name) {
  const std::string page = text_of_page(in, name);
  const Json_document document(recording_in(page, name));
  if (!document.is_valid()) {
    throw Input_error(name, 0,
                      "has a recording that is no JSON; expected the page as it was written");
  }
  const Json_value json = document.value(name, "recording");
  return Page_reader(json).read();
}

}  // namespace kinetri
