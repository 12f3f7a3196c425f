// SPDX-License-Identifier: GPL-3.0-or-later
// The files that are verified, as docs/PROGRAM.md describes them. A decimal number in them means
// the nearest binary64 number; std::from_chars rounds to that one, and from there on all is exact.
#ifndef KINETRI_VERIFY_FILES_H
#define KINETRI_VERIFY_FILES_H

#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "roots.h"

namespace verify {

using Id = std::uint32_t;
using Edge = std::pair<Id, Id>;  // the smaller id first

struct Bad_input : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What the log says is not true; found at the row with that number in its column `event`.
struct Refuted {
  std::string where;
  std::string message;
};

[[noreturn]] inline void refute_row(std::size_t row, const std::string& message) {
  throw Refuted{std::string("row ").append(std::to_string(row)), message};
}

// x, y, vx, vy: the point is at (x + vx t, y + vy t).
using Motion = std::array<double, 4>;

struct Row {
  std::size_t line = 0;
  std::string kind;
  Dyadic lo, hi;
  std::vector<Edge> removed, added;  // at most one edge each
};

inline std::string quoted(std::string_view field) {
  return std::string("'").append(field.substr(0, 40)).append(field.size() > 40 ? "...'" : "'");
}

// Decimal or hexadecimal, with a sign; std::from_chars takes only a minus sign and no 0x.
inline bool read_number(std::string_view text, double& value) {
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  const bool is_hexadecimal = text.starts_with("0x") || text.starts_with("0X");
  if (is_hexadecimal) text.remove_prefix(2);
  if (text.starts_with('-')) return false;
  const auto format = is_hexadecimal ? std::chars_format::hex : std::chars_format::general;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, format);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  if (is_negative) value = -value;
  return std::isfinite(value);
}

// The lines of a file that are neither blank nor comments, in fields.
class Table {
 public:
  explicit Table(const std::string& path) : path_(path), in_(path, std::ios::binary) {
    if (!in_) throw Bad_input(path + ": cannot be opened; expected a readable file");
    if (!next()) fail("the file is empty; expected a header line");
    header_ = fields_;
    for (std::string& name : header_) {
      for (char& c : name) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
      }
    }
  }

  const std::vector<std::string>& header() const { return header_; }
  std::size_t line() const { return line_; }

  // Goes to the next line. False at the end.
  bool next() {
    std::string text;
    while (std::getline(in_, text)) {
      if (++line_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
      if (text.starts_with('#') || text.find_first_not_of(" \t\r") == std::string::npos) continue;
      split(text);
      if (!header_.empty() && fields_.size() != header_.size()) {
        fail("the row has " + std::to_string(fields_.size()) + " fields; expected " +
             std::to_string(header_.size()) + ", one for each column of the header");
      }
      return true;
    }
    if (in_.bad() || !in_.eof()) fail("cannot be read; expected a readable file");
    ++line_;
    return false;
  }

  // The index of the column.
  std::size_t column(std::string_view name) const {
    std::size_t found = header_.size();
    for (std::size_t i = 0; i < header_.size(); ++i) {
      if (header_[i] != name) continue;
      if (found != header_.size()) fail("the column " + header_[i] + " is named twice");
      found = i;
    }
    if (found == header_.size()) fail("the column " + std::string(name) + " is missing");
    return found;
  }

  const std::string& field(std::size_t column) const { return fields_[column]; }

  double number(std::size_t column) const {
    double value = 0;
    if (!read_number(fields_[column], value)) {
      fail("the column " + header_[column] + " is " + quoted(fields_[column]) +
           "; expected a finite decimal or hexadecimal number");
    }
    return value;
  }

  // Appends the edge in two columns, if there is one.
  void append_edge(std::size_t a, std::size_t points, std::vector<Edge>& edges) const {
    if (fields_[a].empty() && fields_[a + 1].empty()) return;
    edges.emplace_back(id(a, points), id(a + 1, points));
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Bad_input(path_ + ":" + std::to_string(line_) + ": " + message);
  }

 private:
  Id id(std::size_t column, std::size_t points) const {
    const std::string& text = fields_[column];
    Id value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value >= points) {
      fail("the column " + header_[column] + " is " + quoted(text) +
           "; expected the id of one of the " + std::to_string(points) + " points");
    }
    return value;
  }

  // Fields may be quoted; in quotation marks two of them stand for one. Semicolons separate fields
  // if the header has no comma.
  void split(const std::string& text) {
    if (header_.empty() && text.find(',') == std::string::npos &&
        text.find(';') != std::string::npos) {
      separator_ = ';';
    }
    fields_.assign(1, "");
    bool is_quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '"') {
        if (is_quoted && i + 1 < text.size() && text[i + 1] == '"') {
          fields_.back() += text[++i];
        } else {
          is_quoted = !is_quoted;
        }
      } else if (c == separator_ && !is_quoted) {
        fields_.emplace_back();
      } else {
        fields_.back() += c;
      }
    }
    if (is_quoted) fail("a quotation mark is not closed");
    for (std::string& field : fields_) {
      const std::size_t begin = field.find_first_not_of(" \t\r");
      const std::size_t end = field.find_last_not_of(" \t\r");
      field = begin == std::string::npos ? "" : field.substr(begin, end + 1 - begin);
    }
  }

  std::string path_;
  std::ifstream in_;
  std::vector<std::string> header_, fields_;
  char separator_ = ',';
  std::size_t line_ = 0;
};

