// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint_format.h"

#include <algorithm>
#include <array>
#include <istream>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/checksum.h"
#include "kinetri/impl/io/input_text.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

constexpr std::string_view format_name = "kinetri checkpoint ";
constexpr std::string_view version = "8";
// Exact times of the program have at most some hundred thousand digits.
constexpr std::size_t longest_line = std::size_t{1} << 24U;

std::string checksum_line(std::string_view text) {
  Checksum checksum;
  checksum.add(text);
  return joined("checksum ", hexadecimal(checksum.crc32(), 8), '\n');
}

void expect_readable(const std::istream& in, const std::string& file_name) {
  if (!in.bad()) return;
  throw Input_error(file_name, 0, "cannot be read to its end; expected a readable file");
}

// The first line with its line end, or its first 64 bytes. Does not wait for more.
std::string first_line(std::istream& in, const std::string& file_name) {
  constexpr std::size_t enough = 64;
  std::string line;
  for (char c = 0; line.size() < enough && c != '\n' && in.get(c);) line += c;
  expect_readable(in, file_name);
  return line;
}

// Appends the rest of the file to its first line.
void read_rest(std::istream& in, const std::string& file_name, std::string& file) {
  std::array<char, 1U << 16U> buffer;
  std::size_t line = 2;
  std::size_t line_size = 0;
  while (in.read(buffer.data(), buffer.size()), in.gcount() > 0) {
    const std::string_view piece(buffer.data(), static_cast<std::size_t>(in.gcount()));
    for (std::size_t begin = 0; begin < piece.size();) {
      const std::size_t end = std::min(piece.find('\n', begin), piece.size());
      line_size += end - begin;
      if (line_size > longest_line) {
        throw Input_error(file_name, line,
                          joined("the line is longer than ", longest_line,
                                 " bytes; expected a checkpoint as it was written"));
      }
      if (end < piece.size()) {
        ++line;
        line_size = 0;
      }
      begin = end + 1;
    }
    file += piece;
  }
  expect_readable(in, file_name);
}

}  // namespace

std::string checkpoint_text(std::string_view state) {
  std::string text = joined(format_name, version, '\n', state);
  text += checksum_line(text);
  return text;
}

std::string read_checkpoint_state(std::istream& in, const std::string& file_name) {
  const auto fail = [&](const std::string& problem) { throw Input_error(file_name, 0, problem); };
  const std::string first = first_line(in, file_name);
  if (first.empty()) fail("is empty; expected a checkpoint");
  const std::string_view without_end(first.data(), std::min(first.find('\n'), first.size()));
  if (!first.starts_with(format_name)) {
    fail(joined("is no checkpoint: it begins with ", in_quotes(without_end),
                "; expected a file whose first line is '", format_name, version, "'"));
  }
  if (without_end.substr(format_name.size()) != version) {
    fail(joined("is a checkpoint of version ", in_quotes(without_end.substr(format_name.size())),
                "; expected version ", version, ": take the kinetri that wrote it"));
  }
  std::string file = first;
  read_rest(in, file_name, file);
  constexpr std::size_t checksum_size = 18;  // of the last line
  const std::size_t end = file.size() - std::min(file.size() - first.size(), checksum_size);
  const std::string_view last = std::string_view(file).substr(end);
  if (!last.starts_with("checksum ") || !last.ends_with('\n')) {
    fail(
        "is cut short, or has more than it was written with: its last line is no checksum; "
        "expected the whole file as it was written");
  }
  if (last != checksum_line(std::string_view(file).substr(0, end))) {
    fail(
        "is damaged: its checksum is not that of its content; expected the file as it was written");
  }
  file.resize(end);
  file.erase(0, first.size());
  return file;
}

}  // namespace kinetri
