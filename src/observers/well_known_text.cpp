// SPDX-License-Identifier: GPL-3.0-or-later
#include "observers/well_known_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/from_chars.h"
#include "kinetri/base/error.h"

namespace kinetri::detail {
namespace {

constexpr std::string_view blanks = " \t\r\n\f\v";
constexpr std::string_view ends_of_words = " \t\r\n\f\v(),";

class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  std::vector<Rings_of_polygon> read() {
    read_geometry();
    skip_blanks();
    if (at_ != text_.size()) fail("the text goes on after its end", "nothing more");
    if (polygons_.empty()) fail("there is no polygon", "one or more");
    return std::move(polygons_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& expected) const {
    const std::string_view before = text_.substr(0, at_);
    const auto line = static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1;
    const std::size_t column = at_ - (before.rfind('\n') + 1) + 1;
    throw Input_error(name_, line,
                      "column " + std::to_string(column) + ": " + what + "; expected " + expected);
  }

  void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }

  // The next text, for messages.
  std::string here() {
    skip_blanks();
    if (at_ == text_.size()) return "the text ends here";
    const std::size_t end = std::max(text_.find_first_of(ends_of_words, at_), at_ + 1);
    constexpr std::size_t longest = 30;
    std::string result = "'";
    result += text_.substr(at_, std::min(end - at_, longest));
    result += "' stands here";
    return result;
  }

  bool is_next(char sign) {
    skip_blanks();
    if (at_ == text_.size() || text_[at_] != sign) return false;
    ++at_;
    return true;
  }

  // Whether there is an entry, or a further one, of a list in parentheses.
  bool begins_list() {
    if (is_next('(')) return true;
    const std::size_t start = at_;
    if (word() == "EMPTY") return false;
    at_ = start;
    fail(here(), "( or EMPTY");
  }
  bool goes_on() {
    if (is_next(',')) return true;
    if (is_next(')')) return false;
    fail(here(), ", or )");
  }

  std::string word() {
    skip_blanks();
    std::string result;
    while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_])) != 0) {
      result += static_cast<char>(std::toupper(static_cast<unsigned char>(text_[at_++])));
    }
    return result;
  }

  // The depth of nested collections is limited because of the stack.
  void read_geometry(std::size_t depth = 0) {
    constexpr std::size_t greatest_depth = 100;
    skip_blanks();
    const std::size_t start = at_;
    const std::string kind = word();
    if (kind == "POLYGON") {
      read_polygon();
    } else if (kind == "MULTIPOLYGON") {
      if (!begins_list()) return;
      do read_polygon();
      while (goes_on());
    } else if (kind == "GEOMETRYCOLLECTION" && depth < greatest_depth) {
      if (!begins_list()) return;
      do read_geometry(depth + 1);
      while (goes_on());
    } else {
      at_ = start;
      fail(here(), depth == greatest_depth
                       ? "POLYGON or MULTIPOLYGON, since collections are nested 100 deep here"
                       : "POLYGON, MULTIPOLYGON, or GEOMETRYCOLLECTION of these");
    }
  }

  void read_polygon() {
    if (!begins_list()) return;
    polygons_.emplace_back();
    do read_ring();
    while (goes_on());
  }

  void read_ring() {
    if (!is_next('(')) fail(here(), "( and the positions of a ring");
    skip_blanks();
    const std::size_t start = at_;
    Ring ring;
    std::size_t positions = 0;
    do {
      const double x = coordinate();
      const double y = coordinate();
      ++positions;
      if (ring.empty() || ring.back() != Vector_2{x, y}) ring.push_back({x, y});
    } while (goes_on());
    const std::size_t end = at_;
    at_ = start;
    if (positions < 2 || ring.front() != ring.back()) {
      fail("a ring ends elsewhere than it begins", "the first position again at its end");
    }
    if (ring.size() > 1) ring.pop_back();
    if (ring.size() < 3) {
      fail("a ring has " + std::to_string(ring.size()) + " different positions", "three or more");
    }
    at_ = end;
    polygons_.back().push_back(std::move(ring));
  }

  double coordinate() {
    constexpr double largest = 1e150;
    skip_blanks();
    const std::size_t start = at_ + (at_ < text_.size() && text_[at_] == '+' ? 1 : 0);
    double result = 0;
    const auto [end, error] = from_chars(text_.data() + start, text_.data() + text_.size(), result);
    if (error != std::errc() || !(std::abs(result) <= largest)) {
      fail(here(), "a finite coordinate of at most 1e150");
    }
    at_ = static_cast<std::size_t>(end - text_.data());
    if (at_ < text_.size() && ends_of_words.find(text_[at_]) == std::string_view::npos) {
      fail(here(), "a blank, a comma or ) after a number");
    }
    return result + 0.0;
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::vector<Rings_of_polygon> polygons_;
};

}  // namespace

std::vector<Rings_of_polygon> read_well_known_text(std::string_view text, const std::string& name) {
  return Reader(text, name).read();
}

}  // namespace kinetri::detail
