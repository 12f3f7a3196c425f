// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text for users: lists, columns, counts, rounded numbers. See also `joined` (impl/io/text.h).
#ifndef KINETRI_APPS_TEXT_H
#define KINETRI_APPS_TEXT_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace kinetri::app {

/// The words with the separator between them.
std::string separated(std::span<const std::string> words, std::string_view separator);

/// @{
/// As printf writes the number with %.*f and %.*g.
std::string fixed(double number, int decimals);
std::string significant(double number, int digits);
/// @}

/// @{
/// The text padded with blanks to at least `width` characters.
std::string right_aligned(std::string text, std::size_t width);
std::string left_aligned(std::string text, std::size_t width);
/// @}

/// "1 point", "2 points": the number with its noun, whose plural has an s.
std::string counted(std::uint64_t number, std::string_view noun);

/// The text with NAME replaced by the name of a program.
std::string with_name(std::string text, std::string_view name);

/// The text as a field of CSV: in quotation marks if it contains a comma, a quotation mark or a
/// line end (RFC 4180).
std::string csv_field(std::string_view text);

/// Writes the text to standard error.
void print_error(std::string_view text);

}  // namespace kinetri::app

#endif  // KINETRI_APPS_TEXT_H
