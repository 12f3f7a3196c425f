// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input that cannot be read: wrong paths, and a failing stream.
#ifndef KINETRI_TEST_SUPPORT_WRONG_INPUT_H
#define KINETRI_TEST_SUPPORT_WRONG_INPUT_H

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <utility>

#include "kinetri/base/error.h"
#include "support/message_of.h"
#include "support/temporary_directory.h"

namespace kinetri::test {

/// Expects that errors name the path. `read` takes a path; messages call the input `content`.
template <class Read>
void expect_bad_paths_are_named(const std::string& content, Read read) {
  const Temporary_directory directory;
  const auto message = [&read](const std::string& path) {
    return message_of<Input_error>([&] { read(path); });
  };
  EXPECT_EQ(message(directory.path()),
            directory.path().string() + ": is a directory; expected a file of " + content);
  EXPECT_EQ(message(directory.file("missing")),
            directory.file("missing") +
                ": cannot be opened: No such file or directory; expected a readable file of " +
                content);
  EXPECT_NE(message(""), "");
  if (::geteuid() == 0) return;  // who may read everything
  write_file(directory.file("secret"), "");
  std::filesystem::permissions(directory.file("secret"), std::filesystem::perms::none);
  EXPECT_NE(message(directory.file("secret")).find("Permission denied"), std::string::npos);
}

/// Supplies the text, and then throws.
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
