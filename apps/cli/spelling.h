// SPDX-License-Identifier: GPL-3.0-or-later
//
// Suggestions for mistyped names.
#ifndef KINETRI_APPS_SPELLING_H
#define KINETRI_APPS_SPELLING_H

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace kinetri::app {

/// The edit distance: the least number of letters to insert, delete, replace, or exchange with the
/// next one, that makes one word the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name that `word` probably stands for: the only name that begins with `word`, or else the
/// first of those at the least edit distance, if at most a third of its letters are wrong; else
/// empty. Leading dashes do not count.
std::string_view nearest_name(std::string_view word, std::span<const std::string> names);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_SPELLING_H
