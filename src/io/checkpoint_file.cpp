// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/checkpoint_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "checkpoint_motion.h"
#include "json_value.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "kinetri/io/output_file.h"
#include "text_table.h"

namespace kinetri {
namespace {

using Json = nlohmann::json;

constexpr std::string_view format_name = "kinetri checkpoint ";
constexpr std::string_view version = "1";
constexpr Table_kind checkpoint_kind = {"a simulation's state", ""};

std::string checksum_line(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("checksum {:08x}\n", crc.checksum());
}

// The kinds of scheduled changes, by the names that events have in files.
constexpr std::array<Event_kind, 3> change_kinds = {Event_kind::insert, Event_kind::erase,
                                                    Event_kind::trajectory};

// ---- writing ----

Json json_of(const Algebraic_number& time) {
  if (time.is_known_rational()) return time.rational().str();
  Json coefficients = Json::array();
  const Polynomial polynomial = time.polynomial();
  for (const Integer& c : polynomial.coefficients()) coefficients.push_back(c.str());
  const Rational_interval between = time.isolating_interval();
  return {{"root_of", coefficients}, {"between", {between.lower.str(), between.upper.str()}}};
}

Json json_of(const Certificate_counters& counters) {
  return {{"created", counters.created},
          {"root_solves", counters.root_solves},
          {"filter_decided", counters.filter_decided},
          {"refined_decided", counters.refined_decided},
          {"exact_decided", counters.exact_decided}};
}

Json json_of(const Triangulation_counters& counters) {
  return {{"events", counters.events},
          {"discarded", counters.discarded},
          {"instants", counters.instants},
          {"largest_instant", counters.largest_instant},
          {"batches", counters.batches},
          {"flat_hulls", counters.flat_hulls},
          {"points_set_aside", counters.points_set_aside},
          {"rebuilds", counters.rebuilds},
          {"looks_again", counters.looks_again}};
}

Json json_of(const Contact_counters& counters) {
  return {{"discarded_walls", counters.discarded_walls},
          {"discarded_collisions", counters.discarded_collisions},
          {"instants", counters.instants},
          {"most_at_one_time", counters.most_at_one_time}};
}

template <class Motion>
Json json_of(const std::optional<Motion>& motion) {
  if (!motion) return nullptr;
  return Checkpoint_motion<Motion>::numbers(*motion);
}

// The JSON text of a checkpoint, a member a line, and of long lists an element a line.
template <class Traits>
class Checkpoint_writer {
 public:
  explicit Checkpoint_writer(std::string& text) : text_(text) {}

  void write(const Simulation_snapshot<Traits>& snapshot, const std::string& response) {
    const Triangulation_snapshot<Traits>& topology = snapshot.triangulation;
    text_ += '{';
    add("motion", std::string(Checkpoint_motion<typename Traits::Motion>::name));
    add("time", json_of(topology.time));
    add("response", response);
    write_options(snapshot);
    add("counters", json_of(topology.counters));
    add("certificates", json_of(topology.certificates));
    add("contact_counters", json_of(snapshot.counters));
    add("contact_certificates", json_of(snapshot.certificates));
    add_list("points", topology.motions, [](const auto& motion) { return json_of(motion); });
    add("dimension", topology.dimension);
    write_faces(topology);
    add_list("in_contact", snapshot.in_contact, [](const Edge_ids& pair) { return Json(pair); });
    add_list("scheduled", snapshot.scheduled, [](const auto& change) -> Json {
      return {{"time", json_of(change.time)},
              {"kind", std::string(name(change.kind))},
              {"point", change.point},
              {"motion", json_of(change.motion)}};
    });
    text_ += "\n}\n";
  }

 private:
  void write_options(const Simulation_snapshot<Traits>& snapshot) {
    const Simulation_options& options = snapshot.options;
    Json box;
    if (options.box)
      box = {options.box->xmin, options.box->ymin, options.box->xmax, options.box->ymax};
    add("box", box);
    add("rim_touches", options.rim_touches);
    add("radius", options.radius);
    add("has_response", snapshot.has_response);
    add("contacts_at_one_time", options.contacts_at_one_time);
  }

