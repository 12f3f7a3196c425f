// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the fuzz targets share. A target is a file with one LLVMFuzzerTestOneInput, which stops the
// program where a property does not hold. With clang's libFuzzer it is a fuzzer (scripts/fuzz.sh);
// with any compiler and standalone.cpp it is a test.
#ifndef KINETRI_TEST_FUZZ_FUZZ_H
#define KINETRI_TEST_FUZZ_FUZZ_H

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace kinetri::test {

/// Stops the program unless `holds`.
inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::cerr << "fuzz target: " << what << std::endl;
  std::abort();
}

/// Reads values from the input; zeros after its end.
class Fuzz_input {
 public:
  Fuzz_input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool at_end() const { return next_ >= size_; }
  std::size_t left() const { return size_ - next_; }

  std::uint8_t byte() { return at_end() ? std::uint8_t{0} : data_[next_++]; }

  /// In [low, high].
  int integer(int low, int high) { return low + byte() % (high - low + 1); }

  /// Any 64 bits.
  std::uint64_t word() {
    std::uint64_t result = 0;
    for (int i = 0; i < 8; ++i) result = result << 8 | byte();
    return result;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t next_ = 0;
};

}  // namespace kinetri::test

#endif  // KINETRI_TEST_FUZZ_FUZZ_H
