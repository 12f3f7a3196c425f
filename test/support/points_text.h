// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files of points that are given as text.
#ifndef KINETRI_TEST_SUPPORT_POINTS_TEXT_H
#define KINETRI_TEST_SUPPORT_POINTS_TEXT_H

#include <sstream>
#include <string>

#include "kinetri/base/error.h"
#include "kinetri/io/points_file.h"
#include "support/message_of.h"

namespace kinetri::test {

inline Points_file points_of(const std::string& text) {
  std::istringstream in(text);
  return read_points(in, "p.csv");
}

/// The message of the error that `text` causes; empty if it is read.
inline std::string points_error(const std::string& text) {
  return message_of<Input_error>([&] { points_of(text); });
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_POINTS_TEXT_H
