// SPDX-License-Identifier: GPL-3.0-or-later
#include "parameter_names.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "kinetri/io/tracks_file.h"

namespace kinetri::python {
namespace {

constexpr std::string_view ends_of_words = " ,;:)";

bool ends_word(std::string_view rest) {
  return rest.empty() || ends_of_words.find(rest.front()) != std::string_view::npos;
}

std::string_view word_of(std::string_view rest) {
  return rest.substr(0, rest.find_first_of(ends_of_words));
}

struct Reading_option {
  std::string_view name;
  std::string_view parameter;
  std::vector<std::string_view> values;  // words
};

const std::vector<Reading_option>& reading_options() {
  static const std::vector<Reading_option> all = [] {
    std::vector<std::string_view> formats;
    for (const Tracks_format_name& format : tracks_formats()) formats.push_back(format.name);
    return std::vector<Reading_option>{
        {"--columns", "columns", {}},
        {"--date-format", "date_format", {}},
        {"--duplicates", "duplicates", {"first", "last", "mean", "refuse"}},
        {"--format", "format", formats},
        {"--fps", "fps", {}},
        {"--projection", "projection", {"none", "local", "utm"}},
        {"--unwrap", "unwrap", {"nearest"}}};
  }();
  return all;
}

class Rewriter {
 public:
  explicit Rewriter(std::string_view message) : rest_(message) {}

  std::string run() {
    bool is_word_begin = true;
    bool is_behind_option = false;
    while (!rest_.empty()) {
      const Reading_option* const option = is_word_begin ? option_here() : nullptr;
      if (option != nullptr) {
        // Parameters are separated by commas.
        if (is_behind_option) result_.insert(result_.size() - 1, ",");
        take_option(*option);
        is_word_begin = false;
        is_behind_option = true;
      } else if (is_word_begin && rest_.front() == '\'') {
        take(size_of_quotation());
        is_word_begin = is_behind_option = false;
      } else {
        is_word_begin = rest_.front() == ' ' || rest_.front() == '(';
        is_behind_option = is_behind_option && rest_.front() == ' ';
        take(1);
      }
    }
    return result_;
  }

 private:
  void take(std::size_t size) {
    result_ += rest_.substr(0, size);
    rest_.remove_prefix(size);
  }

  const Reading_option* option_here() const {
    const auto found = std::find_if(
        reading_options().begin(), reading_options().end(), [&](const Reading_option& option) {
          return rest_.starts_with(option.name) && ends_word(rest_.substr(option.name.size()));
        });
    return found == reading_options().end() ? nullptr : &*found;
  }

  // The length up to a quotation mark at the end of a word; all if there is none.
  std::size_t size_of_quotation() const {
    std::size_t end = 0;
    do {
      end = rest_.find('\'', end + 1);
      if (end == std::string_view::npos) return rest_.size();
    } while (!ends_word(rest_.substr(end + 1)));
    return end + 1;
  }

  void take_option(const Reading_option& option) {
    result_ += option.parameter;
    rest_.remove_prefix(option.name.size());
    if (!rest_.starts_with(' ')) return;
    if (option.name == "--columns") {
      take_columns();
    } else if (option.name == "--date-format") {
      take_date_format();
    } else {
      take_values(option);
    }
  }

  // "first, last or mean".
  void take_values(const Reading_option& option) {
    std::string_view separator = " ";
    bool is_first = true;
    for (;;) {
      const std::string_view value = word_of(rest_.substr(separator.size()));
      if (std::find(option.values.begin(), option.values.end(), value) == option.values.end())
        return;
      result_ += is_first ? "=" : separator;
      ((result_ += '\'') += value) += '\'';
      rest_.remove_prefix(separator.size() + value.size());
      is_first = false;
      if (rest_.starts_with(" or ")) {
        separator = " or ";
      } else if (rest_.starts_with(", ")) {
        separator = ", ";
      } else {
        return;
      }
    }
  }

  // "t=1,id=2": behind the comma there is no blank.
  void take_columns() {
    const auto has_column = [&] {
      const std::string_view word = word_of(rest_.substr(1));
      const std::size_t equals = word.find('=');
      return equals != std::string_view::npos && equals > 0 && equals + 1 < word.size();
    };
    if (!has_column()) return;
    result_ += "={";
    for (bool is_first = true;; is_first = false) {
      const std::string_view word = word_of(rest_.substr(1));
      const std::size_t equals = word.find('=');
      if (!is_first) result_ += ", ";
      ((result_ += '\'') += word.substr(0, equals)) += "': '";
      (result_ += word.substr(equals + 1)) += '\'';
      rest_.remove_prefix(1 + word.size());
      if (!rest_.starts_with(',') || !has_column()) break;
    }
    result_ += '}';
  }

  void take_date_format() {
    if (!rest_.starts_with(" '")) return;
    rest_.remove_prefix(1);
    result_ += '=';
    take(size_of_quotation());
  }

  std::string_view rest_;
  std::string result_;
};

}  // namespace

std::string with_parameters(std::string_view message) {
  return Rewriter(message).run();
}

}  // namespace kinetri::python
