// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames_of_atoms.h"

#include <charconv>
#include <system_error>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/text.h"

namespace kinetri {

std::optional<std::string_view> Atom_lines::next() {
  const auto line = table_.next_line();
  return line ? std::optional(trimmed(*line)) : std::nullopt;
}

std::string_view Atom_lines::expect(std::string_view what) {
  const auto line = next();
  if (!line) fail(joined("the file ends in the middle of a frame; expected ", what));
  return *line;
}

std::size_t Atom_lines::count(std::string_view field) const {
  std::size_t result = 0;
  const char* const end = field.data() + field.size();
  const auto [rest, problem] = std::from_chars(field.data(), end, result);
  if (problem != std::errc() || rest != end) {
    fail(joined("the number of atoms is ", in_quotes(field), "; expected a whole number"));
  }
  return result;
}

const std::vector<std::string_view>& Atom_lines::atom(std::size_t index, std::size_t count,
                                                      std::size_t least) {
  const auto line = next();
  if (!line) {
    fail(joined("the file ends after ", index, " of the ", count,
                " atoms of a frame; expected all of them"));
  }
  fields_.clear();
  for_each_field_between_blanks(*line,
                                [this](std::string_view field) { fields_.push_back(field); });
  if (fields_.size() < least) {
    fail(joined("the atom has ", fields_.size(), fields_.size() == 1 ? " field" : " fields",
                "; expected at least ", least));
  }
  return fields_;
}

}  // namespace kinetri
