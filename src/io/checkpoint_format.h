// SPDX-License-Identifier: GPL-3.0-or-later
//
// The frame of a checkpoint file around the state: the first line, with format and version, and the
// last line, with a checksum of all before it.
#ifndef KINETRI_SRC_IO_CHECKPOINT_FORMAT_H
#define KINETRI_SRC_IO_CHECKPOINT_FORMAT_H

#include <iosfwd>
#include <string>
#include <string_view>

namespace kinetri {

/// The whole file. Precondition: `state` ends in a line end.
std::string checkpoint_text(std::string_view state);

/// Reads the state between the first and last line. Throws Input_error `file_name: ...` if one of
/// these is invalid, a line has more than 2^24 bytes, or reading fails. Other files are refused
/// after their first line, or 64 bytes of it.
std::string read_checkpoint_state(std::istream& in, const std::string& file_name);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_CHECKPOINT_FORMAT_H
