// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checked access to JSON values, with errors that say what was expected, and where.
#ifndef KINETRI_SRC_IO_JSON_VALUE_H
#define KINETRI_SRC_IO_JSON_VALUE_H

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace kinetri {

/// A JSON value, which must outlive the values that its functions return. Each function throws
/// Input_error if the value does not have the expected type.
class Json_value {
 public:
  /// `file` is the name of the file in messages, `root` that of this value.
  Json_value(const nlohmann::json& json, const std::string& file, const char* root)
      : json_(json), file_(file), key_(root) {}

  [[noreturn]] void fail(std::string_view problem) const;

  bool is_null() const;
  bool is_text() const;

  /// Whether an object has the member `key`.
  bool has_member(const char* key) const;

  /// The member `key` of an object.
  Json_value member(const char* key) const;

  /// The number of elements of a list.
  std::size_t size() const;
  void expect_size(std::size_t expected) const;

  /// Precondition: i < size().
  Json_value element(std::size_t i) const;

  template <class Function>
  void for_each(Function function) const {
    const std::size_t elements = size();
    for (std::size_t i = 0; i < elements; ++i) function(element(i));
  }

  double number() const;

  /// A whole number from 0 to the limit.
  template <class Unsigned>
  Unsigned whole_number(Unsigned limit = std::numeric_limits<Unsigned>::max()) const {
    return static_cast<Unsigned>(whole_number_up_to(limit));
  }

  /// A whole number from `lowest` to `highest`.
  int small_number(int lowest, int highest) const;

  bool truth() const;

  const std::string& text() const;

 private:
  Json_value(const nlohmann::json& json, const Json_value& parent, const char* key,
             std::size_t index)
      : json_(json), file_(parent.file_), parent_(&parent), key_(key), index_(index) {}

  std::uint64_t whole_number_up_to(std::uint64_t limit) const;
  std::string place() const;

  const nlohmann::json& json_;
  const std::string& file_;
  const Json_value* parent_ = nullptr;
  const char* key_ = nullptr;
  std::size_t index_ = 0;
};

/// A parsed JSON text.
class Json_document {
 public:
  explicit Json_document(std::string_view text);
  ~Json_document();

  Json_document(const Json_document&) = delete;
  Json_document& operator=(const Json_document&) = delete;

  /// Whether the text is JSON.
  bool is_valid() const;

  /// Precondition: is_valid(). `file` must outlive the value; see Json_value.
  Json_value value(const std::string& file, const char* root) const {
    return Json_value(*json_, file, root);
  }

 private:
  std::unique_ptr<nlohmann::json> json_;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_JSON_VALUE_H
