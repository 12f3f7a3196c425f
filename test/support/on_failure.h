// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_TEST_SUPPORT_ON_FAILURE_H
#define KINETRI_TEST_SUPPORT_ON_FAILURE_H

#include <gtest/gtest.h>

#include <exception>
#include <iostream>
#include <utility>

namespace kinetri::test {

/// Prints what `describe` returns at the end of the scope, if the test has failed within it: for
/// one of very many cases. SCOPED_TRACE takes a text, and writing that of every case takes longer
/// than many a filter.
template <class Describe>
class [[nodiscard]] On_failure {
 public:
  explicit On_failure(Describe describe) : describe_(std::move(describe)) {}
  On_failure(const On_failure&) = delete;
  On_failure& operator=(const On_failure&) = delete;
  ~On_failure() {
    const bool has_failed = !had_failed_ && testing::Test::HasFailure();
    if (has_failed || std::uncaught_exceptions() > exceptions_) {
      std::cout << "The case:\n" << describe_() << std::endl;
    }
  }

 private:
  Describe describe_;
  bool had_failed_ = testing::Test::HasFailure();
  int exceptions_ = std::uncaught_exceptions();
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_ON_FAILURE_H