  // Of each face the vertices (null for the infinite one) and the neighbors, as many as the
  // dimension has.
  void write_faces(const Triangulation_snapshot<Traits>& topology) {
    const auto vertices = static_cast<std::size_t>(std::max(topology.dimension, 0) + 1);
    const auto neighbors = static_cast<std::size_t>(topology.dimension + 1);
    add_list("faces", topology.faces, [&](const auto& face) {
      Json lists = {Json::array(), Json::array()};
      for (std::size_t i = 0; i < vertices; ++i) {
        const Point_id id = face.vertices[i];
        lists[0].push_back(id == no_point ? Json() : Json(id));
        if (i < neighbors) lists[1].push_back(face.neighbors[i]);
      }
      return lists;
    });
    add_list("vertex_faces", topology.vertex_faces, [](std::size_t face) { return Json(face); });
    add("infinite_vertex_face", topology.infinite_vertex_face);
  }

  void add_key(const char* key) {
    text_ += fmt::format("{}\n\"{}\":", std::exchange(is_first_, false) ? "" : ",", key);
  }

  void add(const char* key, const Json& value) {
    add_key(key);
    text_ += value.dump();
  }

  template <class List, class Function>
  void add_list(const char* key, const List& list, Function json_of_element) {
    add_key(key);
    text_ += '[';
    for (bool is_first = true; const auto& element : list) {
      text_ += std::exchange(is_first, false) ? "\n" : ",\n";
      text_ += json_of_element(element).dump();
    }
    text_ += ']';
  }

