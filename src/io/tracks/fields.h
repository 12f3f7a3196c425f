// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of a record of a table: between commas, semicolons, tabs or blanks, quoted or not
// (RFC 4180).
#ifndef KINETRI_SRC_IO_TRACKS_FIELDS_H
#define KINETRI_SRC_IO_TRACKS_FIELDS_H

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_table.h"

namespace kinetri {

/// The fields of a record. They refer to its text, or to texts of this object.
class Fields {
 public:
  std::size_t size() const { return fields_.size(); }
  std::string_view operator[](std::size_t i) const { return fields_[i]; }
  auto begin() const { return fields_.begin(); }
  auto end() const { return fields_.end(); }

  enum class Result { complete, quotation_is_open, text_behind_quotation };

  /// Splits `record`, which is not blank. A blank as separator stands for one or more blanks and
  /// tabs.
  Result split(std::string_view record, char separator) {
    fields_.clear();
    unquoted_.clear();
    const bool is_blank_separated = separator == ' ';
    const auto separates = [&](char c) {
      return is_blank_separated ? is_blank(c) : c == separator;
    };
    // Tabs are blanks, unless they separate fields.
    const auto skip_blanks = [&](std::size_t from) {
      while (from < record.size() && is_blank(record[from]) &&
             (is_blank_separated || record[from] != separator)) {
        ++from;
      }
      return from;
    };
    std::size_t next = skip_blanks(0);
    for (;;) {
      std::size_t end = next;
      if (next < record.size() && record[next] == '"') {
        end = take_quoted(record, next);
        if (end == none) return Result::quotation_is_open;
        const std::size_t behind = skip_blanks(end);
        const bool is_at_end = behind == record.size();
        if (!is_at_end && !(is_blank_separated ? behind > end : separates(record[behind]))) {
          return Result::text_behind_quotation;
        }
        end = behind;
      } else {
        while (end < record.size() && !separates(record[end])) ++end;
        fields_.push_back(trimmed(record.substr(next, end - next)));
        if (is_blank_separated) end = skip_blanks(end);
      }
      if (end == record.size()) return Result::complete;
      next = skip_blanks(is_blank_separated ? end : end + 1);
    }
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  // Reads the field that begins with the quotation mark at `begin`. Returns the position after it.
  std::size_t take_quoted(std::string_view record, std::size_t begin) {
    std::string& text = unquoted_.emplace_back();
    std::size_t from = begin + 1;
    for (;;) {
      const std::size_t mark = record.find('"', from);
      if (mark == std::string_view::npos) return none;
      text += record.substr(from, mark - from);
      from = mark + 1;
      if (from == record.size() || record[from] != '"') break;
      text += '"';
      ++from;
    }
    fields_.push_back(text);
    return from;
  }

  std::vector<std::string_view> fields_;
  std::deque<std::string> unquoted_;  // a deque, so that texts are not moved
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_FIELDS_H
