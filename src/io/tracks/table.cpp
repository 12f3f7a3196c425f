// SPDX-License-Identifier: GPL-3.0-or-later
// Tracks as a table whose columns the user names, or numbers if there is no header. The separator
// is the first of comma, semicolon, tab and blank with which all columns exist. Quoted fields may
// contain separators and line ends; two quotation marks stand for one (RFC 4180). Times may be in
// several columns, such as dates and times of day, which are joined by blanks.
#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

#include "column_names.h"
#include "degrees.h"
#include "fields.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"
#include "tracks_readers.h"

namespace kinetri {
namespace {

enum Column : std::size_t { t, id, x, y, radius, column_count };
constexpr std::array<std::string_view, column_count> option_names = {"t", "id", "x", "y", "radius"};
constexpr std::size_t required_columns = radius;
constexpr std::string_view expected_option = "expected --columns t=NAME,id=NAME,x=NAME,y=NAME";
constexpr std::array<char, 4> separators = {',', ';', '\t', ' '};
constexpr std::size_t longest_record = std::size_t{1} << 20U;
constexpr std::size_t most_lines = 1000;  // of a record, which is split again for each
constexpr std::size_t none = static_cast<std::size_t>(-1);

class Named_columns_reader {
 public:
  explicit Named_columns_reader(const Tracks_input& input)
      : input_(input),
        table_(input.in, input.name, tracks_kind),
        builder_(input.name, input.options.duplicates) {
    const Track_columns& columns = input.options.columns;
    names_ = {columns.t, columns.id, columns.x, columns.y, columns.radius};
    names_of_time_ = parts_of(columns.t);
    const auto is_number = [](const std::string& name) { return column_number(name).has_value(); };
    has_numbers_ = std::all_of(names_of_time_.begin(), names_of_time_.end(), is_number) &&
                   std::all_of(names_.begin() + 1, names_.end(), [&](const std::string& name) {
                     return name.empty() || is_number(name);
                   });
  }

  Tracks_file read() {
    expect_names();
    if (!has_numbers_) take_degrees(names_[x], names_[y], "columns", 0);
    std::optional<std::string_view> row = has_numbers_ ? read_numbers() : read_header();
    table_.watch_rows([this](std::string_view line) { return is_row(line); });
    for (; row && is_of_words(*row); row = table_.next()) take_units();
    for (; row; row = table_.next()) add(*row);
    dates_.expect_none(input_.name, input_.options);
    Tracks_file result = builder_.finish();
    if (degrees_remark_.empty()) {
      signs_.expect_none(result, input_.name, input_.options.projection, names_[x], names_[y]);
    }
    result.format = Tracks_format::table;
    result.has_radii = columns_[radius] != none;
    if (!result.origin.empty() && input_.options.fps) {
      throw Input_error(input_.name, 0, "times are dates, not frames; expected no --fps");
    }
    if (input_.options.fps) result.frame_rate = input_.options.fps;
    result.comment_lines = table_.comments() - (is_header_comment_ ? 1 : 0);
    result.rows_without_place = rows_without_place_;
    result.rows_without_id = rows_without_id_;
    add_remarks(result);
    return result;
  }

 private:
  void expect_names() const {
    for (std::size_t i = 0; i < required_columns; ++i) {
      if (!names_[i].empty()) continue;
      throw Input_error(input_.name, 0,
                        joined("the column that is ", option_names[i], " is not named; ",
                               expected_option, " with the names in the header"));
    }
  }

  // ---- degrees ----

  // `what` is the source of `of_x` and `of_y`, in `line`, if that is not 0.
  void take_degrees(const std::string& of_x, const std::string& of_y, std::string_view what,
                    std::size_t line) {
    const Named_degrees named =
        degrees_in_names(input_.name, line, input_.options.projection, what, of_x, of_y);
    if (named.remark.empty()) return;
    are_degrees_ = named.are_degrees;
    degrees_remark_ = named.remark;
  }

