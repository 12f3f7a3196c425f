// SPDX-License-Identifier: GPL-3.0-or-later
//
// The common part of readers of text files with one row a line: lines, fields, headers, numbers,
// and errors with their positions.
#ifndef KINETRI_SRC_IO_TEXT_TABLE_H
#define KINETRI_SRC_IO_TEXT_TABLE_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kinetri/impl/io/input_text.h"

namespace kinetri {

/// The content of a file, for messages: "expected a file of points", "expected one point a line".
struct Table_kind {
  std::string_view content;  ///< "points"
  std::string_view row;      ///< "point"
};

inline bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// Calls function(field) for each field between blanks.
template <class Function>
void for_each_field_between_blanks(std::string_view line, Function function) {
  for (;;) {
    const auto begin = std::find_if_not(line.begin(), line.end(), is_blank);
    if (begin == line.end()) return;
    line.remove_prefix(static_cast<std::size_t>(begin - line.begin()));
    const auto end = std::find_if(line.begin(), line.end(), is_blank);
    const auto size = static_cast<std::size_t>(end - line.begin());
    function(line.substr(0, size));
    line.remove_prefix(size);
  }
}

/// The header line of a file that other programs may have written: R, pandas, spreadsheets.
struct Csv_header {
  static constexpr std::size_t ignored = static_cast<std::size_t>(-1);

  std::vector<std::size_t> columns;        ///< of each field, an index into the names, or `ignored`
  std::vector<std::string> ignored_names;  ///< of the columns that are ignored, `quoted`

  bool has(std::size_t column) const {
    return std::find(columns.begin(), columns.end(), column) != columns.end();
  }
};

/// Reads the lines of a stream that are neither blank nor comments, without line ends and byte
/// order mark. `in`, `name` and the texts of `kind` must outlive it.
class Table_reader {
 public:
  Table_reader(std::istream& in, const std::string& name, const Table_kind& kind);

  /// As next(), but includes blank lines and comments.
  std::optional<std::string_view> next_line();

  /// The number of the last line, counted from 1.
  std::size_t line() const { return line_; }

  /// Calls function(comment) for each comment that next() skips from now on, without its #.
  void watch_comments(std::function<void(std::string_view)> function) {
    on_comment_ = std::move(function);
  }

  /// From now on is_row(line) decides which lines that begin with # are rows, such as one whose
  /// first field is the id #1.
  void watch_rows(std::function<bool(std::string_view)> is_row) { is_row_ = std::move(is_row); }

  /// The number of comments that next() has skipped.
  std::size_t comments() const { return comments_; }

  /// The next line; none at the end of the stream. Valid until the next call. Throws Input_error if
  /// the line is too long or the stream fails.
  std::optional<std::string_view> next();

  /// Reads the header line: the column of each field, as an index into `names`. Throws Input_error
  /// if there is none, if one of the first `required` columns is missing, or if a column is unknown
  /// or named twice; the messages end in `expected`.
  std::vector<std::size_t> read_header(std::span<const std::string_view> names,
                                       std::size_t required, std::string_view expected);

  /// Reads the header line of a file whose fields may be quoted and whose columns are separated by
  /// commas or, where the header has none, by semicolons. Names are case-insensitive; columns with
  /// other names are ignored. Throws Input_error if there is no header, if one of the first
  /// `required` columns is missing, if one of `names` occurs twice, or if a name is a number, so
  /// that the line is not a header; the messages end in `expected`.
  Csv_header read_csv_header(std::span<const std::string_view> names, std::size_t required,
                             std::string_view expected);

  /// Calls function(field) for each field of a line of such a file, trimmed and unquoted; there is
  /// at least one. Throws Input_error if a quotation mark is not closed on the line, or text
  /// follows the closing one.
  template <class Function>
  void for_each_csv_field(std::string_view line, Function function) {
    for (std::optional<std::string_view> rest = line; rest;) function(take_csv_field(rest));
  }

  /// Throws an Input_error about the last line.
  [[noreturn]] void fail(const std::string& message) const;

  /// Throws Input_error unless a row has as many fields as the header has columns.
  void check_number_of_fields(std::size_t fields, std::size_t columns) const;

  /// The number in the field. Throws Input_error, with the name of the column, if it is invalid.
  double number(std::string_view field, std::string_view column) const;

  /// The whole number in the field, at most `highest`. Throws as number().
  std::uint64_t whole_number(std::string_view field, std::string_view column,
                             std::uint64_t highest) const;

 private:
  std::string_view take_csv_field(std::optional<std::string_view>& rest);
  std::string_view without_return(std::string_view line) const;
  bool fill();
  [[noreturn]] void fail_too_long() const;

  std::istream& in_;
  const std::string& name_;
  Table_kind kind_;
  std::function<void(std::string_view)> on_comment_;
  std::function<bool(std::string_view)> is_row_;
  std::size_t comments_ = 0;
  char separator_ = ',';
  std::string unquoted_;  // the last field that had quotation marks in it
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t line_ = 0;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TEXT_TABLE_H
