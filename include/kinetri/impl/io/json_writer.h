// SPDX-License-Identifier: GPL-3.0-or-later
//
// A writer of JSON text.
#ifndef KINETRI_IMPL_IO_JSON_WRITER_H
#define KINETRI_IMPL_IO_JSON_WRITER_H

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinetri/base/platform.h"

namespace kinetri {

/// Appends one JSON value to a text, in ASCII. Binary64 numbers have a decimal point or an exponent
/// and read back exactly; null if they are not finite. Invalid UTF-8 in texts is replaced by
/// U+FFFD. Precondition: each list and object is ended; each value in an object follows a key, and
/// no other value does.
class Json_writer {
 public:
  /// With an `indentation`, each element has its own line, indented by so many blanks for each
  /// enclosing list or object. `text` must outlive the writer.
  explicit Json_writer(std::string& text, std::optional<std::size_t> indentation = std::nullopt)
      : text_(text), indentation_(indentation) {}

  void begin_object() { begin('{'); }
  void end_object() { end('}'); }
  void begin_list() { begin('['); }
  void end_list() { end(']'); }
  void key(std::string_view key);

  void null() { value_text("null"); }
  void value(bool value) { value_text(value ? "true" : "false"); }
  void value(double value);
  void value(std::string_view value);
  void value(const char* value) { this->value(std::string_view(value)); }
  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) void value(Integer value) {
    if constexpr (std::signed_integral<Integer>) {
      whole_number(std::int64_t{value});
    } else {
      whole_number(std::uint64_t{value});
    }
  }

  template <class Value>
  void member(std::string_view key, const Value& value) {
    this->key(key);
    this->value(value);
  }

 private:
  void begin(char bracket);
  void end(char bracket);
  void begin_element();
  void begin_line();
  void value_text(std::string_view text);
  void whole_number(std::int64_t value);
  void whole_number(std::uint64_t value);

  std::string& text_;
  std::optional<std::size_t> indentation_;
  std::vector<std::size_t> elements_;  // of each list and object that is not ended
  bool has_key_ = false;               // which waits for its value
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_JSON_WRITER_H
