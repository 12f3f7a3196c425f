// SPDX-License-Identifier: GPL-3.0-or-later
//
// Streams of text before they are read: what was taken from one to look at it is given again, and
// UTF-16, which spreadsheets and shells of Windows write, becomes UTF-8.
#ifndef KINETRI_SRC_IO_UTF8_INPUT_H
#define KINETRI_SRC_IO_UTF8_INPUT_H

#include <istream>
#include <memory>
#include <streambuf>
#include <string>

namespace kinetri {

/// Gives the beginning of a stream, which was read to look at it, and then the rest. `rest` must
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

/// A stream in UTF-8 of one in UTF-8 or another encoding of bytes, which is not changed, or in
/// UTF-16 with a byte order mark, or without one if its first two characters are ASCII. Half of a
/// pair of surrogates keeps its code; half a unit at the end is U+FFFD.
class Utf8_input {
 public:
  /// Takes a few bytes of `in`, which must outlive it.
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
