// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_TEST_SUPPORT_RANDOM_CHOICES_H
#define KINETRI_TEST_SUPPORT_RANDOM_CHOICES_H

#include <random>

namespace kinetri::test {

/// The choices of a random run, from a seed; Fuzz_input reads them from bytes.
class Random_choices {
 public:
  explicit Random_choices(unsigned seed) : random_(seed) {}
  int integer(int lowest, int highest) {
    return std::uniform_int_distribution<int>(lowest, highest)(random_);
  }

 private:
  std::mt19937 random_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_RANDOM_CHOICES_H
