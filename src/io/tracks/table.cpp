// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tracks as a table with a header whose columns the user names. Fields are separated by commas,
// semicolons, tabs or blanks, by the first of them for which the header has all of the names.
// Fields in quotation marks may have separators and line ends in them; two of the marks stand for
// one (RFC 4180).
#include <algorithm>
#include <array>
#include <deque>
#include <optional>

#include "io/text.h"
#include "kinetri/base/error.h"
#include "kinetri/io/points_file.h"
#include "tracks_readers.h"

namespace kinetri {
namespace {

enum Column : std::size_t { t, id, x, y, radius, column_count };
constexpr std::array<std::string_view, column_count> option_names = {"t", "id", "x", "y", "radius"};
constexpr std::size_t required_columns = radius;
constexpr std::string_view expected_option = "expected --columns t=NAME,id=NAME,x=NAME,y=NAME";
constexpr std::size_t longest_record = std::size_t{1} << 20U;
constexpr std::size_t most_lines = 1000;  // of a record, which is split anew for each
constexpr std::size_t none = static_cast<std::size_t>(-1);

// The fields of a record. They refer to its text, or to texts here.
class Fields {
 public:
  std::size_t size() const { return fields_.size(); }
  std::string_view operator[](std::size_t i) const { return fields_[i]; }
  auto begin() const { return fields_.begin(); }
  auto end() const { return fields_.end(); }

  enum class Result { complete, quotation_is_open, text_behind_quotation };

  // Takes the fields of `record`, which is not blank; a blank as separator stands for tabs as well,
  // and for several.
  Result split(std::string_view record, char separator) {
    fields_.clear();
    unquoted_.clear();
    const bool is_blank_separated = separator == ' ';
    const auto separates = [&](char c) {
      return is_blank_separated ? is_blank(c) : c == separator;
    };
    // Tabs are blanks, but not where they separate fields.
    const auto skip_blanks = [&](std::size_t from) {
      while (from < record.size() && is_blank(record[from]) &&
             (is_blank_separated || record[from] != separator)) {
        ++from;
      }
      return from;
    };
    std::size_t next = skip_blanks(0);
    for (;;) {
      std::size_t end = next;
      if (next < record.size() && record[next] == '"') {
        end = take_quoted(record, next);
        if (end == none) return Result::quotation_is_open;
        const std::size_t behind = skip_blanks(end);
        const bool is_at_end = behind == record.size();
        if (!is_at_end && !(is_blank_separated ? behind > end : separates(record[behind]))) {
          return Result::text_behind_quotation;
        }
        end = behind;
      } else {
        while (end < record.size() && !separates(record[end])) ++end;
        fields_.push_back(trimmed(record.substr(next, end - next)));
        if (is_blank_separated) end = skip_blanks(end);
      }
      if (end == record.size()) return Result::complete;
      next = skip_blanks(is_blank_separated ? end : end + 1);
    }
  }

 private:
  // Takes the field that begins with the quotation mark at `begin`; the position behind it.
  std::size_t take_quoted(std::string_view record, std::size_t begin) {
    std::string& text = unquoted_.emplace_back();
    std::size_t from = begin + 1;
    for (;;) {
      const std::size_t mark = record.find('"', from);
      if (mark == std::string_view::npos) return none;
      text += record.substr(from, mark - from);
      from = mark + 1;
      if (from == record.size() || record[from] != '"') break;
      text += '"';
      ++from;
    }
    fields_.push_back(text);
    return from;
  }

  std::vector<std::string_view> fields_;
  std::deque<std::string> unquoted_;  // whose texts stay where they are
};

class Named_columns_reader {
 public:
  explicit Named_columns_reader(const Tracks_input& input)
      : input_(input), table_(input.in, input.name, tracks_kind), builder_(input.name) {
    const Track_columns& columns = input.options.columns;
    names_ = {columns.t, columns.id, columns.x, columns.y, columns.radius};
  }

