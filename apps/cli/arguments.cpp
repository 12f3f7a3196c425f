// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments.h"

#include <algorithm>
#include <charconv>

#include "cli/text.h"
#include "kinetri/impl/io/parse_number.h"
#include "kinetri/impl/io/text.h"

namespace kinetri::app {

double number_argument(std::string_view option, std::string_view text) {
  const Parsed_number parsed = parse_number(text);
  if (!parsed.problem.empty()) {
    throw Usage_error(joined(option, ": '", text, "' ", parsed.problem));
  }
  return parsed.value;
}

double positive_argument(std::string_view option, std::string_view text) {
  const double value = number_argument(option, text);
  if (value > 0) return value;
  throw Usage_error(
      joined(option, ": ", text, " cannot be used; expected a number greater than 0"));
}

double radius_argument(std::string_view option, std::string_view text) {
  const double value = positive_argument(option, text);
  if (value <= greatest_radius) return value;
  throw Usage_error(joined(option, ": ", text, " is too large; expected at most ", greatest_radius,
                           ", so that the diameter is a binary64 number"));
}

double size_argument(std::string_view option, std::string_view text, double lowest, double highest,
                     bool zero_allowed) {
  const double value = number_argument(option, text);
  if ((value >= lowest && value <= highest) || (value == 0 && zero_allowed)) return value;
  throw Usage_error(joined(option, ": ", text, " is out of range; expected a number from ", lowest,
                           " to ", highest, zero_allowed ? ", or 0" : ""));
}

std::uint64_t count_argument(std::string_view option, std::string_view text,
                             std::uint64_t highest) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value > highest) {
    throw Usage_error(joined(option, ": '", text,
                             "' cannot be used; expected a whole number from 0 to ", highest));
  }
  return value;
}

std::size_t choice_argument(std::string_view option, std::string_view text,
                            std::span<const std::string_view> choices) {
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end()) {
    throw Usage_error(
        joined(option, ": '", text, "' is unknown; expected ", alternatives(choices)));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::string choice_type(std::span<const std::string_view> choices) {
  return separated(std::vector<std::string>(choices.begin(), choices.end()), "|");
}

std::string alternatives(const std::vector<std::string>& choices) {
  return alternatives(std::vector<std::string_view>(choices.begin(), choices.end()));
}

std::string alternatives(std::span<const std::string_view> choices) {
  std::string result;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) result += i + 1 == choices.size() ? " or " : ", ";
    result += choices[i];
  }
  return result;
}

}  // namespace kinetri::app
