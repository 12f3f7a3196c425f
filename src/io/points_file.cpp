// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/points_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <optional>
#include <system_error>
#include <tuple>

#include "kinetri/base/check.h"
#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "text_table.h"

namespace kinetri {
namespace {

constexpr Table_kind points_kind = {"points", "point"};

constexpr std::string_view not_a_number =
    "is not a number; expected a decimal or hexadecimal floating point number such as -1.5, "
    "2e-3 or 0x1.8p3";
constexpr std::string_view not_finite = "is not finite; expected a finite number";
constexpr std::string_view out_of_range =
    "is out of the range of binary64; expected 0, or a magnitude from 4.9e-324 to 1.8e308";

enum Column : std::size_t { x, y, vx, vy, ax, ay, jx, jy, radius, column_count };
constexpr std::array<std::string_view, column_count> column_names = {
    "x", "y", "vx", "vy", "ax", "ay", "jx", "jy", "radius"};
constexpr std::size_t required_columns = ax;
constexpr std::string_view expected_columns =
    "expected a header line with the columns x,y,vx,vy and optionally radius, ax,ay, jx,jy, in any "
    "order";

// The numbers of a motion with epoch 0 in the order of the columns.
std::array<double, 4> numbers(const Linear_motion_2& m) {
  return {m.position.x, m.position.y, m.velocity.x, m.velocity.y};
}
std::array<double, 8> numbers(const Polynomial_motion_2& m) {
  return {m.position.x,     m.position.y,     m.velocity.x, m.velocity.y,
          m.acceleration.x, m.acceleration.y, m.jerk.x,     m.jerk.y};
}

class Points_reader {
 public:
  Points_reader(std::istream& in, const std::string& name)
      : table_(in, name, points_kind), name_(name) {}

  Points_file read() {
    columns_ = table_.read_header(column_names, required_columns, expected_columns);
    has_radius_ = has(radius);
    check_pair(ax, ay);
    check_pair(jx, jy);
    result_.is_polynomial = has(ax) || has(jx);
    while (const auto line = table_.next()) read_row(*line);
    if (result_.is_polynomial) {
      reject_equal_points(result_.polynomial_motions);
    } else {
      reject_equal_points(result_.motions);
    }
    return std::move(result_);
  }

 private:
  bool has(Column column) const {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
  }

  void check_pair(Column first, Column second) const {
    if (has(first) == has(second)) return;
    table_.fail(fmt::format("the column {} is missing; expected both {} and {}, or neither",
                            column_names[has(first) ? second : first], column_names[first],
                            column_names[second]));
  }

  void read_row(std::string_view line) {
    if (result_.lines.size() == no_point - 1) {
      table_.fail(fmt::format("there are too many points; expected at most {}", no_point - 1));
    }
    std::array<double, column_count> values = {};
    std::size_t fields = 0;
    for_each_field_between_commas(line, [&](std::string_view field) {
      if (fields < columns_.size()) {
        const std::size_t column = columns_[fields];
        values[column] = table_.number(field, column_names[column]);
      }
      ++fields;
    });
    table_.check_number_of_fields(fields, columns_.size());
    const Vector_2 position = {values[x], values[y]};
    const Vector_2 velocity = {values[vx], values[vy]};
    if (result_.is_polynomial) {
      result_.polynomial_motions.push_back(
          {position, velocity, {values[ax], values[ay]}, {values[jx], values[jy]}, 0});
    } else {
      result_.motions.push_back({position, velocity, 0});
    }
    result_.lines.push_back(table_.line());
    if (has_radius_) {
      if (values[radius] < 0) {
        table_.fail(fmt::format("the radius {} is negative; expected at least 0", values[radius]));
      }
      result_.radii.push_back(values[radius]);
    }
  }

