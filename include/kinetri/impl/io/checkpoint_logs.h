// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files that belong to a checkpoint: their records, and whether they match these.
#ifndef KINETRI_IMPL_IO_CHECKPOINT_LOGS_H
#define KINETRI_IMPL_IO_CHECKPOINT_LOGS_H

#include <filesystem>
#include <string>

#include "kinetri/base/platform.h"

namespace kinetri {

struct Checkpoint_log;
class Output_file;

/// The record of a complete file with the content `output`. `checkpoint` is the identity of the
/// checkpoint's file (Output_file::identity). Precondition: the file has a checksum.
Checkpoint_log log_of(const std::string& output, const Output_file& file,
                      const std::string& checkpoint);

/// The path of the file, for a checkpoint that was read from `checkpoint`, a path or "-".
std::filesystem::path path_of(const Checkpoint_log& log, const std::string& checkpoint);

/// Whether the file exists. Throws Input_error if it does not match its record. Cost: reads it.
bool expect_log(const Checkpoint_log& log, const std::string& checkpoint);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_CHECKPOINT_LOGS_H
