// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text that users give: files, fields, and quotations in messages.
#ifndef KINETRI_IMPL_IO_INPUT_TEXT_H
#define KINETRI_IMPL_IO_INPUT_TEXT_H

#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/base/platform.h"

namespace kinetri {

/// Opens the file `path`. `content` says for messages what it has: "points". Throws Input_error
/// without a line if it is a directory or cannot be opened.
std::ifstream open_input(const std::string& path, std::string_view content);

/// `text` without the blanks around it.
std::string_view trimmed(std::string_view text);

/// The text with A to Z replaced by a to z.
std::string in_lower_case(std::string_view text);

/// The text for a message: in quotes, on one line, printable, and not too long.
std::string in_quotes(std::string_view text);

/// Calls function(field) for each field between commas, trimmed; there is at least one.
template <class Function>
void for_each_field_between_commas(std::string_view line, Function function) {
  for (;;) {
    const std::size_t comma = line.find(',');
    function(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

/// The fields between commas, which may be quoted, trimmed and unquoted; there is at least one.
/// Throws Input_error about `name` if a quotation mark is not closed, or text follows the closing
/// one.
std::vector<std::string> csv_fields(std::string_view line, const std::string& name);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_INPUT_TEXT_H
