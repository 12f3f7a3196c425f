// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_TEST_SUPPORT_MULTIPLIER_H
#define KINETRI_TEST_SUPPORT_MULTIPLIER_H

#include <cstdlib>

namespace kinetri::test {

inline int at_least_one(const char* environment_variable) {
  const char* text = std::getenv(environment_variable);
  const int value = text == nullptr ? 1 : std::atoi(text);
  return value < 1 ? 1 : value;
}

/// The factor for the number of random cases: KINETRI_TEST_MULTIPLIER, or 1.
inline int multiplier() {
  return at_least_one("KINETRI_TEST_MULTIPLIER");
}

/// `number` random cases, times the multiplier. KINETRI_TEST_DIVISOR divides them, for tests that
/// are run a second time in another way, with a part of the cases.
template <class Integer>
Integer cases(Integer number) {
  return number * static_cast<Integer>(multiplier()) /
         static_cast<Integer>(at_least_one("KINETRI_TEST_DIVISOR"));
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_MULTIPLIER_H
