// SPDX-License-Identifier: GPL-3.0-or-later
// The files that are verified, as docs/PROGRAM.md describes them. A decimal number in them means
// the nearest binary64 number; std::from_chars rounds to that one, and from there on all is exact.
#ifndef KINETRI_VERIFY_FILES_H
#define KINETRI_VERIFY_FILES_H

#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <deque>
#include <fstream>
#include <future>
#include <iomanip>
#include <iostream>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "roots.h"

namespace verify {

using Id = std::uint32_t;

// How often the two vectors of a periodic box are added to a position.
struct Offset {
  std::int64_t x = 0, y = 0;
  friend auto operator<=>(const Offset&, const Offset&) = default;
  friend Offset operator+(const Offset& a, const Offset& b) { return {a.x + b.x, a.y + b.y}; }
  friend Offset operator-(const Offset& a, const Offset& b) { return {a.x - b.x, a.y - b.y}; }
};

// An edge from the point `first` to the image of `second` with the offset; and, in a periodic box,
// all images of that. The smaller id first; of the two edges from a point to its own images, the
// one of the greater offset.
struct Edge {
  Id first, second;
  Offset offset = {};
  friend auto operator<=>(const Edge&, const Edge&) = default;
};

struct Bad_input : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The log is refuted at the row with this number, or at the start (-1).
struct Refuted {
  long row;
  std::string message;
};

// At the time t and with s = t - epoch the point is at x + vx s + ax s^2 / 2 + jx s^3 / 6, and so
// on, and has the radius radius + growth s.
enum Number { x, y, vx, vy, ax, ay, jx, jy, radius, growth, epoch, numbers };
using Motion = std::array<double, numbers>;

struct Change {
  Id id;
  std::optional<Motion> motion;  // none if the point is erased
};

struct Row {
  std::size_t number = 0;              // in the column `event`
  std::optional<std::size_t> instant;  // in the column `instant`, if present
  std::string kind;
  double time = 0;
  Dyadic lo, hi;
  std::vector<Edge> removed, added;  // at most one edge each
  std::vector<Id> points;
  Offset offset;                // of the image of the second point that the first one touches
  std::optional<Id> by;         // the point that hides the other one
  std::vector<Change> changes;  // of motions
};

inline std::string row_name(long row, const std::vector<Row>& rows) {
  if (row < 0) return "the start";
  if (row >= std::ssize(rows)) return "the end";
  return "row " + std::to_string(rows[static_cast<std::size_t>(row)].number);
}

struct Options {
  Dyadic from, until;
  std::vector<Motion> lattice;        // the two vectors of a periodic box, if there is one
  std::map<std::size_t, double> box;  // positions of sides: 0 left, 1 lower, 2 right, 3 upper
  bool has_rim = false;
  bool has_contacts = false;
  bool may_collide = true;
  // Which discs may pass through each other after a collision. Of two discs at rest an image may
  // move, in a periodic box.
  enum class Passing { none, at_rest, all } passing = Passing::all;
  std::size_t threads = 1;
};

// Reads a decimal or hexadecimal number with a sign; std::from_chars accepts neither + nor 0x.
inline bool read_number(std::string_view text, double& value) {
  const bool is_negative = text.starts_with('-');
  if (is_negative || text.starts_with('+')) text.remove_prefix(1);
  const bool is_hexadecimal = text.starts_with("0x") || text.starts_with("0X");
  if (is_hexadecimal) text.remove_prefix(2);
  if (text.starts_with('-')) return false;
  const auto format = is_hexadecimal ? std::chars_format::hex : std::chars_format::general;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, format);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  value = is_negative ? -value : value;
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
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
    }
  }

  // Goes to the next line. False at the end.
  bool next() {
    std::string text;
    while (std::getline(in_, text)) {
      if (++line_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
      if (text.ends_with('\r')) text.pop_back();
      if (text.find_first_not_of(" \t") == std::string::npos) continue;
      if (text.starts_with('#') && !is_row(text)) continue;
      if (header_.empty() && text.find(',') == std::string::npos) separator_ = ';';
      if (!split(text)) fail("a quotation mark is not closed");
      if (header_.empty() || fields_.size() == header_.size()) return true;
      fail("the row has " + std::to_string(fields_.size()) + " fields; expected " +
           std::to_string(header_.size()) + ", one for each column of the header");
    }
    if (in_.bad() || !in_.eof()) fail("cannot be read; expected a readable file");
    return false;
  }

  // Checks that the columns are the expected ones, with or without the optional one at the end.
  void expect_header(const std::string& expected, const std::string& optional = "") const {
    std::string header;
    for (const std::string& name : header_) header += (header.empty() ? "" : ",") + name;
    if (header == expected || (!optional.empty() && header == expected + ',' + optional)) return;
    fail("the header is not " + expected +
         (optional.empty() ? "" : ", with or without " + optional + " at its end"));
  }

  bool has(std::string_view name) const {
    return std::find(header_.begin(), header_.end(), name) != header_.end();
  }
  const std::string& field(std::string_view name) const {
    const auto found = std::find(header_.begin(), header_.end(), name);
    if (found == header_.end()) fail("the column " + std::string(name) + " is missing");
    return fields_[static_cast<std::size_t>(found - header_.begin())];
  }

  double number(std::string_view name) const {
    double value = 0;
    if (read_number(field(name), value)) return value + 0.0;  // 0 for -0
    fail("the column " + std::string(name) + " is '" + field(name) + "'; expected a finite number");
  }

  std::size_t index(std::string_view name) const {
    std::size_t value = 0;
    const std::string& text = field(name);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && value < 100'000'000)
      return value;
    fail("the column " + std::string(name) + " is '" + text + "'; expected a whole number");
  }

  // An offset, as in "1 -2".
  Offset offset(std::string_view name) const {
    const std::string& text = field(name);
    std::array<std::int32_t, 2> numbers_read = {};
    const char* const blank = text.data() + std::min(text.find(' '), text.size());
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), blank, numbers_read[0]);
    if (first.ec == std::errc() && first.ptr == blank && blank != end) {
      const auto second = std::from_chars(blank + 1, end, numbers_read[1]);
      if (second.ec == std::errc() && second.ptr == end) return {numbers_read[0], numbers_read[1]};
    }
    fail("the column " + std::string(name) + " is '" + text +
         "'; expected two whole numbers, separated by a blank");
  }

  // The edge in two columns, and that of its offset in a periodic box.
  Edge edge(std::string_view a, std::string_view b, std::string_view offset_of,
            bool is_periodic) const {
    return {static_cast<Id>(index(a)), static_cast<Id>(index(b)),
            is_periodic ? offset(offset_of) : Offset()};
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Bad_input(path_ + ":" + std::to_string(line_) + ": " + message);
  }

 private:
  // Splits the line into fields. False if a quotation mark is not closed.
  bool split(const std::string& text) {
    fields_.assign(1, "");
    bool is_quoted = false;
    for (const char c : text) {
      if (c == '"') {
        is_quoted = !is_quoted;
      } else if (c == separator_ && !is_quoted) {
        fields_.emplace_back();
      } else {
        fields_.back() += c;
      }
    }
    for (std::string& field : fields_) {  // trim blanks
      field.erase(0, field.find_first_not_of(" \t"));
      field.erase(field.find_last_not_of(" \t") + 1);
    }
    return !is_quoted;
  }

  // Whether the line, which begins with #, is a point with a label that begins with #: all columns
  // of numbers contain numbers.
  bool is_row(const std::string& text) {
    static const std::set<std::string_view> of_numbers = {
        "x", "y", "vx", "vy", "ax", "ay", "jx", "jy", "radius", "growth", "mass", "z", "vz"};
    if (header_.empty() || header_.front() != "id" || !split(text)) return false;
    if (fields_.size() != header_.size()) return false;
    for (std::size_t i = 0; i < header_.size(); ++i) {
      double value = 0;
      if (of_numbers.contains(header_[i]) && !read_number(fields_[i], value)) return false;
    }
    return true;
  }

  std::string path_;
  std::ifstream in_;
  std::vector<std::string> header_, fields_;
  char separator_ = ',';
  std::size_t line_ = 0;
};

