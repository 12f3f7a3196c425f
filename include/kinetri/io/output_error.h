// SPDX-License-Identifier: GPL-3.0-or-later
//
// The error of files that cannot be written.
#ifndef KINETRI_IO_OUTPUT_ERROR_H
#define KINETRI_IO_OUTPUT_ERROR_H

#include "kinetri/base/error.h"

namespace kinetri {

/// A file cannot be written. `what()` reads `FILE: what is wrong, what was expected`.
class Output_error : public Error {
 public:
  using Error::Error;
};

}  // namespace kinetri

#endif  // KINETRI_IO_OUTPUT_ERROR_H
