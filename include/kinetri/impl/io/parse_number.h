// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers in files and on command lines.
#ifndef KINETRI_IMPL_IO_PARSE_NUMBER_H
#define KINETRI_IMPL_IO_PARSE_NUMBER_H

#include <string_view>

#include "kinetri/base/platform.h"

namespace kinetri {

/// A number read from text, or the error.
struct Parsed_number {
  double value = 0;  ///< 0 if there is a problem
  /// Empty if `value` is the number. Else the second half of a message that begins with the text:
  /// "is not a number; expected ...".
  std::string_view problem;
};

/// The binary64 number nearest to the decimal or hexadecimal floating point number `text`: an
/// optional sign, then 12, 1.5, .5e-3, 0x1.8p3, ... and nothing else. Numbers that are too large
/// for binary64, and nonzero ones that round to 0, are problems; subnormal ones are not. Does not
/// depend on the locale.
Parsed_number parse_number(std::string_view text);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_PARSE_NUMBER_H
