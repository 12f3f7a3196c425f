// SPDX-License-Identifier: GPL-3.0-or-later
//
// Searches in text.
#ifndef KINETRI_TEST_SUPPORT_TEXT_H
#define KINETRI_TEST_SUPPORT_TEXT_H

#include <cstddef>
#include <string>

namespace kinetri::test {

/// The number of occurrences of `part`.
inline std::size_t count(const std::string& text, const std::string& part) {
  std::size_t result = 0;
  for (auto i = text.find(part); i != std::string::npos; i = text.find(part, i + 1)) ++result;
  return result;
}

/// The text between `begin` and the next `end`.
inline std::string between(const std::string& text, const std::string& begin,
                           const std::string& end) {
  const auto from = text.find(begin);
  if (from == std::string::npos) return "missing: " + begin;
  const auto start = from + begin.size();
  return text.substr(start, text.find(end, start) - start);
}

}  // namespace kinetri::test

#endif  // KINETRI_TEST_SUPPORT_TEXT_H
