// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as CSV with the columns t, id, x, y and radius: strict, so that a misspelled column is an
// error.
#include <algorithm>
#include <array>
#include <utility>

#include "io/text.h"
#include "tracks_readers.h"

namespace kinetri {
namespace {

enum Column : std::size_t { t, id, x, y, radius, column_count };
constexpr std::size_t required_columns = radius;
constexpr std::array<std::string_view, column_count> columns_of_rows = {"t", "id", "x", "y",
                                                                        "radius"};
constexpr std::string_view expected_columns =
    "expected a header line with the columns t,id,x,y and optionally radius, in any order";
constexpr std::string_view or_other_table =
    ", or --columns t=NAME,id=NAME,x=NAME,y=NAME for the names in another table, or a file in one "
    "of the formats that --format lists";

class Rows_reader {
 public:
  explicit Rows_reader(const Tracks_input& input)
      : input_(input), table_(input.in, input.name, tracks_kind), builder_(input.name) {}

  Tracks_file read() {
    const bool is_automatic = input_.options.format == Tracks_format::automatic;
    columns_ = table_.read_header(
        columns_of_rows, required_columns,
        is_automatic ? joined(expected_columns, or_other_table) : std::string(expected_columns));
    while (const auto line = table_.next()) add(*line);
    Tracks_file result = builder_.finish();
    result.format = Tracks_format::rows;
    result.has_radii = std::find(columns_.begin(), columns_.end(), radius) != columns_.end();
    return result;
  }

 private:
  void add(std::string_view line) {
    Tracks_row row;
    row.line = table_.line();
    std::size_t fields = 0;
    for_each_field_between_commas(line, [&](std::string_view field) {
      if (fields < columns_.size()) take(row, field, columns_[fields]);
      ++fields;
    });
    table_.check_number_of_fields(fields, columns_.size());
    builder_.add(row);
  }

  void take(Tracks_row& row, std::string_view field, std::size_t column) {
    switch (column) {
      case t: {
        Parsed_time time = parse_time(field, columns_of_rows[t]);
        if (!time.problem.empty()) table_.fail(time.problem);
        row.time = time.value;
        return;
      }
      case id:
        if (field.empty()) table_.fail("the column id is empty; expected any text");
        row.id = field;
        return;
      case x:
        row.place.x = table_.number(field, columns_of_rows[x]);
        return;
      case y:
        row.place.y = table_.number(field, columns_of_rows[y]);
        return;
      default:
        row.radius = table_.number(field, columns_of_rows[radius]);
        if (row.radius < 0) {
          table_.fail(joined("the radius ", row.radius, " is negative; expected at least 0"));
        }
    }
  }

  const Tracks_input& input_;
  Table_reader table_;
  Tracks_builder builder_;
  std::vector<std::size_t> columns_;
};

}  // namespace

bool has_columns_of_rows(std::string_view head) {
  bool result = false;
  for_each_line_of_head(head, [&](std::string_view line) {
    std::array<bool, column_count> seen = {};
    for_each_field_between_commas(line, [&](std::string_view field) {
      const auto found = std::find(columns_of_rows.begin(), columns_of_rows.end(), field);
      if (found != columns_of_rows.end()) {
        seen[static_cast<std::size_t>(found - columns_of_rows.begin())] = true;
      }
    });
    result = seen[t] && seen[id] && seen[x] && seen[y];
    return false;
  });
  return result;
}

Tracks_file read_rows(const Tracks_input& input) {
  return Rows_reader(input).read();
}

}  // namespace kinetri
