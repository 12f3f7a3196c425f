// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/io/input_text.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "io/text_table.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

constexpr std::size_t longest_quotation = 40;

}  // namespace

std::ifstream open_input(const std::string& path, std::string_view content) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Input_error(path, 0, joined("is a directory; expected a file of ", content));
  }
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw Input_error(path, 0,
                      joined("cannot be opened: ", std::generic_category().message(errno),
                             "; expected a readable file of ", content));
  }
  return in;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string in_lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

std::string in_quotes(std::string_view text) {
  std::size_t length = std::min(text.size(), longest_quotation);
  const auto splits_character = [text](std::size_t i) {  // UTF-8
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80;
  };
  while (length > 0 && splits_character(length)) --length;
  std::string result = "'";
  for (const char c : text.substr(0, length)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      result += "\\x" + hexadecimal(byte, 2);
    } else {
      result += c;
    }
  }
  return result + (length < text.size() ? "...'" : "'");
}

std::vector<std::string> csv_fields(std::string_view line, const std::string& name) {
  std::istringstream no_lines;
  const Table_kind no_kind;
  Table_reader reader(no_lines, name, no_kind);
  std::vector<std::string> fields;
  reader.for_each_csv_field(line, [&](std::string_view field) { fields.emplace_back(field); });
  return fields;
}

}  // namespace kinetri
