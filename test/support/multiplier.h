// SPDX-License-Identifier: GPL-3.0-or-later
//
// How long randomized tests are.
#ifndef KINETRI_TEST_SUPPORT_MULTIPLIER_H
#define KINETRI_TEST_SUPPORT_MULTIPLIER_H

#include <cstdlib>

namespace kinetri::test {

/// How many times the usual number of random cases to run: KINETRI_TEST_MULTIPLIER, or 1.
inline int multiplier() {
  const char* text = std::getenv("KINETRI_TEST_MULTIPLIER");
  const int value = text == nullptr ? 1 : std::atoi(text);
  return value < 1 ? 1 : value;
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_MULTIPLIER_H