inline bool changes_motions(const Row& row) {
  static const std::set<std::string_view> kinds = {"insert", "erase", "trajectory", "wall",
                                                   "collision"};
  return kinds.contains(row.kind);
}

// The motions at the start: the rows of a file of points, or the rows without an event in a file of
// motions. Other rows of a file of motions are added to `rows`, if given, at their events; with a
// file of points no row of the log may need a motion. If `columns` is given, radii and growths of
// points are read, and it gets the columns that exist.
inline std::vector<Change> read_motions(const std::string& path, std::vector<Row>* rows,
                                        std::set<std::size_t>* columns = nullptr) {
  static constexpr std::array<std::string_view, numbers> names = {
      "x", "y", "vx", "vy", "ax", "ay", "jx", "jy", "radius", "growth", "epoch"};
  Table table(path);
  const bool is_of_motions = table.has("event");
  for (const std::size_t i : {radius, growth}) {
    if (columns != nullptr && table.has(names[i])) columns->insert(i);
  }
  if (is_of_motions) table.expect_header("event,id,x,y,vx,vy,ax,ay,jx,jy,radius,growth,epoch");
  std::vector<Change> points;
  std::size_t event = 0;
  while (table.next()) {
    Change change = {static_cast<Id>(is_of_motions ? table.index("id") : points.size()), {}};
    if (!is_of_motions || !table.field("x").empty()) {
      change.motion.emplace();
      for (std::size_t i = 0; i < numbers; ++i) {
        const bool is_there = is_of_motions || i <= vy || (i <= jy && table.has(names[i])) ||
                              (columns != nullptr && columns->contains(i));
        (*change.motion)[i] = is_there ? table.number(names[i]) : 0;
      }
    }
    if (is_of_motions && !table.field("event").empty()) {
      if (rows == nullptr) continue;
      const std::size_t number = table.index("event");
      const std::size_t row = rows->empty() ? number : number - rows->front().number;
      if (row >= rows->size() || row < event) {
        table.fail("the event is not one of the log, or not in order");
      }
      event = row;
      (*rows)[event].changes.push_back(std::move(change));
    } else if (!change.motion || (!points.empty() && change.id <= points.back().id)) {
      table.fail("expected the motions at the start in the order of the ids");
    } else {
      points.push_back(std::move(change));
    }
  }
  if (!is_of_motions && rows != nullptr && std::ranges::any_of(*rows, changes_motions))
    throw Bad_input(path + ": motions change in the log; expected --motions");
  return points;
}

