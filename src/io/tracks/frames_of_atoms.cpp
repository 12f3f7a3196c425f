// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames_of_atoms.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/text.h"
#include "kinetri/base/error.h"

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
    fail(joined("the number of atoms is ", quoted(field), "; expected a whole number"));
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

void Periodic_widths::add(std::size_t direction, double width) {
  widths_[direction] = std::min(widths_[direction], width);
}

void Periodic_widths::expect_no_jumps(const Tracks_file& file, const std::string& name,
                                      std::string_view expected) const {
  for (const Track& track : file.tracks) {
    for (std::size_t i = 1; i < track.observations.size(); ++i) {
      const Track_observation& last = track.observations[i - 1];
      const Track_observation& next = track.observations[i];
      const std::array<double, 2> steps = {next.place.x - last.place.x,
                                           next.place.y - last.place.y};
      for (std::size_t direction = 0; direction < 2; ++direction) {
        if (!(std::abs(steps[direction]) > widths_[direction] / 2)) continue;
        throw Input_error(
            name, next.line,
            joined("atom ", quoted(track.id), " goes ", std::abs(steps[direction]), " since line ",
                   last.line, ", more than half of the periodic box, which is ", widths_[direction],
                   " wide: it left on one side and came in on the other; ", expected));
      }
    }
  }
}

}  // namespace kinetri