  // Used if the names of the columns have no evidence.
  void expect_no_degrees_in_comment(std::size_t line) {
    if (line == 0 || !degrees_remark_.empty()) return;
    expect_projection(input_.name, line, input_.options.projection,
                      "the comment says that places are");
    degrees_remark_ = "places are degrees, as a comment says";
  }

  // ---- the header ----

  // The first row of a table without a header.
  std::optional<std::string_view> read_numbers() {
    std::size_t most = 0;
    for (std::size_t i = 0; i < column_count; ++i) {
      columns_[i] = column_number(names_[i]).value_or(none);
      if (columns_[i] != none) most = std::max(most, columns_[i] + 1);
    }
    for (const std::string& name : names_of_time_) {
      fields_of_time_.push_back(*column_number(name));
      most = std::max(most, fields_of_time_.back() + 1);
    }
    // A first id may begin with #.
    table_.watch_rows([&](std::string_view line) { return begins_numbers(line, most); });
    const auto line = table_.next();
    if (!line) {
      throw Input_error(input_.name, 1,
                        "the file is empty; expected rows with the columns that "
                        "--columns gives by number");
    }
    if (!set_separator(*line, most)) {
      split(*line, table_.line());
      table_.fail(joined("the row has fewer than ", most,
                         " fields; expected as many as the numbers in --columns need, separated by "
                         "commas, semicolons, tabs or blanks"));
    }
    return line;
  }

  bool set_separator(std::string_view line, std::size_t least_fields) {
    for (const char separator : separators) {
      if (fields_.split(line, separator) != Fields::Result::complete) continue;
      if (fields_.size() < least_fields || fields_.size() < 2) continue;
      separator_ = separator;
      number_of_fields_ = fields_.size();
      return true;
    }
    return false;
  }

  bool begins_numbers(std::string_view line, std::size_t least_fields) {
    return set_separator(line, least_fields) && is_row(line);
  }

  // The first row, if the header is a comment above it.
  std::optional<std::string_view> read_header() {
    std::string last_comment;
    std::size_t line_of_degrees = 0;  // of a comment above the last one
    std::size_t last_line = 0;
    table_.watch_comments([&](std::string_view comment) {
      if (says_degrees(last_comment)) line_of_degrees = last_line;
      last_comment = comment;
      last_line = table_.line();
    });
    const auto line = table_.next();
    table_.watch_comments({});
    if (line) {
      if (take_header(*line)) {
        if (says_degrees(last_comment)) line_of_degrees = last_line;
        expect_no_degrees_in_comment(line_of_degrees);
        table_.watch_rows([this](std::string_view row) { return is_row(row); });
        const auto row = table_.next();
        if (row) take_names_of_rows(*row);
        return row;
      }
      is_header_comment_ = true;
      if (take_header(last_comment)) {
        expect_no_degrees_in_comment(line_of_degrees);
        return line;
      }
    }
    if (!line) {
      throw Input_error(input_.name, 1,
                        "the file is empty; expected a header line with the columns that --columns "
                        "names");
    }
    fail_for_header(*line, last_comment);
  }

  // Whether the name is that in the header, perhaps with a leading #.
  bool is_named(std::size_t field, const std::string& name) const {
    if (fields_[field] == name) return true;
    return is_header_comment_ && field == 0 && name.starts_with('#') &&
           trimmed(std::string_view(name).substr(1)) == fields_[0];
  }

  // The field of the header in fields_ with the name; `none` if there is none.
  std::size_t field_named(const std::string& name) const {
    std::size_t result = none;
    for (std::size_t field = 0; field < fields_.size(); ++field) {
      if (!is_named(field, name)) continue;
      if (result != none) {
        table_.fail(
            joined("the column ", in_quotes(name), " is named twice; expected names that differ"));
      }
      result = field;
    }
    return result;
  }

