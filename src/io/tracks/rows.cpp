// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as CSV with the columns t, id, x, y and radius: strict, so that a misspelled column is an
// error.
#include <algorithm>
#include <array>
#include <utility>

#include "degrees.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "tracks_readers.h"

namespace kinetri {
namespace {

enum Column : std::size_t { t, id, x, y, radius, z, column_count };
constexpr std::size_t required_columns = radius;
constexpr std::array<std::string_view, column_count> columns_of_rows = {"t", "id",     "x",
                                                                        "y", "radius", "z"};
constexpr std::string_view expected_columns =
    "expected a header line with the columns t,id,x,y and optionally radius, in any order";
constexpr std::string_view or_other_table =
    ", or --columns t=NAME,id=NAME,x=NAME,y=NAME for the names in another table, --columns "
    "t=N,id=N,x=N,y=N for the numbers of the columns, from 1 on, of one without a header, or a "
    "file "
    "in one of the formats that --format lists";
constexpr std::string_view quoted_fields = "t=t,id=id,x=x,y=y, which reads quoted fields";

class Rows_reader {
 public:
  explicit Rows_reader(const Tracks_input& input)
      : input_(input),
        table_(input.in, input.name, tracks_kind),
        builder_(input.name, input.options.duplicates) {}

  Tracks_file read() {
    table_.watch_comments([this](std::string_view comment) {
      if (!says_degrees(comment)) return;
      line_of_degrees_ = table_.line();
      if (!columns_.empty()) expect_no_degrees();
    });
    const bool is_automatic = input_.options.format == Tracks_format::automatic;
    columns_ = table_.read_header(
        columns_of_rows, required_columns,
        is_automatic ? joined(expected_columns, or_other_table) : std::string(expected_columns));
    // Checked after the header, since another header needs other options as well.
    if (line_of_degrees_ > 0) expect_no_degrees();
    table_.watch_rows([this](std::string_view line) { return is_row(line); });
    std::size_t rows_of_words = 0;
    auto line = table_.next();
    for (; line && is_of_words(*line); line = table_.next()) ++rows_of_words;
    for (; line; line = table_.next()) add(*line);
    dates_.expect_none(input_.name, input_.options);
    Tracks_file result = builder_.finish();
    signs_.expect_none(result, input_.name, input_.options.projection, "x", "y");
    result.format = Tracks_format::rows;
    result.has_radii = has(radius);
    result.comment_lines = table_.comments();
    result.rows_without_place = rows_without_place_;
    if (rows_of_words > 0) {
      result.remarks.push_back(joined(rows_of_words, rows_of_words == 1 ? " row" : " rows",
                                      " without numbers below the header left out"));
    }
    if (has(z)) result.remarks.emplace_back("the third coordinate, the column z, is left out");
    return result;
  }

 private:
  void expect_no_degrees() const {
    expect_projection(input_.name, line_of_degrees_, input_.options.projection,
                      "the comment says that places are");
  }

  bool has(Column column) const {
    return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
  }

  // Splits into the order of Column. False if the number of fields is wrong.
  bool split(std::string_view line) {
    fields_.fill({});
    std::size_t fields = 0;
    for_each_field_between_commas(line, [&](std::string_view field) {
      if (fields < columns_.size()) fields_[columns_[fields]] = field;
      ++fields;
    });
    return fields == columns_.size();
  }

  // Whether the line below the header has units instead of times and positions.
  bool is_of_words(std::string_view line) {
    if (!split(line) || !is_word(fields_[t]) || !is_word(fields_[x]) || !is_word(fields_[y])) {
      return false;
    }
    return !(fields_[t].empty() && fields_[x].empty() && fields_[y].empty());
  }

  // Whether a line that begins with # is a row, whose id begins with #.
  bool is_row(std::string_view line) {
    if (columns_.front() != id || !split(line)) return false;
    const auto is_number = [&](Column column) {
      return is_missing(fields_[column]) || parse_number(fields_[column]).problem.empty();
    };
    return parse_time(fields_[t], columns_of_rows[t], input_.options).problem.empty() &&
           is_number(x) && is_number(y) && is_number(radius);
  }

  void add(std::string_view line) {
    if (split(line) && is_without_place(fields_[x], fields_[y])) {
      ++rows_without_place_;
      return;
    }
    std::size_t fields = 0;
    for_each_field_between_commas(line, [&](std::string_view /*field*/) { ++fields; });
    // With fewer fields, an invalid number gives the better message.
    if (fields > columns_.size()) {
      table_.fail(line.find('"') == std::string_view::npos
                      ? problem_of_row(fields, columns_.size(), true)
                      : joined("the row has quotation marks, and ", fields, " fields; expected ",
                               columns_.size(), " plain ones, or --columns ", quoted_fields));
    }
    Tracks_row row;
    row.line = table_.line();
    fields = 0;
    for_each_field_between_commas(line, [&](std::string_view field) {
      if (fields < columns_.size()) take(row, field, columns_[fields]);
      ++fields;
    });
    if (fields != columns_.size()) table_.fail(problem_of_row(fields, columns_.size(), true));
    signs_.note(row.place, fields_[x], fields_[y]);
    builder_.add(row);
  }

  void take(Tracks_row& row, std::string_view field, std::size_t column) {
    if (column != id && field.starts_with('"')) {
      table_.fail(joined("the column ", columns_of_rows[column], " is ", in_quotes(field),
                         ", with a quotation mark; expected a plain number, or --columns ",
                         quoted_fields));
    }
    switch (column) {
      case t: {
        Parsed_time time = parse_time(field, columns_of_rows[t], input_.options);
        if (!time.problem.empty()) table_.fail(time.problem);
        dates_.note(field);
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
      case z:
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
  std::array<std::string_view, column_count> fields_;  // of the row
  std::size_t line_of_degrees_ = 0;  // of the comment about degrees; 0 if there is none
  std::size_t rows_without_place_ = 0;
  Signs_of_degrees signs_;
  Dates_of_digits dates_;
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