inline std::vector<Motion> read_points(const std::string& path) {
  Table table(path);
  for (const std::string& name : table.header()) {
    for (const char* other : {"radius", "growth", "ax", "ay", "jx", "jy"}) {
      if (name == other) {
        table.fail("the column " + name + " is not supported; expected points that move linearly");
      }
    }
  }
  const std::array<std::size_t, 4> columns = {table.column("x"), table.column("y"),
                                              table.column("vx"), table.column("vy")};
  std::vector<Motion> points;
  std::map<Motion, std::size_t> lines;
  while (table.next()) {
    Motion motion;
    for (std::size_t i = 0; i < 4; ++i) motion[i] = table.number(columns[i]) + 0.0;  // no -0
    const auto [same, is_new] = lines.emplace(motion, table.line());
    if (!is_new) {
      table.fail("the point moves as the one in line " + std::to_string(same->second) +
                 "; expected points that differ");
    }
    points.push_back(motion);
  }
  return points;
}

// Whether hi - lo > 2^-48 max(1, |lo|, |hi|).
inline bool is_too_wide(const Dyadic& lo, const Dyadic& hi) {
  const unsigned long e = std::max(lo.e, hi.e);
  const Integer l = lo.m << (e - lo.e);
  const Integer h = hi.m << (e - hi.e);
  return ((h - l) << 48) > std::max({Integer(Integer(1) << e), Integer(abs(l)), Integer(abs(h))});
}

inline std::vector<Row> read_events(const std::string& path, std::size_t points) {
  Table table(path);
  static const std::vector<std::string> header = {"event",   "kind",      "time",      "time_lo",
                                                  "time_hi", "removed_a", "removed_b", "added_a",
                                                  "added_b", "point_a",   "point_b"};
  if (table.header() != header) table.fail("this is not the header of an event log");
  static const std::map<std::string, std::array<std::size_t, 2>> edges_of_kinds = {
      {"flip", {1, 1}}, {"hull_insert", {1, 0}}, {"hull_remove", {0, 1}}, {"rebuild", {2, 2}}};
  std::vector<Row> rows;
  while (table.next()) {
    Row row;
    row.line = table.line();
    row.kind = table.field(1);
    table.append_edge(5, points, row.removed);
    table.append_edge(7, points, row.added);
    const auto expected = edges_of_kinds.find(row.kind);
    if (expected == edges_of_kinds.end()) {
      table.fail("the kind " + quoted(row.kind) +
                 " is not supported; expected flip, hull_insert, hull_remove or rebuild");
    }
    row.lo = dyadic(table.number(3));
    row.hi = dyadic(table.number(4));
    const std::array<std::size_t, 2> has = {row.removed.size(), row.added.size()};
    if (row.kind == "rebuild" ? has[0] + has[1] != 1 : has != expected->second) {
      refute_row(rows.size(), "it has not the edges of a " + row.kind);
    }
    if (table.field(0) != std::to_string(rows.size())) {
      refute_row(rows.size(), "its number is " + quoted(table.field(0)));
    }
    const Dyadic time = dyadic(table.number(2));
    if (compare(row.lo, time) > 0 || compare(time, row.hi) > 0) {
      refute_row(rows.size(), "its time is not in [time_lo, time_hi]");
    }
    if (is_too_wide(row.lo, row.hi)) {
      refute_row(rows.size(), "[time_lo, time_hi] is wider than 2^-48 max(1, |time|)");
    }
    for (const auto& edges : {row.removed, row.added}) {
      for (const Edge& edge : edges) {
        if (edge.first >= edge.second) {
          refute_row(rows.size(), "an edge is not two ids, the smaller one first");
        }
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

inline std::vector<Edge> read_edges(const std::string& path, std::size_t points) {
  Table table(path);
  if (table.header() != std::vector<std::string>{"a", "b"}) table.fail("expected the header a,b");
  std::vector<Edge> edges;
  while (table.next()) {
    table.append_edge(0, points, edges);
    if (edges.empty() || edges.back().first >= edges.back().second ||
        (edges.size() > 1 && !(edges[edges.size() - 2] < edges.back()))) {
      table.fail("expected edges that differ, in order, with the smaller id first");
    }
  }
  return edges;
}

}  // namespace verify

#endif  // KINETRI_VERIFY_FILES_H
