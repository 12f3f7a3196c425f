// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_table.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <istream>
#include <system_error>

#include "kinetri/base/error.h"
#include "kinetri/io/points_file.h"

namespace kinetri {
namespace {

constexpr std::size_t longest_line = std::size_t{1} << 20U;
constexpr std::size_t longest_quotation = 40;
// The buffer doubles where a line does not fit, so that a small file does not pay for a long line.
constexpr std::size_t first_buffer = std::size_t{1} << 16U;

}  // namespace

std::ifstream open_table(const std::string& path, const Table_kind& kind) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Input_error(path, 0, fmt::format("is a directory; expected a file of {}", kind.content));
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw Input_error(path, 0,
                      fmt::format("cannot be opened: {}; expected a readable file of {}",
                                  std::generic_category().message(errno), kind.content));
  }
  return in;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

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

Table_reader::Table_reader(std::istream& in, const std::string& name, const Table_kind& kind)
    : in_(in), name_(name), kind_(kind) {
  buffer_.resize(first_buffer);
}

std::optional<std::string_view> Table_reader::next() {
  while (auto line = next_of_any_kind()) {
    if (line_ == 1 && line->starts_with("\xEF\xBB\xBF")) line->remove_prefix(3);
    if (line->starts_with('#') || trimmed(*line).empty()) continue;
    return line;
  }
  return std::nullopt;
}

std::vector<std::size_t> Table_reader::read_header(std::span<const std::string_view> names,
                                                   std::size_t required,
                                                   std::string_view expected) {
  const auto header = next();
  if (!header) throw Input_error(name_, 1, fmt::format("the file is empty; {}", expected));
  std::vector<std::size_t> columns;
  std::vector<bool> seen(names.size(), false);
  for_each_field_between_commas(*header, [&](std::string_view field) {
    const auto found = std::find(names.begin(), names.end(), field);
    if (found == names.end()) {
      fail(fmt::format("unknown column {}; {}", quoted(field), expected));
    }
    const auto column = static_cast<std::size_t>(found - names.begin());
    if (seen[column]) fail(fmt::format("the column {} is named twice; {}", field, expected));
    seen[column] = true;
    columns.push_back(column);
  });
  for (std::size_t column = 0; column < required; ++column) {
    if (!seen[column]) fail(fmt::format("the column {} is missing; {}", names[column], expected));
  }
  return columns;
}

void Table_reader::fail(const std::string& message) const {
  throw Input_error(name_, line_, message);
}

void Table_reader::check_number_of_fields(std::size_t fields, std::size_t columns) const {
  if (fields == columns) return;
  fail(fmt::format("the row has {} field{}; expected {}, one for each column of the header", fields,
                   fields == 1 ? "" : "s", columns));
}

double Table_reader::number(std::string_view field, std::string_view column) const {
  if (field.empty()) fail(fmt::format("the column {} is empty; expected a number", column));
  const Parsed_number parsed = parse_number(field);
  if (!parsed.problem.empty()) {
    fail(fmt::format("the column {} is {}, which {}", column, quoted(field), parsed.problem));
  }
  return parsed.value;
}

// The next line, blank or comment or not, without its line end.
std::optional<std::string_view> Table_reader::next_of_any_kind() {
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

std::string_view Table_reader::without_return(std::string_view line) const {
  if (line.size() > longest_line) fail_too_long();
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

// Reads more behind what is left. False at the end of the stream.
bool Table_reader::fill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
  in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
  if (in_.bad()) {
    fail(fmt::format("reading failed; expected a readable file of {}", kind_.content));
  }
  end_ += static_cast<std::size_t>(in_.gcount());
  return in_.gcount() > 0;
}

void Table_reader::fail_too_long() const {
  fail(fmt::format("the line is longer than {} bytes; expected one {} a line", longest_line,
                   kind_.row));
}

}  // namespace kinetri
