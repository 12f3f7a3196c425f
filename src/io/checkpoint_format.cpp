// SPDX-License-Identifier: GPL-3.0-or-later
#include "checkpoint_format.h"

#include <algorithm>
#include <boost/crc.hpp>

#include "kinetri/base/error.h"
#include "text.h"
#include "text_table.h"

namespace kinetri {
namespace {

constexpr std::string_view format_name = "kinetri checkpoint ";
constexpr std::string_view version = "2";

std::string checksum_line(std::string_view text) {
  boost::crc_32_type crc;
  crc.process_bytes(text.data(), text.size());
  return joined("checksum ", hexadecimal(crc.checksum(), 8), '\n');
}

}  // namespace

std::string checkpoint_text(std::string_view state) {
  std::string text = joined(format_name, version, '\n', state);
  text += checksum_line(text);
  return text;
}

std::string_view checkpoint_state(std::string_view file, const std::string& file_name) {
  const auto fail = [&](const std::string& problem) { throw Input_error(file_name, 0, problem); };
  if (file.empty()) fail("is empty; expected a checkpoint");
  const std::string_view first = file.substr(0, file.find('\n'));
  if (!first.starts_with(format_name)) {
    fail(joined("is no checkpoint: it begins with ", quoted(first),
                "; expected a file whose first line is '", format_name, version, "'"));
  }
  if (first.substr(format_name.size()) != version) {
    fail(joined("is a checkpoint of version ", quoted(first.substr(format_name.size())),
                "; expected version ", version, ": take the kinetri that wrote it"));
  }
  constexpr std::size_t checksum_size = 18;  // of the last line
  const std::size_t end = file.size() - std::min(file.size() - first.size(), checksum_size);
  const std::string_view last = file.substr(end);
  if (!last.starts_with("checksum ") || !last.ends_with('\n')) {
    fail(
        "is cut short, or has more than it was written with: its last line is no checksum; "
        "expected the whole file as it was written");
  }
  if (last != checksum_line(file.substr(0, end))) {
    fail(
        "is damaged: its checksum is not that of its content; expected the file as it was written");
  }
  return file.substr(first.size(), end - first.size());
}

}  // namespace kinetri
