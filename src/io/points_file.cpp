// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/points_file.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <map>
#include <utility>

#include "io/text_table.h"
#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"
#include "kinetri/impl/base/check.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "utf8_input.h"

namespace kinetri {
namespace {

constexpr Table_kind points_kind = {"points", "point"};

// Columns of numbers first.
enum Column : std::size_t {
  x,
  y,
  vx,
  vy,
  ax,
  ay,
  jx,
  jy,
  radius,
  growth,
  mass,
  z,
  vz,
  label,
  column_count
};
constexpr std::array<std::string_view, column_count> column_names = {
    "x", "y", "vx", "vy", "ax", "ay", "jx", "jy", "radius", "growth", "mass", "z", "vz", "id"};
constexpr std::size_t required_columns = ax;
constexpr std::string_view expected_columns =
    "expected a header line with the columns x,y,vx,vy and optionally radius, growth, mass, ax,ay, "
    "jx,jy, in any order";

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
    header_ = table_.read_csv_header(column_names, required_columns, expected_columns);
    has_radius_ = header_.has(radius);
    has_growth_ = header_.has(growth);
    has_mass_ = header_.has(mass);
    has_label_ = header_.has(label);
    check_pair(ax, ay);
    check_pair(jx, jy);
    check_pair(z, vz);
    result_.is_polynomial = header_.has(ax) || header_.has(jx);
    result_.ignored_columns = std::move(header_.ignored_names);
    table_.watch_rows([this](std::string_view line) { return is_row(line); });
    while (const auto line = table_.next()) read_row(*line);
    result_.comment_lines = table_.comments();
    if (header_.has(z)) {
      for (const Column column : {z, vz}) {
        result_.ignored_columns.push_back(in_quotes(column_names[column]));
      }
    }
    reject_equal_labels();
    return std::move(result_);
  }

 private:
  void check_pair(Column first, Column second) const {
    if (header_.has(first) == header_.has(second)) return;
    table_.fail(joined("the column ", column_names[header_.has(first) ? second : first],
                       " is missing; expected both ", column_names[first], " and ",
                       column_names[second], ", or neither"));
  }

  // Whether a line that begins with # is a row, whose label begins with #.
  bool is_row(std::string_view line) {
    if (header_.columns.front() != label) return false;
    std::size_t fields = 0;
    bool has_numbers = true;
    table_.for_each_csv_field(line, [&](std::string_view field) {
      const std::size_t column =
          fields < header_.columns.size() ? header_.columns[fields] : Csv_header::ignored;
      if (column < label) has_numbers = has_numbers && parse_number(field).problem.empty();
      ++fields;
    });
    return has_numbers && fields == header_.columns.size();
  }

  // A third coordinate must be the same for all points.
  void expect_one_plane(const std::array<double, label>& values) {
    if (!header_.has(z)) return;
    for (const Column column : {z, vz}) {
      double& first = column == z ? first_z_ : first_vz_;
      if (result_.lines.empty()) first = values[column];
      if (values[column] == first) continue;
      table_.fail(joined("the column ", column_names[column], " is ", values[column], ", but ",
                         first, " in line ", result_.lines.front(),
                         ", and points move in the plane of x and y; expected one ",
                         column_names[column], " for all, or no columns z and vz"));
    }
  }

  void read_row(std::string_view line) {
    if (result_.lines.size() == no_point - 1) {
      table_.fail(joined("there are too many points; expected at most ", no_point - 1));
    }
    const std::vector<std::size_t>& columns = header_.columns;
    std::array<double, label> values = {};
    std::size_t fields = 0;
    table_.for_each_csv_field(line, [&](std::string_view field) {
      if (fields < columns.size()) {
        const std::size_t column = columns[fields];
        if (column < label) values[column] = table_.number(field, column_names[column]);
        if (column == label) read_label(field);
      }
      ++fields;
    });
    table_.check_number_of_fields(fields, columns.size());
    expect_one_plane(values);
    const Vector_2 position = {values[x], values[y]};
    const Vector_2 velocity = {values[vx], values[vy]};
    if (result_.is_polynomial) {
      result_.polynomial_motions.push_back(
          {position, velocity, {values[ax], values[ay]}, {values[jx], values[jy]}, 0});
    } else {
      result_.motions.push_back({position, velocity, 0});
    }
    result_.lines.push_back(table_.line());
    read_disc(values);
  }

