// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/io/points_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <system_error>

#include "kinetri/base/check.h"
#include "kinetri/base/error.h"
#include "kinetri/base/ids.h"

namespace kinetri {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20U;
constexpr std::size_t longest_quotation = 40;
// The buffer doubles where a line does not fit, so that a small file does not pay for a long line.
constexpr std::size_t first_buffer = std::size_t{1} << 16U;

constexpr std::string_view not_a_number =
    "is not a number; expected a decimal or hexadecimal floating point number such as -1.5, "
    "2e-3 or 0x1.8p3";
constexpr std::string_view not_finite = "is not finite; expected a finite number";
constexpr std::string_view out_of_range =
    "is out of the range of binary64; expected 0, or a magnitude from 4.9e-324 to 1.8e308";

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// The text as it is shown in a message: on one line, printable, and not too long.
std::string quoted(std::string_view text) {
  std::size_t length = std::min(text.size(), longest_quotation);
  const auto splits_character = [text](std::size_t i) {  // UTF-8
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80;
  };
  while (length > 0 && splits_character(length)) --length;
  std::string result = "'";
  for (const char c : text.substr(0, length)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  return result + (length < text.size() ? "...'" : "'");
}

// Gives the lines of a stream one after the other, from one buffer.
class Line_reader {
 public:
  Line_reader(std::istream& in, const std::string& name) : in_(in), name_(name) {
    buffer_.resize(first_buffer);
  }

  // The number of the last line, counted from 1.
  std::size_t line() const { return line_; }

  // The next line without its line end; none at the end of the stream. Valid until the next call.
  std::optional<std::string_view> next() {
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

 private:
  std::string_view without_return(std::string_view line) const {
    if (line.size() > longest_line) fail_too_long();
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  // Reads more behind what is left. False at the end of the stream.
  bool fill() {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
    if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
    in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
    if (in_.bad()) {
      throw Input_error(name_, line_, "reading failed; expected a readable file of points");
    }
    end_ += static_cast<std::size_t>(in_.gcount());
    return in_.gcount() > 0;
  }

  [[noreturn]] void fail_too_long() const {
    throw Input_error(
        name_, line_,
        fmt::format("the line is longer than {} bytes; expected one point a line", longest_line));
  }

  std::istream& in_;
  const std::string& name_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t line_ = 0;
};

enum Column : std::size_t { x, y, vx, vy, radius, column_count };
constexpr std::array<std::string_view, column_count> column_names = {"x", "y", "vx", "vy",
                                                                     "radius"};
constexpr std::string_view expected_columns =
    "expected a header line with the columns x,y,vx,vy and optionally radius, in any order";

class Points_reader {
 public:
  Points_reader(std::istream& in, const std::string& name) : lines_(in, name), name_(name) {}

  Points_file read() {
    read_header();
    while (const auto line = next_line()) read_row(*line);
    reject_equal_points();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Input_error(name_, lines_.line(), message);
  }

  // The next line that is neither blank nor a comment.
  std::optional<std::string_view> next_line() {
    while (auto line = lines_.next()) {
      if (lines_.line() == 1 && line->starts_with("\xEF\xBB\xBF")) line->remove_prefix(3);
      if (line->starts_with('#') || trimmed(*line).empty()) continue;
      return line;
    }
    return std::nullopt;
  }

  void read_header() {
    const auto header = next_line();
    if (!header) {
      throw Input_error(name_, 1, fmt::format("the file is empty; {}", expected_columns));
    }
    std::array<bool, column_count> seen = {};
    for_each_field(*header, [&](std::string_view field) {
      const auto* const found = std::find(column_names.begin(), column_names.end(), field);
      const auto column = static_cast<std::size_t>(found - column_names.begin());
      if (column == column_count) {
        fail(fmt::format("unknown column {}; {}", quoted(field), expected_columns));
      }
      if (seen[column]) {
        fail(fmt::format("the column {} is named twice; {}", field, expected_columns));
      }
      seen[column] = true;
      columns_.push_back(column);
    });
    for (const Column column : {x, y, vx, vy}) {
      if (!seen[column]) {
        fail(fmt::format("the column {} is missing; {}", column_names[column], expected_columns));
      }
    }
    has_radius_ = seen[radius];
  }

  void read_row(std::string_view line) {
    if (result_.motions.size() == no_point - 1) {
      fail(fmt::format("there are too many points; expected at most {}", no_point - 1));
    }
    std::array<double, column_count> values = {};
    std::size_t fields = 0;
    for_each_field(line, [&](std::string_view field) {
      if (fields < columns_.size()) values[columns_[fields]] = number(field, columns_[fields]);
      ++fields;
    });
    if (fields != columns_.size()) {
      fail(fmt::format("the row has {} field{}; expected {}, one for each column of the header",
                       fields, fields == 1 ? "" : "s", columns_.size()));
    }
    result_.motions.push_back({{values[x], values[y]}, {values[vx], values[vy]}, 0});
    result_.lines.push_back(lines_.line());
    if (has_radius_) {
      if (values[radius] < 0) {
        fail(fmt::format("the radius {} is negative; expected at least 0", values[radius]));
      }
      result_.radii.push_back(values[radius]);
    }
  }

  double number(std::string_view field, std::size_t column) const {
    if (field.empty()) {
      fail(fmt::format("the column {} is empty; expected a number", column_names[column]));
    }
    const Parsed_number parsed = parse_number(field);
    if (!parsed.problem.empty()) {
      fail(fmt::format("the column {} is {}, which {}", column_names[column], quoted(field),
                       parsed.problem));
    }
    return parsed.value;
  }

  template <class Function>
  static void for_each_field(std::string_view line, Function function) {
    for (;;) {
      const std::size_t comma = line.find(',');
      function(trimmed(line.substr(0, comma)));
      if (comma == std::string_view::npos) return;
      line.remove_prefix(comma + 1);
    }
  }

  // Sorts ids by x, kept beside them, and by the other numbers where x does not decide. Not by a
  // hash: no input makes this quadratic.
  void reject_equal_points() const {
    struct Entry {
      double x;
      Point_id id;
    };
    const std::vector<Linear_motion_2>& motions = result_.motions;
    std::vector<Entry> entries(motions.size());
    for (std::size_t id = 0; id < motions.size(); ++id) {
      entries[id] = {motions[id].position.x, static_cast<Point_id>(id)};
    }
    const auto others = [&motions](const Entry& entry) {
      const Linear_motion_2& m = motions[entry.id];
      return std::array{m.position.y, m.velocity.x, m.velocity.y};
    };
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
        fmt::format("the point has the same place and velocity as the one in line {}; expected "
                    "points that differ in one of them: remove one or change its motion",
                    result_.lines[(*first)[0]]));
  }

  Line_reader lines_;
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
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Input_error(path, 0, "is a directory; expected a file of points");
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw Input_error(path, 0,
                      fmt::format("cannot be opened: {}; expected a readable file of points",
                                  std::generic_category().message(errno)));
  }
  return read_points(in, path);
}

void write_points(std::ostream& out, std::span<const Linear_motion_2> motions,
                  std::span<const double> radii) {
  KINETRI_PRECONDITION(radii.empty() || radii.size() == motions.size(),
                       "there is one radius for each point, or none");
  out << (radii.empty() ? "x,y,vx,vy\n" : "x,y,vx,vy,radius\n");
  fmt::memory_buffer row;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Linear_motion_2& m = motions[i];
    KINETRI_PRECONDITION(is_finite(m) && m.epoch == 0,
                         "a file of points holds finite numbers at time 0");
    row.clear();
    fmt::format_to(std::back_inserter(row), "{},{},{},{}", m.position.x, m.position.y, m.velocity.x,
                   m.velocity.y);
    if (!radii.empty()) fmt::format_to(std::back_inserter(row), ",{}", radii[i]);
    row.push_back('\n');
    out.write(row.data(), static_cast<std::streamsize>(row.size()));
  }
}

}  // namespace kinetri
