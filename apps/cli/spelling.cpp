// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/spelling.h"

#include <algorithm>
#include <vector>

namespace kinetri::app {
namespace {

std::string_view without_dashes(std::string_view word) {
  return word.substr(std::min(word.find_first_not_of('-'), word.size()));
}

// The one name that begins with `word`; empty if there is none, or more than one.
std::string_view completion(std::string_view word, std::span<const std::string> names) {
  constexpr std::size_t least_letters = 3;
  if (word.size() < least_letters) return {};
  std::string_view result;
  for (const std::string& name : names) {
    if (!without_dashes(name).starts_with(word)) continue;
    if (!result.empty()) return {};
    result = name;
  }
  return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // rows[i][j]: the distance of the first i letters of a and the first j letters of b.
  std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        rows[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = rows[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      rows[i][j] = std::min({rows[i - 1][j] + 1, rows[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
      }
    }
  }
  return rows.back().back();
}

std::string_view nearest_name(std::string_view word, std::span<const std::string> names) {
  word = without_dashes(word.substr(0, word.find('=')));
  if (const std::string_view found = completion(word, names); !found.empty()) return found;
  std::string_view result;
  std::size_t least = word.size();
  for (const std::string& name : names) {
    const std::string_view letters = without_dashes(name);
    const std::size_t distance = edit_distance(word, letters);
    if (distance < least && 3 * distance <= letters.size()) {
      least = distance;
      result = name;
    }
  }
  return result;
}

}  // namespace kinetri::app