  void read_disc(const std::array<double, label>& values) {
    if (has_radius_) {
      if (values[radius] < 0) {
        table_.fail(joined("the radius ", values[radius], " is negative; expected at least 0"));
      }
      result_.radii.push_back(values[radius]);
    }
    if (has_growth_) result_.growths.push_back(values[growth]);
    if (has_mass_) {
      if (!(values[mass] > 0)) {
        table_.fail(joined("the mass ", values[mass], " is not positive; expected more than 0"));
      }
      result_.masses.push_back(values[mass]);
    }
  }

  void read_label(std::string_view field) {
    if (field.empty()) table_.fail("the column id is empty; expected any text");
    result_.labels.emplace_back(field);
  }

  void reject_equal_labels() const {
    if (!has_label_) return;
    std::map<std::string_view, Point_id> points;  // a tree, so that no input is slow
    for (Point_id point = 0; point < result_.labels.size(); ++point) {
      const auto [known, is_new] = points.emplace(result_.labels[point], point);
      if (is_new) continue;
      throw Input_error(
          name_, result_.lines[point],
          joined("the column id is ", in_quotes(known->first), ", as in line ",
                 result_.lines[known->second],
                 "; expected ids that differ, or another name of the column (where points have "
                 "several rows, they are tracks)"));
    }
  }

  Table_reader table_;
  const std::string& name_;
  Csv_header header_;
  bool has_radius_ = false;
  bool has_growth_ = false;
  bool has_mass_ = false;
  bool has_label_ = false;
  double first_z_ = 0;
  double first_vz_ = 0;
  Points_file result_;
};

}  // namespace

Points_file read_points(std::istream& in, const std::string& name) {
  Utf8_input utf8(in);
  Points_file result = Points_reader(utf8.stream(), name).read();
  result.is_utf16 = utf8.is_converted();
  return result;
}

Points_file read_points_file(const std::string& path) {
  if (path == "-") return read_points(std::cin, "standard input");
  std::ifstream in = open_input(path, points_kind.content);
  return read_points(in, path);
}

namespace {

// A column that a file may have.
struct Optional_column {
  Column column;
  std::span<const double> values;  // one for each point, or none
};

template <class Motion>
void write_all_points(std::ostream& out, std::span<const Motion> motions,
                      std::initializer_list<Optional_column> columns) {
  for (const auto& [column, values] : columns) {
    KINETRI_PRECONDITION(
        values.empty() || values.size() == motions.size(),
        "a column has not as many numbers as there are points; expected one for each, or none");
  }
  std::string row;
  const auto add_field = [&](const Text_piece& piece) {
    if (!row.empty()) row += ',';
    row += piece.text();
  };
  for (std::size_t i = 0; i < numbers(Motion()).size(); ++i) add_field(column_names[i]);
  for (const auto& [column, values] : columns) {
    if (!values.empty()) add_field(column_names[column]);
  }
  out << row << '\n';
  for (std::size_t i = 0; i < motions.size(); ++i) {
    KINETRI_PRECONDITION(
        is_finite(motions[i]) && motions[i].epoch == 0,
        "a motion has a number that is not finite, or begins at another time than 0");
    row.clear();
    for (const double number : numbers(motions[i])) add_field(number);
    for (const auto& [column, values] : columns) {
      if (!values.empty()) add_field(values[i]);
    }
    out << row << '\n';
  }
}

}  // namespace

void write_points(std::ostream& out, std::span<const Linear_motion_2> motions,
                  std::span<const double> radii, std::span<const double> growths,
                  std::span<const double> masses) {
  write_all_points(out, motions, {{radius, radii}, {growth, growths}, {mass, masses}});
}

void write_points(std::ostream& out, std::span<const Polynomial_motion_2> motions,
                  std::span<const double> radii, std::span<const double> growths,
                  std::span<const double> masses) {
  write_all_points(out, motions, {{radius, radii}, {growth, growths}, {mass, masses}});
}

}  // namespace kinetri
