// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_TEST_SUPPORT_MULTIPLIER_H
#define KINETRI_TEST_SUPPORT_MULTIPLIER_H

#include <cstdlib>

namespace kinetri::test {

/// The factor for the number of random cases: KINETRI_TEST_MULTIPLIER, or 1.
inline int multiplier() {
  const char* text = std::getenv("KINETRI_TEST_MULTIPLIER");
  const int value = text == nullptr ? 1 : std::atoi(text);
  return value < 1 ? 1 : value;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_MULTIPLIER_H
