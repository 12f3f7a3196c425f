// SPDX-License-Identifier: GPL-3.0-or-later
//
// A JSON value that is read with suspicion: each access says what it expects, and where in the file
// something else is.
#ifndef KINETRI_SRC_IO_JSON_VALUE_H
#define KINETRI_SRC_IO_JSON_VALUE_H

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "kinetri/base/error.h"

namespace kinetri {

/// The values that its functions give refer to it: it must outlive them. Each function throws
/// Input_error if the value is not what it asks for.
class Json_value {
 public:
  /// `file` names the file in messages.
  Json_value(const nlohmann::json& json, const std::string& file) : json_(json), file_(file) {}

  [[noreturn]] void fail(std::string_view problem) const {
    throw Input_error(file_, 0, fmt::format("{} {}", place(), problem));
  }

  bool is_null() const { return json_.is_null(); }
  bool is_text() const { return json_.is_string(); }

  /// The member `key` of an object.
  Json_value member(const char* key) const {
    if (!json_.is_object()) fail("is no object; expected one in braces");
    const auto found = json_.find(key);
    if (found == json_.end()) fail(fmt::format("has no member \"{}\"; expected one", key));
    return Json_value(*found, *this, key, 0);
  }

  /// The number of elements of a list.
  std::size_t size() const {
    if (!json_.is_array()) fail("is no list; expected one in brackets");
    return json_.size();
  }
  void expect_size(std::size_t expected) const {
    if (size() != expected) fail(fmt::format("has {} elements; expected {}", size(), expected));
  }

  /// Precondition: i < size().
  Json_value element(std::size_t i) const { return Json_value(json_[i], *this, nullptr, i); }

  template <class Function>
  void for_each(Function function) const {
    const std::size_t elements = size();
    for (std::size_t i = 0; i < elements; ++i) function(element(i));
  }

  double number() const {
    if (!json_.is_number_float()) fail("is no number; expected one with a decimal point");
    return json_.get<double>();
  }

  /// A whole number from 0 to that limit.
  template <class Unsigned>
  Unsigned whole_number(Unsigned limit = std::numeric_limits<Unsigned>::max()) const {
    if (!json_.is_number_unsigned() || json_.get<std::uint64_t>() > limit) {
      fail(fmt::format("is no whole number from 0 to {}; expected one", limit));
    }
    return static_cast<Unsigned>(json_.get<std::uint64_t>());
  }

  /// A whole number from `lowest` to `highest`.
  int small_number(int lowest, int highest) const {
    const bool is_whole = json_.is_number_integer();
    if (!is_whole || json_ < lowest || json_ > highest) {
      fail(fmt::format("is no whole number from {} to {}; expected one", lowest, highest));
    }
    return json_.get<int>();
  }

  bool truth() const {
    if (!json_.is_boolean()) fail("is neither true nor false; expected one of the two");
    return json_.get<bool>();
  }

  const std::string& text() const {
    if (!json_.is_string()) fail("is no text; expected one in quotes");
    return json_.get_ref<const std::string&>();
  }

 private:
  Json_value(const nlohmann::json& json, const Json_value& parent, const char* key,
             std::size_t index)
      : json_(json), file_(parent.file_), parent_(&parent), key_(key), index_(index) {}

  // As in state.points[3].
  std::string place() const {
    if (parent_ == nullptr) return "state";
    return key_ != nullptr ? fmt::format("{}.{}", parent_->place(), key_)
                           : fmt::format("{}[{}]", parent_->place(), index_);
  }

  const nlohmann::json& json_;
  const std::string& file_;
  const Json_value* parent_ = nullptr;
  const char* key_ = nullptr;
  std::size_t index_ = 0;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_JSON_VALUE_H