  Tracks_file read() {
    expect_names();
    expect_no_degrees();
    std::optional<std::string_view> row = read_header();
    for (; row; row = table_.next()) add(*row);
    Tracks_file result = builder_.finish();
    result.format = Tracks_format::table;
    result.has_radii = columns_[radius] != none;
    if (!result.origin.empty() && input_.options.fps) {
      throw Input_error(input_.name, 0, "times are dates, not frames; expected no --fps");
    }
    if (input_.options.fps) result.frame_rate = input_.options.fps;
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

  // Degrees are no places in the plane.
  void expect_no_degrees() const {
    const std::string x_name = in_lower_case(names_[x]);
    const std::string y_name = in_lower_case(names_[y]);
    const auto is_longitude = [](const std::string& name) {
      return name == "lon" || name == "lng" || name == "long" || name == "longitude";
    };
    const auto is_latitude = [](const std::string& name) {
      return name == "lat" || name == "latitude";
    };
    if (is_latitude(x_name) || is_longitude(y_name)) {
      throw Input_error(input_.name, 0,
                        joined("x is the column ", quoted(names_[x]), ", and y ", quoted(names_[y]),
                               "; expected the longitude as x, and the latitude as y"));
    }
    if (is_longitude(x_name) || is_latitude(y_name)) {
      expect_projection(
          input_, 0,
          joined("the columns ", quoted(names_[x]), " and ", quoted(names_[y]), " are places"));
    }
  }

  // The first row, if the header is a comment above it.
  std::optional<std::string_view> read_header() {
    std::string last_comment;
    table_.watch_comments([&](std::string_view comment) { last_comment = comment; });
    const auto line = table_.next();
    table_.watch_comments({});
    if (line) {
      if (take_header(*line)) return table_.next();
      if (take_header(last_comment)) return line;
    }
    if (!line) {
      throw Input_error(input_.name, 1,
                        "the file is empty; expected a header line with the columns that --columns "
                        "names");
    }
    fail_for_header(*line);
  }

  // Whether the line has all names.
  bool take_header(std::string_view line) {
    for (const char separator : {',', ';', '\t', ' '}) {
      if (fields_.split(line, separator) != Fields::Result::complete) continue;
      bool has_all = true;
      for (std::size_t i = 0; i < column_count; ++i) {
        const auto count = std::count(fields_.begin(), fields_.end(), names_[i]);
        columns_[i] = none;
        if (names_[i].empty()) continue;
        if (count > 1) {
          table_.fail(joined("the column ", quoted(names_[i]),
                             " is named twice; expected names that differ"));
        }
        has_all = has_all && count == 1;
        columns_[i] = static_cast<std::size_t>(
            std::find(fields_.begin(), fields_.end(), names_[i]) - fields_.begin());
      }
      if (!has_all) continue;
      separator_ = separator;
      number_of_fields_ = fields_.size();
      return true;
    }
    return false;
  }

  [[noreturn]] void fail_for_header(std::string_view line) {
    char separator = ',';
    std::size_t most = 0;
    for (const char candidate : {',', ';', '\t', ' '}) {
      if (fields_.split(line, candidate) == Fields::Result::complete && fields_.size() > most) {
        most = fields_.size();
        separator = candidate;
      }
    }
    fields_.split(line, separator);
    const auto missing = std::find_if(names_.begin(), names_.end(), [&](const std::string& name) {
      return !name.empty() && std::find(fields_.begin(), fields_.end(), name) == fields_.end();
    });
    std::string there;
    constexpr std::size_t most_shown = 20;
    for (std::size_t i = 0; i < std::min(fields_.size(), most_shown); ++i) {
      append(there, there.empty() ? "" : ", ", quoted(fields_[i]));
    }
    table_.fail(joined("the column ", quoted(missing == names_.end() ? names_[t] : *missing),
                       " is missing; expected one of ", there,
                       fields_.size() > most_shown ? " and others" : ""));
  }

  void add(std::string_view line) {
    const std::size_t first_line = table_.line();
    split(line, first_line);
    if (fields_.size() != number_of_fields_) {
      fail(first_line,
           joined("the row has ", fields_.size(), fields_.size() == 1 ? " field" : " fields",
                  "; expected ", number_of_fields_, ", one for each column of the header"));
    }
    Tracks_row row;
    row.line = first_line;
    row.time = time(first_line);
    row.id = fields_[columns_[id]];
    if (row.id.empty()) {
      fail(first_line, joined("the column ", names_[id], " is empty; expected any text"));
    }
    row.place = {number(x, first_line), number(y, first_line)};
    if (columns_[radius] != none) {
      row.radius = number(radius, first_line);
      if (row.radius < 0) {
        fail(first_line, joined("the radius ", row.radius, " is negative; expected at least 0"));
      }
    }
    builder_.add(row);
  }

  // A record goes on in the next line where a quotation is open.
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
                              separator_ == ' ' ? "a blank" : quoted(std::string(1, separator_)),
                              " or the end of the row"));
    }
  }

  Row_time time(std::size_t line) {
    Parsed_time result = parse_time(fields_[columns_[t]], names_[t]);
    if (result.problem.empty() && input_.options.fps && !result.value.date) {
      result = time_of_frame(result.value.number, *input_.options.fps);
    }
    if (!result.problem.empty()) fail(line, result.problem);
    return result.value;
  }

  double number(std::size_t column, std::size_t line) {
    const std::string_view field = fields_[columns_[column]];
    const std::string& name = names_[column];
    if (field.empty()) fail(line, joined("the column ", name, " is empty; expected a number"));
    const Parsed_number parsed = parse_number(field);
    if (parsed.problem.empty()) return parsed.value;
    if (separator_ != ',' && field.find(',') != std::string_view::npos) {
      fail(line, joined("the column ", name, " is ", quoted(field),
                        ", with a decimal comma; expected a decimal point, as in 1.5"));
    }
    fail(line, joined("the column ", name, " is ", quoted(field), ", which ", parsed.problem));
  }

  [[noreturn]] void fail(std::size_t line, const std::string& message) const {
    throw Input_error(input_.name, line, message);
  }

  const Tracks_input& input_;
  Table_reader table_;
  Tracks_builder builder_;
  std::array<std::string, column_count> names_;
  std::array<std::size_t, column_count> columns_ = {};  // the field of each, or `none`
  std::size_t number_of_fields_ = 0;
  char separator_ = ',';
  Fields fields_;
  std::string record_;  // if it has several lines
};

}  // namespace

Tracks_file read_table(const Tracks_input& input) {
  return Named_columns_reader(input).read();
}

}  // namespace kinetri
