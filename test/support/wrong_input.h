// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input that is wrong: the message of its error, and a stream that breaks.
#ifndef KINETRI_TEST_SUPPORT_WRONG_INPUT_H
#define KINETRI_TEST_SUPPORT_WRONG_INPUT_H

#include <stdexcept>
#include <streambuf>
#include <string>
#include <utility>

#include "kinetri/base/error.h"

namespace kinetri::test {

/// The message of the Input_error that `function` throws; empty if it throws none.
template <class Function>
std::string input_problem(Function function) {
  try {
    function();
  } catch (const Input_error& error) {
    return error.what();
  }
  return {};
}

/// Gives the text, and then breaks.
class Breaking_buffer : public std::streambuf {
 public:
  explicit Breaking_buffer(std::string text) : text_(std::move(text)) {}

 protected:
  int_type underflow() override {
    if (!first_) throw std::runtime_error("the disk is gone");
    first_ = false;
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(*gptr());
  }

 private:
  bool first_ = true;
  std::string text_;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_WRONG_INPUT_H
