// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames_of_atoms.h"

#include <algorithm>
#include <charconv>
#include <cmath>

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
  least_[direction] = std::min(least_[direction], width);
  greatest_[direction] = std::max(greatest_[direction], width);
}

void Periodic_widths::settle_jumps(Tracks_file& file, const Tracks_input& input,
                                   std::string_view expected) const {
  if (input.options.unwrap == Tracks_unwrap::nearest) {
    unwrap(file, input.name);
  } else {
    expect_no_jumps(file, input.name, expected);
  }
}

void Periodic_widths::unwrap(Tracks_file& file, const std::string& name) const {
  const auto fail = [&](std::size_t line, const std::string& message) {
    throw Input_error(name, line, message);
  };
  if (greatest_[0] == 0 && greatest_[1] == 0 && !file.tracks.empty()) {
    fail(0, "has no wrapped places in a box that is periodic in x or y; expected no --unwrap");
  }
  if (is_tilted_) fail(0, "has a box that is tilted; expected no --unwrap, and unwrapped places");
  for (std::size_t direction = 0; direction < 2; ++direction) {
    if (greatest_[direction] == 0 || least_[direction] == greatest_[direction]) continue;
    fail(0, joined("has a box whose width changes, from ", least_[direction], " to ",
                   greatest_[direction], "; expected no --unwrap, and unwrapped places"));
  }
  std::size_t crossings = 0;
  for (Track& track : file.tracks) {
    std::array<double, 2> turns = {0, 0};  // around the box so far
    Vector_2 last = track.observations.front().place;
    for (std::size_t i = 1; i < track.observations.size(); ++i) {
      Track_observation& next = track.observations[i];
      const Vector_2 wrapped = next.place;
      const std::array<double, 2> steps = {wrapped.x - last.x, wrapped.y - last.y};
      const std::array<double*, 2> coordinates = {&next.place.x, &next.place.y};
      for (std::size_t direction = 0; direction < 2; ++direction) {
        const double width = greatest_[direction];
        if (width == 0) continue;
        const double images = std::round(steps[direction] / width);
        if (std::abs(steps[direction] - images * width) == width / 2) {
          fail(next.line, joined("atom ", quoted(track.id),
                                 " goes half of the periodic box, which "
                                 "is ",
                                 width, " wide, since line ", track.observations[i - 1].line,
                                 ": two images of it are equally near; expected more frames"));
        }
        crossings += images == 0 ? 0 : 1;
        turns[direction] -= images;
        *coordinates[direction] += turns[direction] * width;
        if (!std::isfinite(*coordinates[direction])) {
          fail(next.line, joined("the place of atom ", quoted(track.id),
                                 " beyond the box is out of "
                                 "the range of binary64; expected smaller numbers"));
        }
      }
      last = wrapped;
    }
  }
  file.remarks.push_back(
      joined("atoms go on to the nearest image of their next place, beyond the "
             "periodic box ",
             crossings, crossings == 1 ? " time" : " times"));
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
        if (!(std::abs(steps[direction]) > least_[direction] / 2)) continue;
        throw Input_error(
            name, next.line,
            joined("atom ", quoted(track.id), " goes ", std::abs(steps[direction]), " since line ",
                   last.line, ", more than half of the periodic box, which is ", least_[direction],
                   " wide: it left on one side and came in on the other; ", expected,
                   ", or --unwrap nearest, which lets atoms go the shortest way"));
      }
    }
  }
}

}  // namespace kinetri