  // Finds the columns in the header in fields_. Returns whether all exist.
  bool find_columns() {
    bool has_all = true;
    for (std::size_t i = 0; i < column_count; ++i) {
      columns_[i] = names_[i].empty() ? none : field_named(names_[i]);
      if (i != t && !names_[i].empty()) has_all = has_all && columns_[i] != none;
    }
    fields_of_time_ = {columns_[t]};
    if (columns_[t] == none) {
      fields_of_time_.clear();
      for (const std::string& name : names_of_time_) fields_of_time_.push_back(field_named(name));
    }
    return has_all &&
           std::find(fields_of_time_.begin(), fields_of_time_.end(), none) == fields_of_time_.end();
  }

  // Reads the line as the header, if it has all names.
  bool take_header(std::string_view line) {
    for (const char separator : separators) {
      if (fields_.split(line, separator) != Fields::Result::complete) continue;
      if (!find_columns()) continue;
      separator_ = separator;
      number_of_fields_ = fields_.size();
      header_.assign(fields_.begin(), fields_.end());
      return true;
    }
    return false;
  }

  // R's write.table writes a first column without a name in the header: quoted names of rows.
  void take_names_of_rows(std::string_view row) {
    if (trimmed(row).front() != '"') return;
    if (fields_.split(row, separator_) != Fields::Result::complete) return;
    if (fields_.size() != number_of_fields_ + 1) return;
    for (std::size_t& column : columns_) column += column == none ? 0 : 1;
    for (std::size_t& field : fields_of_time_) ++field;
    header_.insert(header_.begin(), "");
    ++number_of_fields_;
    has_names_of_rows_ = true;
  }

  // The fields, with the separator that gives the most.
  std::vector<std::string> most_fields(std::string_view line) {
    std::vector<std::string> result;
    for (const char separator : separators) {
      if (fields_.split(line, separator) != Fields::Result::complete) continue;
      if (fields_.size() > result.size()) result.assign(fields_.begin(), fields_.end());
    }
    return result;
  }

  [[noreturn]] void fail_for_header(std::string_view line, const std::string& comment) {
    const std::vector<std::string> first = most_fields(line);
    const std::vector<std::string> of_comment = most_fields(comment);
    // The header may be the comment above the row.
    const bool is_comment = of_comment.size() > 1 && of_comment.size() == first.size();
    const std::vector<std::string>& there = is_comment ? of_comment : first;
    std::vector<std::string> names = names_of_time_;
    std::copy_if(names_.begin() + 1, names_.end(), std::back_inserter(names),
                 [](const std::string& name) { return !name.empty(); });
    const auto missing = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
      return std::find(there.begin(), there.end(), name) == there.end();
    });
    const bool has_header =
        is_comment || std::any_of(first.begin(), first.end(), [](const std::string& field) {
          return is_word(field) && !field.empty();
        });
    std::string expected = list_of(there);
    if (!has_header) {
      append(expected,
             ", or, since these seem to be no names, the numbers of the columns, from 1 on, in "
             "--columns t=N,id=N,x=N,y=N");
    }
    table_.fail(joined("the column ", in_quotes(missing == names.end() ? names_[t] : *missing),
                       " is missing; expected one of ", expected));
  }

  // ---- rows ----

  // Whether the line below the header has words instead of times and positions.
  bool is_of_words(std::string_view line) {
    if (fields_.split(line, separator_) != Fields::Result::complete) return false;
    if (fields_.size() != number_of_fields_) return false;
    std::vector<std::size_t> fields = fields_of_time_;
    fields.insert(fields.end(), {columns_[x], columns_[y]});
    return std::all_of(fields.begin(), fields.end(), [&](auto i) { return is_word(fields_[i]); }) &&
           std::any_of(fields.begin(), fields.end(), [&](auto i) { return !fields_[i].empty(); });
  }

  // Reads the row in fields_, which names units, or repeats columns.
  void take_units() {
    const std::string of_x(fields_[columns_[x]]);
    const std::string of_y(fields_[columns_[y]]);
    if (!are_degrees_) {
      take_degrees(of_x, of_y, has_numbers_ ? "columns" : "units", table_.line());
    }
    if (has_numbers_ && header_.empty()) {
      header_.assign(fields_.begin(), fields_.end());
    } else {
      append(units_, units_.empty() ? "" : "; ", "x ", in_quotes(of_x), ", y ", in_quotes(of_y));
    }
    ++rows_of_words_;
  }

