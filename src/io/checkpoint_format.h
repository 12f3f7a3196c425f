// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is about the state in a checkpoint file: the first line, which names format and version, and
// the last line, which has a checksum of all before it.
#ifndef KINETRI_SRC_IO_CHECKPOINT_FORMAT_H
#define KINETRI_SRC_IO_CHECKPOINT_FORMAT_H

#include <iosfwd>
#include <string>
#include <string_view>

namespace kinetri {

/// The whole file of the state, which ends in a line end.
std::string checkpoint_text(std::string_view state);

/// Reads the file: the state that it has between its first and last line. Throws Input_error
/// `file_name: ...` if one of these is not right, a line has more than 2^24 bytes, or reading
/// fails. A file that is no checkpoint is refused after its first line, or 64 bytes of it.
std::string read_checkpoint_state(std::istream& in, const std::string& file_name);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_CHECKPOINT_FORMAT_H
