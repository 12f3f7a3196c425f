// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef KINETRI_TEST_SUPPORT_MESSAGE_OF_H
#define KINETRI_TEST_SUPPORT_MESSAGE_OF_H

#include <string>

namespace kinetri::test {

/// The message of the `Error` that the function throws; empty if it throws none.
template <class Error, class Function>
std::string message_of(Function function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_MESSAGE_OF_H