  // Whether a line that begins with # is a row: the # belongs to an id or another text.
  bool is_row(std::string_view line) {
    if (fields_.split(line, separator_) != Fields::Result::complete) return false;
    if (fields_.size() != number_of_fields_) return false;
    const auto is_first = [](std::size_t field) { return field == 0; };
    if (std::any_of(fields_of_time_.begin(), fields_of_time_.end(), is_first)) return false;
    if (columns_[x] == 0 || columns_[y] == 0 || columns_[radius] == 0) return false;
    const auto is_number = [&](Column column) {
      const std::string_view field = fields_[columns_[column]];
      return is_missing(field) || parse_number(field).problem.empty();
    };
    return !empty_field_of_time() &&
           parse_time(time_text(), names_[t], input_.options).problem.empty() && is_number(x) &&
           is_number(y);
  }

  void add(std::string_view line) {
    const std::size_t first_line = table_.line();
    split(line, first_line);
    if (fields_.size() != number_of_fields_) {
      fail(first_line, problem_of_row(fields_.size(), number_of_fields_, !has_numbers_));
    }
    if (is_without_place(fields_[columns_[x]], fields_[columns_[y]])) {
      ++rows_without_place_;
      return;
    }
    if (fields_[columns_[id]].empty()) {
      ++rows_without_id_;
      return;
    }
    Tracks_row row;
    row.line = first_line;
    row.time = time(first_line);
    row.id = fields_[columns_[id]];
    row.place = {number(x, first_line), number(y, first_line)};
    if (are_degrees_ && is_no_place(row.place)) {
      ++rows_without_place_;
      return;
    }
    if (columns_[radius] != none) {
      row.radius = number(radius, first_line);
      if (row.radius < 0) {
        fail(first_line, joined("the radius ", row.radius, " is negative; expected at least 0"));
      }
    }
    signs_.note(row.place, fields_[columns_[x]], fields_[columns_[y]]);
    builder_.add(row);
  }

  // A record continues in the next line if a quotation is open.
  void split(std::string_view line, std::size_t first_line) {
    Fields::Result result = fields_.split(line, separator_);
    if (result == Fields::Result::quotation_is_open) record_ = line;
    while (result == Fields::Result::quotation_is_open) {
      const auto more = table_.next_line();
      if (!more || table_.line() - first_line >= most_lines ||
          record_.size() + more->size() > longest_record) {
        fail(first_line, joined("a quotation mark is not closed; expected a second one in the same "
                                "row, which may have ",
                                most_lines, " lines and ", longest_record, " bytes"));
      }
      append(record_, '\n', *more);
      result = fields_.split(record_, separator_);
    }
    if (result == Fields::Result::text_behind_quotation) {
      fail(first_line, joined("something stands behind a quoted field; expected ",
                              separator_ == ' ' ? "a blank" : in_quotes(std::string(1, separator_)),
                              " or the end of the row"));
    }
  }

  // The index of an empty field among several fields of the time.
  std::optional<std::size_t> empty_field_of_time() const {
    if (fields_of_time_.size() == 1) return std::nullopt;
    for (std::size_t i = 0; i < fields_of_time_.size(); ++i) {
      if (fields_[fields_of_time_[i]].empty()) return i;
    }
    return std::nullopt;
  }

  // The time of the row in fields_; valid until the next call.
  std::string_view time_text() {
    if (fields_of_time_.size() == 1) return fields_[fields_of_time_.front()];
    time_text_.clear();
    for (const std::size_t field : fields_of_time_) {
      append(time_text_, time_text_.empty() ? "" : " ", fields_[field]);
    }
    return time_text_;
  }

