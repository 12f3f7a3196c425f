// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads event logs and motion logs.
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "io/text_table.h"
#include "kinetri/impl/io/text.h"
#include "kinetri/io/event_log.h"
#include "kinetri/io/motion_log.h"

namespace kinetri {
namespace {

// What a log is for messages, and its columns.
template <std::size_t size>
struct Log_format {
  Table_kind kind;
  std::array<std::string_view, size> columns;
  std::string_view expected;
};

// Those of a periodic box have two more columns.
constexpr std::size_t planar_columns = 12;
constexpr Log_format<14> event_log = {
    {"events, as --events writes it", "event"},
    {"event", "kind", "time", "time_lo", "time_hi", "removed_a", "removed_b", "added_a", "added_b",
     "point_a", "point_b", "instant", "removed_offset", "added_offset"},
    "expected a header line with the columns event,kind,time,time_lo,time_hi,removed_a,removed_b,"
    "added_a,added_b,point_a,point_b,instant"};
constexpr Log_format<13> motion_log = {
    {"motions, as --motions writes it", "motion"},
    {"event", "id", "x", "y", "vx", "vy", "ax", "ay", "jx", "jy", "radius", "growth", "epoch"},
    "expected a header line with the columns event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch"};

// The rows of a log, one after the other. Columns are indices in those of the format, of which a
// file must have the first `necessary` ones.
template <std::size_t size>
class Log_rows {
 public:
  Log_rows(std::istream& in, const std::string& name, const Log_format<size>& format,
           std::size_t necessary = size)
      : names_(format.columns), table_(in, name, format.kind) {
    columns_ = table_.read_header(names_, necessary, format.expected);
  }

  bool next() {
    const auto text = table_.next();
    if (!text) return false;
    std::size_t fields = 0;
    for_each_field_between_commas(*text, [&](std::string_view field) {
      if (fields < columns_.size()) fields_[columns_[fields]] = field;
      ++fields;
    });
    table_.check_number_of_fields(fields, columns_.size());
    return true;
  }

  std::size_t line() const { return table_.line(); }
  bool is_empty(std::size_t column) const { return fields_[column].empty(); }

  double number(std::size_t column) const { return table_.number(fields_[column], names_[column]); }
  std::uint64_t event_number(std::size_t column) const {
    return table_.whole_number(fields_[column], names_[column],
                               std::numeric_limits<std::uint64_t>::max());
  }
  Point_id point(std::size_t column) const {
    return static_cast<Point_id>(
        table_.whole_number(fields_[column], names_[column], no_point - 1));
  }
  std::optional<Point_id> optional_point(std::size_t column) const {
    if (is_empty(column)) return std::nullopt;
    return point(column);
  }
  std::optional<Edge_ids> optional_edge(std::size_t a, std::size_t b) const {
    if (is_empty(a) && is_empty(b)) return std::nullopt;
    return Edge_ids{point(a), point(b)};
  }

  // Two whole numbers with a blank between; zero if the field is empty, or if there is none.
  Lattice_offset_2 offset(std::size_t column) const {
    if (is_empty(column)) return {};
    const std::string_view text = fields_[column];
    const std::size_t blank = text.find(' ');
    const auto x = parse_integer(text.substr(0, blank));
    const auto y = parse_integer(blank == text.npos ? std::string_view() : text.substr(blank + 1));
    if (x && y) return {*x, *y};
    table_.fail(joined("the column ", names_[column], " is ", in_quotes(text),
                       "; expected two whole numbers with a blank between, such as -1 0"));
  }

  Event_kind kind(std::size_t column) const {
    for (std::size_t i = 0; i < event_kinds; ++i) {
      const auto result = static_cast<Event_kind>(i);
      if (name(result) == fields_[column]) return result;
    }
    table_.fail(joined("the column ", names_[column], " is ", in_quotes(fields_[column]),
                       "; expected a kind of event, such as flip"));
  }

 private:
  static std::optional<std::int32_t> parse_integer(std::string_view text) {
    std::int32_t result = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, problem] = std::from_chars(text.data(), end, result);
    return problem == std::errc() && rest == end ? std::optional(result) : std::nullopt;
  }

  std::array<std::string_view, size> names_;
  Table_reader table_;
  std::vector<std::size_t> columns_;             // of the fields in a line
  std::array<std::string_view, size> fields_{};  // of the present line, by column
};

}  // namespace

std::vector<Logged_event> read_event_log(std::istream& in, const std::string& name) {
  std::vector<Logged_event> result;
  Log_rows rows(in, name, event_log, planar_columns);
  while (rows.next()) {
    Logged_event& event = result.emplace_back();
    event.number = rows.event_number(0);
    event.kind = rows.kind(1);
    event.time = {rows.number(3), rows.number(4)};
    event.removed = rows.optional_edge(5, 6);
    event.added = rows.optional_edge(7, 8);
    event.point_a = rows.optional_point(9);
    event.point_b = rows.optional_point(10);
    event.removed_offset = rows.offset(12);
    event.added_offset = rows.offset(13);
    event.line = rows.line();
  }
  return result;
}

std::vector<Logged_motion> read_motion_log(std::istream& in, const std::string& name) {
  std::vector<Logged_motion> result;
  Log_rows rows(in, name, motion_log);
  while (rows.next()) {
    Logged_motion& row = result.emplace_back();
    if (!rows.is_empty(0)) row.event = rows.event_number(0);
    row.id = rows.point(1);
    row.line = rows.line();
    bool is_erased = true;
    std::array<double, motion_log.columns.size()> n = {};
    for (std::size_t i = 2; i < n.size(); ++i) is_erased = is_erased && rows.is_empty(i);
    if (is_erased) continue;
    for (std::size_t i = 2; i < n.size(); ++i) n[i] = rows.number(i);
    const Polynomial_motion_2 center = {
        {n[2], n[3]}, {n[4], n[5]}, {n[6], n[7]}, {n[8], n[9]}, n[12]};
    row.motion = {center, n[10], n[11], 0};
  }
  return result;
}

}  // namespace kinetri
