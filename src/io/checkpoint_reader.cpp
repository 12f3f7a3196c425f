// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "checkpoint_format.h"
#include "checkpoint_motion.h"
#include "counters.h"
#include "json_value.h"
#include "kinetri/algebra/sturm_sequence.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/checkpoint_file.h"

namespace kinetri {
namespace {

// The kinds of scheduled changes, by the names that events have in files.
constexpr std::array<Event_kind, 3> change_kinds = {Event_kind::insert, Event_kind::erase,
                                                    Event_kind::trajectory};

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

template <class Counters, std::size_t n>
void read_counters(const Json_value& value, Counters& counters,
                   const std::array<Named_counter<Counters>, n>& names) {
  for (const auto& [name, counter] : names) counters.*counter = count(value.member(name));
}

void read_counts(const Json_value& value, std::array<std::uint64_t, event_kinds>& counts) {
  value.expect_size(event_kinds);
  for (std::size_t i = 0; i < event_kinds; ++i) counts[i] = count(value.element(i));
}

Point_id point_id(const Json_value& value) {
  return value.whole_number<Point_id>(no_point - 1);
}

// The motion, if there is one. Discs that collide have no weight besides their radius.
template <class Motion>
std::optional<Motion> motion(const Json_value& value, bool may_have_weight = true) {
  if (value.is_null()) return std::nullopt;
  std::vector<double> numbers;
  value.for_each([&](const Json_value& number) { numbers.push_back(number.number()); });
  std::optional<Motion> result = Checkpoint_motion<Motion>::from_numbers(numbers);
  if (!result) {
    value.fail(
        joined("has ", numbers.size(), " numbers; expected ", Checkpoint_motion<Motion>::expected));
  }
  if constexpr (HasWeight<Motion>) {
    if (!may_have_weight && result->weight != 0) {
      value.fail(joined("has the weight ", result->weight,
                        "; expected 0, since discs that collide have none"));
    }
  }
  return result;
}

// The ids.
void read_pair(const Json_value& value, Edge_ids& pair) {
  value.expect_size(2);
  pair = {point_id(value.element(0)), point_id(value.element(1))};
}

// The ids and the offset.
void read_pair(const Json_value& value, Periodic_edge& pair) {
  value.expect_size(4);
  constexpr int most = std::numeric_limits<std::int32_t>::max();
  pair = {{point_id(value.element(0)), point_id(value.element(1))},
          {value.element(2).small_number(-most, most), value.element(3).small_number(-most, most)}};
}

// The box, if there is one. It has an area at the time.
std::optional<Periodic_box_2> periodic_box(const Json_value& value, const Algebraic_number& time) {
  if (value.is_null()) return std::nullopt;
  value.expect_size(2);
  std::array<Linear_motion_2, 2> vectors;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const Json_value numbers = value.element(i);
    const std::optional<Linear_motion_2> vector = motion<Linear_motion_2>(numbers);
    if (!vector) numbers.fail("is no list; expected one in brackets");
    vectors[i] = *vector;
  }
  try {
    const Periodic_box_2 box(vectors[0], vectors[1]);
    box.require_area(time, time);
    return box;
  } catch (const Periodic_box_error& error) {
    value.fail(joined("cannot be used: ", error.what()));
  }
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
  result.refuses_overlaps = state.member("refuses_overlaps").truth();
  if (state.member("refuses_coincident_points").truth()) {
    result.coincident = Coincident_points::refuse;
  }
  state.member("masses").for_each(
      [&](const Json_value& mass) { result.masses.push_back(mass.number()); });
  if (state.has_member("max_contacts_per_instant")) {
    result.max_contacts_per_instant = count(state.member("max_contacts_per_instant"));
  }
  return result;
}

template <class Traits>
typename Simulation_snapshot<Traits>::Change scheduled_change(const Json_value& value,
                                                              bool may_have_weight) {
  const Json_value kind = value.member("kind");
  const auto* const found =
      std::ranges::find_if(change_kinds, [&](Event_kind k) { return name(k) == kind.text(); });
  if (found == change_kinds.end()) {
    kind.fail("is no change of a point; expected insert, erase or trajectory");
  }
  return {exact_time(value.member("time")), *found, point_id(value.member("point")),
          motion<typename Traits::Motion>(value.member("motion"), may_have_weight)};
}

template <class Traits>
Simulation_snapshot<Traits> simulation_snapshot(const Json_value& state) {
  using Motion = typename Traits::Motion;
  Simulation_snapshot<Traits> result;
  Triangulation_snapshot<Traits>& topology = result.triangulation;
  topology.time = exact_time(state.member("time"));
  result.options = options(state);
  result.has_response = state.member("has_response").truth();
  const Json_value counters = state.member("counters");
  read_counts(counters.member("events"), topology.counters.events);
  read_counters(counters, topology.counters, triangulation_counters);
  read_counters(state.member("contact_counters"), result.counters, contact_counters);
  state.member("points").for_each([&](const Json_value& point) {
    topology.motions.push_back(motion<Motion>(point, !result.has_response));
  });
  state.member("in_contact").for_each([&](const Json_value& pair) {
    read_pair(pair, result.in_contact.emplace_back());
  });
  state.member("scheduled").for_each([&](const Json_value& change) {
    result.scheduled.push_back(scheduled_change<Traits>(change, !result.has_response));
  });
  return result;
}

std::uint32_t checksum(const Json_value& value) {
  const std::string& text = value.text();
  std::uint32_t result = 0;
  std::from_chars(text.data(), text.data() + text.size(), result, 16);
  if (text != hexadecimal(result, 8)) {
    value.fail("is no checksum; expected eight hexadecimal digits, in lower case");
  }
  return result;
}

std::vector<Checkpoint_log> logs(const Json_value& list) {
  std::vector<Checkpoint_log> result;
  list.for_each([&](const Json_value& log) {
    result.push_back({log.member("output").text(), log.member("path").text(),
                      count(log.member("bytes")), checksum(log.member("crc32"))});
  });
  return result;
}

// Reads the snapshot of the kind of motion that the member `motion` names, in the plane or in a
// periodic box.
template <class... Snapshots>
void read_snapshot(const Json_value& state, bool is_periodic, std::variant<Snapshots...>& result) {
  const Json_value motion = state.member("motion");
  std::string names;  // "'linear', 'polynomial', ..."
  const auto read_one = [&]<class Traits>(const Simulation_snapshot<Traits>& /*kind*/) {
    if (PeriodicKineticTraits_2<Traits> != is_periodic) return false;
    constexpr std::string_view name = Checkpoint_motion<typename Traits::Motion>::name;
    append(names, names.empty() ? "'" : ", '", name, "'");
    if (motion.text() != name) return false;
    result = simulation_snapshot<Traits>(state);
    return true;
  };
  if ((read_one(Snapshots()) || ...)) return;
  motion.fail(joined("is ", kinetri::in_quotes(motion.text()), "; expected one of ", names,
                     is_periodic ? " in a periodic box" : ""));
}

}  // namespace

Checkpoint read_checkpoint(std::istream& in, const std::string& name) {
  const Json_document document(read_checkpoint_state(in, name));
  if (!document.is_valid()) {
    throw Input_error(
        name, 0, "is no JSON between its first and last line; expected the file as it was written");
  }
  const Json_value state = document.value(name, "state");
  Checkpoint result;
  result.response = state.member("response").text();
  result.periodic_box =
      periodic_box(state.member("periodic_box"), exact_time(state.member("time")));
  read_snapshot(state, result.periodic_box.has_value(), result.simulation);
  result.logs = logs(state.member("logs"));
  return result;
}

Checkpoint read_checkpoint_file(const std::string& path) {
  if (path == "-") return read_checkpoint(std::cin, "standard input");
  std::ifstream in = open_input(path, "a simulation's state");
  return read_checkpoint(in, path);
}

}  // namespace kinetri