  std::string& text_;
  bool is_first_ = true;
};

// ---- reading ----

bool is_decimal(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  return !text.empty() && (text.size() == 1 || text.front() != '0') &&
         text.find_first_not_of("0123456789") == std::string_view::npos;
}

Integer integer(const Json_value& value) {
  if (!is_decimal(value.text())) value.fail("is no integer; expected one in decimal digits");
  return Integer(value.text());
}

Rational rational(const Json_value& value) {
  const std::string& text = value.text();
  const std::size_t slash = std::min(text.find('/'), text.size());
  const std::string numerator = text.substr(0, slash);
  const std::string denominator = slash == text.size() ? "1" : text.substr(slash + 1);
  if (!is_decimal(numerator) || !is_decimal(denominator) || denominator.starts_with('-') ||
      denominator == "0") {
    value.fail("is no fraction; expected an integer, or two and a slash, in decimal digits");
  }
  return Rational(Integer(numerator), Integer(denominator));
}

Algebraic_number exact_time(const Json_value& value) {
  if (value.is_text()) return rational(value);
  const Json_value ends = value.member("between");
  ends.expect_size(2);
  const Rational lower = rational(ends.element(0));
  const Rational upper = rational(ends.element(1));
  std::vector<Integer> coefficients;
  value.member("root_of").for_each(
      [&](const Json_value& c) { coefficients.push_back(integer(c)); });
  const Polynomial p(std::move(coefficients));
  const auto isolates = [&] {
    if (p.degree() < 1 || lower >= upper) return false;
    if (p.sign_at(lower) * p.sign_at(upper) != CGAL::NEGATIVE) return false;
    const Sturm_sequence sequence(p);
    return sequence.terms().back().degree() == 0 &&
           sequence.count(Interval_end{lower}, Interval_end{upper}) == 1;
  };
  if (!isolates()) {
    value.fail("is no root; expected a square-free polynomial that has one root between the two");
  }
  return {p, lower, upper};
}

std::uint64_t count(const Json_value& value) {
  return value.whole_number<std::uint64_t>();
}

Certificate_counters certificate_counters(const Json_value& value) {
  return {count(value.member("created")), count(value.member("root_solves")),
          count(value.member("filter_decided")), count(value.member("refined_decided")),
          count(value.member("exact_decided"))};
}

void read_counts(const Json_value& value, std::array<std::uint64_t, event_kinds>& counts) {
  value.expect_size(event_kinds);
  for (std::size_t i = 0; i < event_kinds; ++i) counts[i] = count(value.element(i));
}

Triangulation_counters triangulation_counters(const Json_value& value) {
  Triangulation_counters result;
  read_counts(value.member("events"), result.events);
  read_counts(value.member("discarded"), result.discarded);
  result.instants = count(value.member("instants"));
  result.largest_instant = count(value.member("largest_instant"));
  result.batches = count(value.member("batches"));
  result.flat_hulls = count(value.member("flat_hulls"));
  result.points_set_aside = count(value.member("points_set_aside"));
  result.rebuilds = count(value.member("rebuilds"));
  result.looks_again = count(value.member("looks_again"));
  return result;
}

Contact_counters contact_counters(const Json_value& value) {
  Contact_counters result;
  result.discarded_walls = count(value.member("discarded_walls"));
  result.discarded_collisions = count(value.member("discarded_collisions"));
  result.instants = count(value.member("instants"));
  result.most_at_one_time = count(value.member("most_at_one_time"));
  return result;
}

Point_id point_id(const Json_value& value) {
  return value.whole_number<Point_id>(no_point - 1);
}

template <class Motion>
std::optional<Motion> motion(const Json_value& value) {
  if (value.is_null()) return std::nullopt;
  std::vector<double> numbers;
  value.for_each([&](const Json_value& number) { numbers.push_back(number.number()); });
  std::optional<Motion> result = Checkpoint_motion<Motion>::from_numbers(numbers);
  if (!result) {
    value.fail(fmt::format("has {} numbers; expected {}", numbers.size(),
                           Checkpoint_motion<Motion>::expected));
  }
  return result;
}

Simulation_options options(const Json_value& state) {
  Simulation_options result;
  const Json_value box = state.member("box");
  if (!box.is_null()) {
    box.expect_size(4);
    result.box = Box_2{box.element(0).number(), box.element(1).number(), box.element(2).number(),
                       box.element(3).number()};
  }
  result.rim_touches = state.member("rim_touches").truth();
  result.radius = state.member("radius").number();
  result.contacts_at_one_time = count(state.member("contacts_at_one_time"));
  return result;
}

template <class Traits>
void read_faces(const Json_value& state, Triangulation_snapshot<Traits>& topology) {
  const auto vertices = static_cast<std::size_t>(std::max(topology.dimension, 0) + 1);
  const auto neighbors = static_cast<std::size_t>(topology.dimension + 1);
  const auto face_number = [](const Json_value& value) {
    return value.whole_number<std::size_t>();
  };
  const Json_value faces = state.member("faces");
  topology.faces.reserve(faces.size());
  faces.for_each([&](const Json_value& lists) {
    lists.expect_size(2);
    lists.element(0).expect_size(vertices);
    lists.element(1).expect_size(neighbors);
    auto& face = topology.faces.emplace_back();
    for (std::size_t i = 0; i < vertices; ++i) {
      const Json_value list = lists.element(0);
      face.vertices[i] = list.element(i).is_null() ? no_point : point_id(list.element(i));
    }
    for (std::size_t i = 0; i < neighbors; ++i) {
      const Json_value list = lists.element(1);
      face.neighbors[i] = face_number(list.element(i));
    }
  });
  state.member("vertex_faces").for_each([&](const Json_value& face) {
    topology.vertex_faces.push_back(face_number(face));
  });
  topology.infinite_vertex_face = face_number(state.member("infinite_vertex_face"));
}

template <class Traits>
typename Simulation_snapshot<Traits>::Change scheduled_change(const Json_value& value) {
  const Json_value kind = value.member("kind");
  const auto* const found =
      std::ranges::find_if(change_kinds, [&](Event_kind k) { return name(k) == kind.text(); });
  if (found == change_kinds.end()) {
    kind.fail("is no change of a point; expected insert, erase or trajectory");
  }
  return {exact_time(value.member("time")), *found, point_id(value.member("point")),
          motion<typename Traits::Motion>(value.member("motion"))};
}

template <class Traits>
Simulation_snapshot<Traits> simulation_snapshot(const Json_value& state) {
  using Motion = typename Traits::Motion;
  Simulation_snapshot<Traits> result;
  Triangulation_snapshot<Traits>& topology = result.triangulation;
  topology.time = exact_time(state.member("time"));
  result.options = options(state);
  result.has_response = state.member("has_response").truth();
  topology.counters = triangulation_counters(state.member("counters"));
  topology.certificates = certificate_counters(state.member("certificates"));
  result.counters = contact_counters(state.member("contact_counters"));
  result.certificates = certificate_counters(state.member("contact_certificates"));
  state.member("points").for_each(
      [&](const Json_value& point) { topology.motions.push_back(motion<Motion>(point)); });
  topology.dimension = state.member("dimension").small_number(-1, 2);
  read_faces(state, topology);
  state.member("in_contact").for_each([&](const Json_value& pair) {
    pair.expect_size(2);
    result.in_contact.push_back({point_id(pair.element(0)), point_id(pair.element(1))});
  });
  state.member("scheduled").for_each([&](const Json_value& change) {
    result.scheduled.push_back(scheduled_change<Traits>(change));
  });
  return result;
}

// The JSON text of a file whose first and last line are right.
std::string_view state_text(std::string_view file, const std::string& file_name) {
  const auto fail = [&](const std::string& problem) { throw Input_error(file_name, 0, problem); };
  if (file.empty()) fail("is empty; expected a checkpoint");
  const std::string_view first = file.substr(0, file.find('\n'));
  if (!first.starts_with(format_name)) {
    fail(
        fmt::format("is no checkpoint: it begins with {}; expected a file whose first line is "
                    "'{}{}'",
                    quoted(first), format_name, version));
  }
  if (first.substr(format_name.size()) != version) {
    fail(
        fmt::format("is a checkpoint of version {}; expected version {}: take the kinetri that "
                    "wrote it",
                    quoted(first.substr(format_name.size())), version));
  }
  constexpr std::size_t checksum_size = 18;  // of the last line
  const std::size_t end = file.size() - std::min(file.size() - first.size(), checksum_size);
  const std::string_view last = file.substr(end);
  if (!last.starts_with("checksum ") || !last.ends_with('\n')) {
    fail(
        "is cut short, or has more than it was written with: its last line is no checksum; "
        "expected the whole file as it was written");
  }
  if (last != checksum_line(file.substr(0, end))) {
    fail(
        "is damaged: its checksum is not that of its content; expected the file as it was written");
  }
  return file.substr(first.size(), end - first.size());
}

}  // namespace

void write_checkpoint(std::ostream& out, const Checkpoint& checkpoint) {
  std::string text = fmt::format("{}{}\n", format_name, version);
  std::visit(
      [&]<class Traits>(const Simulation_snapshot<Traits>& snapshot) {
        Checkpoint_writer<Traits>(text).write(snapshot, checkpoint.response);
      },
      checkpoint.simulation);
  out << text << checksum_line(text);
}

void write_checkpoint_file(const std::string& path, const Checkpoint& checkpoint) {
  Output_file file(path);
  write_checkpoint(file.stream(), checkpoint);
  file.commit();
}

Checkpoint read_checkpoint(std::istream& in, const std::string& name) {
  std::string file;
  std::array<char, 1U << 16U> buffer;
  while (in.read(buffer.data(), buffer.size()), in.gcount() > 0) {
    file.append(buffer.data(), static_cast<std::size_t>(in.gcount()));
  }
  if (in.bad()) throw Input_error(name, 0, "cannot be read to its end; expected a readable file");
  const std::string_view text = state_text(file, name);
  const Json json = Json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded())
    throw Input_error(
        name, 0, "is no JSON between its first and last line; expected the file as it was written");
  const Json_value state(json, name);
  const Json_value motion = state.member("motion");
  const std::string response = state.member("response").text();
  if (motion.text() == Checkpoint_motion<Linear_motion_2>::name) {
    return {simulation_snapshot<Linear_kinetic_traits_2>(state), response};
  }
  if (motion.text() == Checkpoint_motion<Polynomial_motion_2>::name) {
    return {simulation_snapshot<Polynomial_kinetic_traits_2>(state), response};
  }
  motion.fail(fmt::format("is {}; expected '{}' or '{}'", kinetri::quoted(motion.text()),
                          Checkpoint_motion<Linear_motion_2>::name,
                          Checkpoint_motion<Polynomial_motion_2>::name));
}

Checkpoint read_checkpoint_file(const std::string& path) {
  if (path == "-") return read_checkpoint(std::cin, "standard input");
  std::ifstream in = open_table(path, checkpoint_kind);
  return read_checkpoint(in, path);
}

}  // namespace kinetri
