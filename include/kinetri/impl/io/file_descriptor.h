// SPDX-License-Identifier: GPL-3.0-or-later
//
// A file descriptor with one owner, which closes it.
#ifndef KINETRI_IMPL_IO_FILE_DESCRIPTOR_H
#define KINETRI_IMPL_IO_FILE_DESCRIPTOR_H

#include <unistd.h>

#include <utility>

#include "kinetri/base/platform.h"

namespace kinetri {

class File_descriptor {
 public:
  File_descriptor() = default;
  /// Owns the open descriptor, or nothing if it is negative.
  explicit File_descriptor(int number) : number_(number) {}
  ~File_descriptor() { reset(); }

  File_descriptor(File_descriptor&& other) noexcept : number_(other.release()) {}
  File_descriptor& operator=(File_descriptor&& other) noexcept {
    if (this != &other) {
      reset();
      number_ = other.release();
    }
    return *this;
  }

  explicit operator bool() const { return number_ >= 0; }
  int number() const { return number_; }

  /// Closes it.
  void reset() {
    if (number_ >= 0) ::close(release());
  }

  /// Gives up the ownership, and returns the descriptor.
  int release() { return std::exchange(number_, -1); }

 private:
  int number_ = -1;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_FILE_DESCRIPTOR_H
