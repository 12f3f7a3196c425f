// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files that belong to a checkpoint: how it notes them, and whether they are as noted.
#ifndef KINETRI_IMPL_IO_CHECKPOINT_LOGS_H
#define KINETRI_IMPL_IO_CHECKPOINT_LOGS_H

#include <filesystem>
#include <string>

#include "kinetri/base/platform.h"

namespace kinetri {

struct Checkpoint_log;
class Output_file;

/// The note of a complete file that `output` has written. `checkpoint` is the identity of the
/// checkpoint's file (Output_file::identity). Precondition: the file has a checksum.
Checkpoint_log log_of(const std::string& output, const Output_file& file,
                      const std::string& checkpoint);

/// Where the file is, for a checkpoint that was read from `checkpoint`, a path or "-".
std::filesystem::path path_of(const Checkpoint_log& log, const std::string& checkpoint);

/// Whether the file is there. Throws Input_error if it is, and is not as noted. Cost: reads it.
bool expect_log(const Checkpoint_log& log, const std::string& checkpoint);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_CHECKPOINT_LOGS_H
