// SPDX-License-Identifier: GPL-3.0-or-later
// Only this source and tracks/geojson.cpp include the whole of nlohmann-json, which takes seconds
// to compile.
#include <nlohmann/json.hpp>

#include "json_value.h"
#include "kinetri/base/error.h"
#include "kinetri/impl/io/json_writer.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {
namespace {

std::string in_ascii(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', /*ensure_ascii=*/true,
                                   nlohmann::json::error_handler_t::replace);
}

}  // namespace

// ---- writing ----

void Json_writer::key(std::string_view key) {
  begin_element();
  text_ += in_ascii(key);
  text_ += indentation_ ? ": " : ":";
  has_key_ = true;
}

void Json_writer::value(double value) {
  value_text(nlohmann::json(value).dump());
}

void Json_writer::value(std::string_view value) {
  value_text(in_ascii(value));
}

void Json_writer::begin(char bracket) {
  begin_element();
  text_ += bracket;
  elements_.push_back(0);
}

void Json_writer::end(char bracket) {
  const bool is_empty = elements_.back() == 0;
  elements_.pop_back();
  if (!is_empty) begin_line();
  text_ += bracket;
}

// Writes the separator before an element, unless it has a key.
void Json_writer::begin_element() {
  if (has_key_ || elements_.empty()) {
    has_key_ = false;
    return;
  }
  if (elements_.back()++ > 0) text_ += ',';
  begin_line();
}

void Json_writer::begin_line() {
  if (!indentation_) return;
  text_ += '\n';
  text_.append(*indentation_ * elements_.size(), ' ');
}

void Json_writer::value_text(std::string_view text) {
  begin_element();
  text_ += text;
}

void Json_writer::whole_number(std::int64_t value) {
  begin_element();
  append(text_, value);
}

void Json_writer::whole_number(std::uint64_t value) {
  begin_element();
  append(text_, value);
}

// ---- reading ----

void Json_value::fail(std::string_view problem) const {
  throw Input_error(file_, 0, joined(place(), ' ', problem));
}

bool Json_value::is_null() const {
  return json_.is_null();
}

bool Json_value::is_text() const {
  return json_.is_string();
}

bool Json_value::has_member(const char* key) const {
  if (!json_.is_object()) fail("is no object; expected one in braces");
  return json_.contains(key);
}

Json_value Json_value::member(const char* key) const {
  if (!json_.is_object()) fail("is no object; expected one in braces");
  const auto found = json_.find(key);
  if (found == json_.end()) fail(joined("has no member \"", key, "\"; expected one"));
  return Json_value(*found, *this, key, 0);
}

std::size_t Json_value::size() const {
  if (!json_.is_array()) fail("is no list; expected one in brackets");
  return json_.size();
}

void Json_value::expect_size(std::size_t expected) const {
  if (size() != expected) fail(joined("has ", size(), " elements; expected ", expected));
}

Json_value Json_value::element(std::size_t i) const {
  return Json_value(json_[i], *this, nullptr, i);
}

double Json_value::number() const {
  if (!json_.is_number_float()) fail("is no number; expected one with a decimal point");
  return json_.get<double>();
}

int Json_value::small_number(int lowest, int highest) const {
  const bool is_whole = json_.is_number_integer();
  if (!is_whole || json_ < lowest || json_ > highest) {
    fail(joined("is no whole number from ", lowest, " to ", highest, "; expected one"));
  }
  return json_.get<int>();
}

bool Json_value::truth() const {
  if (!json_.is_boolean()) fail("is neither true nor false; expected one of the two");
  return json_.get<bool>();
}

const std::string& Json_value::text() const {
  if (!json_.is_string()) fail("is no text; expected one in quotes");
  return json_.get_ref<const std::string&>();
}

std::uint64_t Json_value::whole_number_up_to(std::uint64_t limit) const {
  if (!json_.is_number_unsigned() || json_.get<std::uint64_t>() > limit) {
    fail(joined("is no whole number from 0 to ", limit, "; expected one"));
  }
  return json_.get<std::uint64_t>();
}

// For example state.points[3].
std::string Json_value::place() const {
  if (parent_ == nullptr) return key_;
  return key_ != nullptr ? joined(parent_->place(), '.', key_)
                         : joined(parent_->place(), '[', index_, ']');
}

Json_document::Json_document(std::string_view text)
    : json_(std::make_unique<nlohmann::json>(
          nlohmann::json::parse(text.begin(), text.end(), nullptr, /*allow_exceptions=*/false))) {}

Json_document::~Json_document() = default;

bool Json_document::is_valid() const {
  return !json_->is_discarded();
}

}  // namespace kinetri
