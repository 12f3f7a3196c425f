// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/text_table.h"

#include <charconv>
#include <cstring>
#include <istream>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20U;
// The buffer doubles if a line does not fit.
constexpr std::size_t first_buffer = std::size_t{1} << 16U;

}  // namespace

Table_reader::Table_reader(std::istream& in, const std::string& name, const Table_kind& kind)
    : in_(in), name_(name), kind_(kind) {
  buffer_.resize(first_buffer);
}

std::optional<std::string_view> Table_reader::next() {
  while (const auto line = next_line()) {
    if (line->starts_with('#')) {
      if (is_row_ && is_row_(*line)) return line;
      ++comments_;
      if (on_comment_) on_comment_(line->substr(1));
      continue;
    }
    if (trimmed(*line).empty()) continue;
    return line;
  }
  return std::nullopt;
}

std::vector<std::size_t> Table_reader::read_header(std::span<const std::string_view> names,
                                                   std::size_t required,
                                                   std::string_view expected) {
  const auto header = next();
  if (!header) throw Input_error(name_, 1, joined("the file is empty; ", expected));
  std::vector<std::size_t> columns;
  std::vector<bool> seen(names.size(), false);
  for_each_field_between_commas(*header, [&](std::string_view field) {
    const auto found = std::find(names.begin(), names.end(), field);
    if (found == names.end()) {
      fail(joined("unknown column ", in_quotes(field), "; ", expected));
    }
    const auto column = static_cast<std::size_t>(found - names.begin());
    if (seen[column]) fail(joined("the column ", field, " is named twice; ", expected));
    seen[column] = true;
    columns.push_back(column);
  });
  for (std::size_t column = 0; column < required; ++column) {
    if (!seen[column]) fail(joined("the column ", names[column], " is missing; ", expected));
  }
  return columns;
}

Csv_header Table_reader::read_csv_header(std::span<const std::string_view> names,
                                         std::size_t required, std::string_view expected) {
  const auto line = next();
  if (!line) throw Input_error(name_, 1, joined("the file is empty; ", expected));
  separator_ =
      line->find(',') == std::string_view::npos && line->find(';') != std::string_view::npos ? ';'
                                                                                             : ',';
  Csv_header header;
  for_each_csv_field(*line, [&](std::string_view field) {
    const auto found = std::find_if(names.begin(), names.end(), [&](std::string_view known) {
      return in_lower_case(field) == known;
    });
    if (found == names.end()) {
      if (parse_number(field).problem.empty()) {
        fail(joined("unknown column ", in_quotes(field), "; ", expected));
      }
      header.columns.push_back(Csv_header::ignored);
      header.ignored_names.push_back(in_quotes(field));
      return;
    }
    const auto column = static_cast<std::size_t>(found - names.begin());
    if (header.has(column)) fail(joined("the column ", *found, " is named twice; ", expected));
    header.columns.push_back(column);
  });
  for (std::size_t column = 0; column < required; ++column) {
    if (!header.has(column)) {
      fail(joined("the column ", names[column], " is missing; ", expected));
    }
  }
  return header;
}

// Removes the first field from the rest of the line; none after the last one.
std::string_view Table_reader::take_csv_field(std::optional<std::string_view>& rest) {
  std::string_view text = *rest;
  const auto take_up_to = [&](std::size_t position) {
    const bool is_last = position == std::string_view::npos;
    rest = is_last ? std::nullopt : std::optional(text.substr(position + 1));
    return trimmed(text.substr(0, position));
  };
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos || text[begin] != '"')
    return take_up_to(text.find(separator_));

  unquoted_.clear();
  std::size_t from = begin + 1;
  for (;;) {
    const std::size_t mark = text.find('"', from);
    if (mark == std::string_view::npos) {
      fail(joined("a quotation mark is not closed: ", in_quotes(text.substr(begin)),
                  "; expected a second one on the same line"));
    }
    unquoted_ += text.substr(from, mark - from);
    from = mark + 1;
    if (from == text.size() || text[from] != '"') break;
    unquoted_ += '"';  // two stand for one
    ++from;
  }
  text.remove_prefix(from);
  const std::string_view behind = take_up_to(text.find(separator_));
  if (!behind.empty()) {
    fail(joined("something stands behind a quoted field: ", in_quotes(behind), "; expected '",
                separator_, "' or the end of the line"));
  }
  return trimmed(unquoted_);
}

void Table_reader::fail(const std::string& message) const {
  throw Input_error(name_, line_, message);
}

void Table_reader::check_number_of_fields(std::size_t fields, std::size_t columns) const {
  if (fields == columns) return;
  fail(joined("the row has ", fields, fields == 1 ? " field" : " fields", "; expected ", columns,
              ", one for each column of the header"));
}

double Table_reader::number(std::string_view field, std::string_view column) const {
  if (field.empty()) fail(joined("the column ", column, " is empty; expected a number"));
  if (separator_ == ';' && field.find(',') != std::string_view::npos) {
    fail(joined("the column ", column, " is ", in_quotes(field),
                ", with a decimal comma; expected a decimal point, as in 1.5"));
  }
  const Parsed_number parsed = parse_number(field);
  if (!parsed.problem.empty()) {
    fail(joined("the column ", column, " is ", in_quotes(field), ", which ", parsed.problem));
  }
  return parsed.value;
}

std::uint64_t Table_reader::whole_number(std::string_view field, std::string_view column,
                                         std::uint64_t highest) const {
  std::uint64_t result = 0;
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, result);
  if (error == std::errc() && stop == end && result <= highest) return result;
  fail(joined("the column ", column, " is ", in_quotes(field),
              "; expected a whole number from 0 to ", highest));
}

std::optional<std::string_view> Table_reader::next_line() {
  ++line_;
  std::size_t searched = 0;
  for (;;) {
    const std::string_view rest(buffer_.data() + begin_, end_ - begin_);
    const std::size_t newline = rest.find('\n', searched);
    if (newline != std::string_view::npos) {
      begin_ += newline + 1;
      return without_return(rest.substr(0, newline));
    }
    if (rest.size() > longest_line) fail_too_long();
    searched = rest.size();
    if (!fill()) break;
  }
  if (begin_ == end_) return std::nullopt;
  const std::string_view last(buffer_.data() + begin_, end_ - begin_);
  begin_ = end_;
  return without_return(last);
}

// Removes a byte order mark, too.
std::string_view Table_reader::without_return(std::string_view line) const {
  if (line.size() > longest_line) fail_too_long();
  if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

// Appends more bytes to the rest. False at the end of the stream.
bool Table_reader::fill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
  in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
  if (in_.bad()) {
    fail(joined("reading failed; expected a readable file of ", kind_.content));
  }
  end_ += static_cast<std::size_t>(in_.gcount());
  return in_.gcount() > 0;
}

void Table_reader::fail_too_long() const {
  fail(joined("the line is longer than ", longest_line, " bytes; expected one ", kind_.row,
              " a line"));
}

}  // namespace kinetri
