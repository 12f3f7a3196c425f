// SPDX-License-Identifier: GPL-3.0-or-later
//
// The messages of failed outputs.
#ifndef KINETRI_SRC_IO_OUTPUT_FAILURE_H
#define KINETRI_SRC_IO_OUTPUT_FAILURE_H

#include <string>
#include <system_error>

#include "kinetri/impl/io/output_file.h"

namespace kinetri {

/// Throws an Output_error about `path`. `error` is an errno, or 0.
template <class Kind_of_error = Output_error>
[[noreturn]] void fail_output(const std::string& path, const std::string& problem, int error,
                              const std::string& expected) {
  throw Kind_of_error((path == "-" ? "standard output" : path) + ": " + problem +
                      (error == 0 ? "" : ": " + std::generic_category().message(error)) +
                      "; expected " + expected);
}

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_OUTPUT_FAILURE_H