  // Sorts ids by x, kept beside them, and by the other numbers where x does not decide. Not by a
  // hash: no input makes this quadratic.
  template <class Motion>
  void reject_equal_points(const std::vector<Motion>& motions) const {
    struct Entry {
      double x;
      Point_id id;
    };
    std::vector<Entry> entries(motions.size());
    for (std::size_t id = 0; id < motions.size(); ++id) {
      entries[id] = {motions[id].position.x, static_cast<Point_id>(id)};
    }
    const auto others = [&motions](const Entry& entry) { return numbers(motions[entry.id]); };
    std::sort(entries.begin(), entries.end(), [&](const Entry& a, const Entry& b) {
      if (a.x != b.x) return a.x < b.x;
      const auto others_a = others(a);
      const auto others_b = others(b);
      return others_a != others_b ? others_a < others_b : a.id < b.id;
    });
    std::optional<std::array<Point_id, 2>> first;  // the pair whose second line comes first
    for (std::size_t i = 1; i < entries.size(); ++i) {
      const Entry& a = entries[i - 1];
      const Entry& b = entries[i];
      if (a.x == b.x && others(a) == others(b) && (!first || b.id < (*first)[1])) {
        first = {a.id, b.id};
      }
    }
    if (!first) return;
    throw Input_error(
        name_, result_.lines[(*first)[1]],
        fmt::format("the point has the same place and {} as the one in line {}; expected points "
                    "that differ in one of them: remove one or change its motion",
                    result_.is_polynomial ? "derivatives" : "velocity",
                    result_.lines[(*first)[0]]));
  }

  Table_reader table_;
  const std::string& name_;
  std::vector<std::size_t> columns_;  // the Column of each field
  bool has_radius_ = false;
  Points_file result_;
};

}  // namespace

Parsed_number parse_number(std::string_view text) {
  std::string_view digits = text;
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) digits.remove_prefix(1);
  const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
  if (hexadecimal) digits.remove_prefix(2);
  // std::from_chars takes a minus sign; it would be the second one here.
  if (digits.starts_with('-')) return {0, not_a_number};
  const char* const end = digits.data() + digits.size();
  double value = 0;
  const auto [stop, error] = std::from_chars(
      digits.data(), end, value, hexadecimal ? std::chars_format::hex : std::chars_format::general);
  if (error == std::errc::invalid_argument || stop != end) return {0, not_a_number};
  if (error == std::errc::result_out_of_range) return {0, out_of_range};
  if (!std::isfinite(value)) return {0, not_finite};
  return {negative ? -value : value, {}};
}

Points_file read_points(std::istream& in, const std::string& name) {
  return Points_reader(in, name).read();
}

Points_file read_points_file(const std::string& path) {
  if (path == "-") return read_points(std::cin, "standard input");
  std::ifstream in = open_table(path, points_kind);
  return read_points(in, path);
}

namespace {

template <class Motion>
void write_all_points(std::ostream& out, std::span<const Motion> motions,
                      std::span<const double> radii) {
  KINETRI_PRECONDITION(radii.empty() || radii.size() == motions.size(),
                       "there are not as many radii as points; expected one for each, or none");
  constexpr std::size_t columns = std::tuple_size_v<decltype(numbers(Motion()))>;
  out << fmt::format("{}{}\n", fmt::join(column_names.begin(), column_names.begin() + columns, ","),
                     radii.empty() ? "" : ",radius");
  fmt::memory_buffer row;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    KINETRI_PRECONDITION(
        is_finite(motions[i]) && motions[i].epoch == 0,
        "a motion has a number that is not finite, or begins at another time than 0");
    row.clear();
    fmt::format_to(std::back_inserter(row), "{}", fmt::join(numbers(motions[i]), ","));
    if (!radii.empty()) fmt::format_to(std::back_inserter(row), ",{}", radii[i]);
    row.push_back('\n');
    out.write(row.data(), static_cast<std::streamsize>(row.size()));
  }
}

}  // namespace

void write_points(std::ostream& out, std::span<const Linear_motion_2> motions,
                  std::span<const double> radii) {
  write_all_points(out, motions, radii);
}

void write_points(std::ostream& out, std::span<const Polynomial_motion_2> motions,
                  std::span<const double> radii) {
  write_all_points(out, motions, radii);
}

}  // namespace kinetri