// Whether an edge is named as Edge says.
inline bool is_normal(const Edge& e) {
  return e.first < e.second || (e.first == e.second && e.offset > Offset() - e.offset);
}

// `is_periodic`: the log is one of points in a periodic box.
inline void read_events(const std::string& path, bool is_periodic, std::vector<Row>& rows) {
  Table table(path);
  const std::string columns =
      "event,kind,time,time_lo,time_hi,removed_a,removed_b,added_a,added_b,point_a,point_b";
  if (is_periodic) {
    table.expect_header(columns + ",instant,removed_offset,added_offset");
  } else if (table.has("removed_offset")) {
    table.fail("the log is one of a periodic box; expected --periodic");
  } else {
    table.expect_header(columns, "instant");
  }
  const bool has_instants = table.has("instant");
  static const std::map<std::string, std::array<std::size_t, 3>> kinds = {
      {"flip", {1, 1, 0}},    {"hull_insert", {1, 0, 0}}, {"hull_remove", {0, 1, 0}},
      {"hide", {0, 0, 1}},    {"reveal", {0, 0, 1}},      {"insert", {0, 0, 1}},
      {"erase", {0, 0, 1}},   {"trajectory", {0, 0, 1}},  {"wall", {0, 0, 1}},
      {"rebuild", {0, 0, 0}}, {"collision", {0, 0, 2}}};
  while (table.next()) {
    Row& row = rows.emplace_back();
    row.number = table.index("event");
    row.kind = table.field("kind");
    const auto expected = kinds.find(row.kind);
    if (expected == kinds.end()) table.fail("the kind '" + row.kind + "' is unknown");
    row.time = table.number("time");
    row.lo = dyadic(table.number("time_lo"));
    row.hi = dyadic(table.number("time_hi"));
    for (const std::string what : {"removed", "added"}) {
      std::vector<Edge>& edges = what == "added" ? row.added : row.removed;
      if (table.field(what + "_a").empty() && table.field(what + "_b").empty()) continue;
      edges.push_back(table.edge(what + "_a", what + "_b", what + "_offset", is_periodic));
    }
    for (const char* name : {"point_a", "point_b"}) {
      if (!table.field(name).empty()) row.points.push_back(static_cast<Id>(table.index(name)));
    }
    if ((row.kind == "hide" || row.kind == "reveal") && row.points.size() == 2) {
      row.by = row.points.back();
      row.points.pop_back();
    }
    const auto refute = [&](const std::string& message) {
      throw Refuted{std::ssize(rows) - 1, message};
    };
    if (is_periodic && (row.kind.starts_with("hull") || row.kind == "wall")) {
      refute("there is no " + row.kind + " in a periodic box");
    }
    const std::array<std::size_t, 3> has = {row.removed.size(), row.added.size(),
                                            row.points.size()};
    if (row.kind == "rebuild" ? has[0] + has[1] != 1 || has[2] != 0 : has != expected->second) {
      refute("it has not the edges and points of a " + row.kind);
    }
    const bool has_offset = is_periodic && row.kind == "collision";
    if (has_offset) row.offset = table.offset("added_offset");
    if (is_periodic &&
        ((row.removed.empty() && !table.field("removed_offset").empty()) ||
         (row.added.empty() && !has_offset && !table.field("added_offset").empty()))) {
      refute("it has an offset of no edge");
    }
    for (const auto& edges : {row.removed, row.added}) {
      if (edges.empty() || is_normal(edges.front())) continue;
      refute(is_periodic && edges.front().first == edges.front().second
                 ? "an edge from a point to its image has the lesser offset"
                 : "an edge has its smaller end last");
    }
    if (row.points.size() == 2 && row.points[0] >= row.points[1])
      refute("it has its smaller point last");
    const auto number = rows.front().number + rows.size() - 1;
    if (row.number != number) refute("its number is not " + std::to_string(number));
    if (has_instants) {
      row.instant = table.index("instant");
      const Row* before = rows.size() > 1 ? &rows[rows.size() - 2] : nullptr;
      if (row.instant != number && (before == nullptr || row.instant != before->instant)) {
        refute("its instant is neither its own number nor that of the row before");
      }
    }
    const Dyadic time = dyadic(row.time);
    const Dyadic width = row.hi + Dyadic{-row.lo.m, row.lo.e};
    const Dyadic wide = {width.m << 48, width.e};
    if (compare(row.lo, time) > 0 || compare(time, row.hi) > 0 ||
        (compare(wide, {1, 0}) > 0 && compare(wide, {abs(time.m), time.e}) > 0)) {
      refute("its interval lacks its time, or is wider than 2^-48 max(1, |time|)");
    }
  }
}

inline std::vector<Edge> read_edges(const std::string& path, bool is_periodic) {
  Table table(path);
  table.expect_header(is_periodic ? "a,b,offset" : "a,b");
  std::vector<Edge> edges;
  while (table.next()) {
    edges.push_back(table.edge("a", "b", "offset", is_periodic));
    if (!is_normal(edges.back()) ||
        (edges.size() > 1 && !(edges[edges.size() - 2] < edges.back()))) {
      table.fail(std::string("expected edges that differ, in order, with the smaller id first") +
                 (is_periodic ? ", and with the greater offset from a point to its image" : ""));
    }
  }
  return edges;
}

}  // namespace verify

#endif  // KINETRI_VERIFY_FILES_H
