// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers in the files and on the command lines that people write.
#ifndef KINETRI_IMPL_IO_PARSE_NUMBER_H
#define KINETRI_IMPL_IO_PARSE_NUMBER_H

#include <string_view>

#include "kinetri/base/platform.h"

namespace kinetri {

/// A number read from text, or what is wrong with the text.
struct Parsed_number {
  double value = 0;  ///< 0 if there is a problem
  /// Empty if `value` is the number. Else the second half of a message that begins with the text:
  /// "is not a number; expected ...".
  std::string_view problem;
};

/// The binary64 number nearest to the decimal or hexadecimal floating point number that `text` is:
/// an optional sign, then 12, 1.5, .5e-3, 0x1.8p3, ... Nothing may stand before or after it.
/// Numbers that are too large for binary64, and numbers other than 0 that would become 0, are
/// problems; subnormal ones are not. Does not depend on the locale.
Parsed_number parse_number(std::string_view text);

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_PARSE_NUMBER_H