  Row_time time(std::size_t line) {
    if (const auto empty = empty_field_of_time()) {
      fail(line,
           joined("the column ", names_of_time_[*empty], " is empty; expected a part of the time"));
    }
    Parsed_time result = parse_time(time_text(), names_[t], input_.options);
    if (!result.problem.empty() && input_.options.date_format.empty()) {
      const std::string of_comma = problem_of_comma(time_text(), separator_);
      if (!of_comma.empty()) {
        fail(line, joined("the column ", names_[t], " is ", in_quotes(time_text()), ", which ",
                          of_comma));
      }
    }
    if (result.problem.empty() && input_.options.fps && !result.value.date) {
      result = time_of_frame(result.value.number, *input_.options.fps);
    }
    if (!result.problem.empty()) fail(line, result.problem);
    dates_.note(time_text());
    return result.value;
  }

  double number(std::size_t column, std::size_t line) {
    const std::string_view field = fields_[columns_[column]];
    const std::string& name = names_[column];
    if (field.empty()) fail(line, joined("the column ", name, " is empty; expected a number"));
    const Parsed_number parsed = parse_number(field);
    if (parsed.problem.empty()) return parsed.value;
    const std::string of_comma = problem_of_comma(field, separator_);
    fail(line, joined("the column ", name, " is ", in_quotes(field), ", which ",
                      of_comma.empty() ? std::string(parsed.problem) : of_comma));
  }

  // ---- the summary ----

  void add_remarks(Tracks_file& file) const {
    if (!degrees_remark_.empty()) file.remarks.push_back(degrees_remark_);
    if (rows_of_words_ > 0) {
      file.remarks.push_back(joined(rows_of_words_, rows_of_words_ == 1 ? " row" : " rows",
                                    " without numbers below or in place of the header left out",
                                    units_.empty() ? "" : ": ", units_));
    }
    Unused_names unused;
    if (has_names_of_rows_) {
      file.remarks.emplace_back("the first column, which the header does not name, is left out");
    }
    std::size_t without_names = 0;
    for (std::size_t field = has_names_of_rows_ ? 1 : 0; field < number_of_fields_; ++field) {
      if (is_used(field)) continue;
      ++without_names;
      if (!header_.empty()) unused.add(header_[field]);
    }
    if (header_.empty()) unused.add_without_names(without_names);
    unused.add_remarks(file);
  }

  bool is_used(std::size_t field) const {
    return std::find(columns_.begin(), columns_.end(), field) != columns_.end() ||
           std::find(fields_of_time_.begin(), fields_of_time_.end(), field) !=
               fields_of_time_.end();
  }

  [[noreturn]] void fail(std::size_t line, const std::string& message) const {
    throw Input_error(input_.name, line, message);
  }

  const Tracks_input& input_;
  Table_reader table_;
  Tracks_builder builder_;
  std::array<std::string, column_count> names_;
  std::vector<std::string> names_of_time_;              // if no column has the name of t itself
  std::array<std::size_t, column_count> columns_ = {};  // the field of each, or `none`
  std::vector<std::size_t> fields_of_time_;             // t, or the several that are the time
  std::string time_text_;                               // of several fields
  std::size_t number_of_fields_ = 0;
  char separator_ = ',';
  bool has_numbers_ = false;         // the user numbers the columns
  bool is_header_comment_ = false;   // the header is a comment
  std::vector<std::string> header_;  // its fields, if there is one
  bool has_names_of_rows_ = false;   // in the first column
  bool are_degrees_ = false;
  std::string degrees_remark_;
  std::string units_;  // of rows below the header
  std::size_t rows_of_words_ = 0;
  std::size_t rows_without_place_ = 0;
  std::size_t rows_without_id_ = 0;
  Signs_of_degrees signs_;
  Dates_of_digits dates_;
  Fields fields_;
  std::string record_;  // if it has several lines
};

}  // namespace

Tracks_file read_table(const Tracks_input& input) {
  return Named_columns_reader(input).read();
}

}  // namespace kinetri
