// SPDX-License-Identifier: GPL-3.0-or-later
//
// The values of command line options. Options are read as text and checked here, so that numbers
// mean the same on the command line as in files, and every message says what was expected.
#ifndef KINETRI_APPS_ARGUMENTS_H
#define KINETRI_APPS_ARGUMENTS_H

#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace kinetri::app {

/// The command line cannot be used. `what()` reads `OPTION: what is wrong; what was expected`.
class Usage_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A run cannot start or continue because of what the user has asked for. `what()` is the message.
class Run_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The finite number in `text`; see parse_number. Throws Usage_error.
double number_argument(std::string_view option, std::string_view text);

/// As number_argument, greater than 0.
double positive_argument(std::string_view option, std::string_view text);

/// The greatest radius whose double is a binary64 number.
inline constexpr double greatest_radius = std::numeric_limits<double>::max() / 2;

/// As positive_argument, up to greatest_radius.
double radius_argument(std::string_view option, std::string_view text);

/// As number_argument, from `lowest` to `highest`, or 0 if `zero_allowed`.
double size_argument(std::string_view option, std::string_view text, double lowest, double highest,
                     bool zero_allowed);

/// The whole number in `text`, from 0 to `highest`. Throws Usage_error.
std::uint64_t count_argument(std::string_view option, std::string_view text, std::uint64_t highest);

/// The index of `text` in `choices`. Throws Usage_error.
std::size_t choice_argument(std::string_view option, std::string_view text,
                            std::span<const std::string_view> choices);

/// The type of an option with these choices, as in "a|b|c".
std::string choice_type(std::span<const std::string_view> choices);

/// @{
/// "a, b or c".
std::string alternatives(std::span<const std::string_view> choices);
std::string alternatives(const std::vector<std::string>& choices);
/// @}

}  // namespace kinetri::app

#endif  // KINETRI_APPS_ARGUMENTS_H
