// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is about the state in a checkpoint file: the first line, which names format and version, and
// the last line, which has a checksum of all before it.
#ifndef KINETRI_SRC_IO_CHECKPOINT_FORMAT_H
#define KINETRI_SRC_IO_CHECKPOINT_FORMAT_H

#include <string>
#include <string_view>

namespace kinetri {

/// The whole file of the state, which ends in a line end.
std::string checkpoint_text(std::string_view state);

/// The state that the file has between its first and last line. Throws Input_error `file_name: ...`
/// if one of these is not right.
std::string_view checkpoint_state(std::string_view file, const std::string& file_name);

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_CHECKPOINT_FORMAT_H
