// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_TEST_SUPPORT_PRECONDITION_ERROR_H
#define KINETRI_TEST_SUPPORT_PRECONDITION_ERROR_H

#include <gtest/gtest.h>

#include <string>

#include "kinetri/base/error.h"

namespace kinetri::test {

/// The problem that the message of a thrown Precondition_error names, without the condition and its
/// location; "no precondition was broken" if none is thrown.
template <class Function>
std::string precondition_problem(Function function) {
  try {
    function();
  } catch (const Precondition_error& error) {
    const std::string what = error.what();
    const std::string begin = "precondition violated: ";
    const std::size_t end = what.find(" (expected ");
    if (!what.starts_with(begin) || end == std::string::npos || !what.ends_with(')')) return what;
    return what.substr(begin.size(), end - begin.size());
  }
  return "no precondition was broken";
}

}  // namespace kinetri::test

#define EXPECT_PRECONDITION_ERROR(statement, message) \
  EXPECT_EQ(::kinetri::test::precondition_problem([&] { static_cast<void>(statement); }), message)

#endif  // KINETRI_TEST_SUPPORT_PRECONDITION_ERROR_H
