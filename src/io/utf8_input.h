// SPDX-License-Identifier: GPL-3.0-or-later
//
// Input streams: lookahead, and conversion of UTF-16, which spreadsheets and shells of Windows
// write, to UTF-8.
#ifndef KINETRI_SRC_IO_UTF8_INPUT_H
#define KINETRI_SRC_IO_UTF8_INPUT_H

#include <istream>
#include <memory>
#include <streambuf>
#include <string>

namespace kinetri {

/// The beginning of a stream, which was read as lookahead, followed by the rest. `rest` must
/// outlive it.
class Replayed_buffer : public std::streambuf {
 public:
  Replayed_buffer(std::string head, std::istream& rest);

 protected:
  int_type underflow() override;

 private:
  std::string piece_;
  std::istream& rest_;
};

/// A stream that converts UTF-16, with a byte order mark or if its first two characters are ASCII,
/// to UTF-8. Other encodings are not changed. A lone surrogate keeps its code; half a unit at the
/// end becomes U+FFFD.
class Utf8_input {
 public:
  /// Reads a few bytes of `in`, which must outlive it.
  explicit Utf8_input(std::istream& in);

  std::istream& stream() { return *stream_; }

  /// Whether `in` is in UTF-16.
  bool is_converted() const { return is_converted_; }

 private:
  std::unique_ptr<Replayed_buffer> replayed_;
  std::unique_ptr<std::istream> whole_;
  std::unique_ptr<std::streambuf> converted_;
  std::unique_ptr<std::istream> stream_;
  bool is_converted_ = false;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_UTF8_INPUT_H
