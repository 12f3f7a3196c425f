// SPDX-License-Identifier: GPL-3.0-or-later
//
// What dumps of LAMMPS and files of XYZ have in common: frames that say how many atoms follow, and
// places in a periodic box.
#ifndef KINETRI_SRC_IO_TRACKS_FRAMES_OF_ATOMS_H
#define KINETRI_SRC_IO_TRACKS_FRAMES_OF_ATOMS_H

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracks_readers.h"

namespace kinetri {

/// Reads lines with the errors of such files. Blank lines and comments are lines.
class Atom_lines {
 public:
  explicit Atom_lines(const Tracks_input& input)
      : name_(input.name), table_(input.in, input.name, tracks_kind) {}

  /// The next line, trimmed; none at the end.
  std::optional<std::string_view> next();

  /// The next line. Throws Input_error at the end; `what` was expected.
  std::string_view expect(std::string_view what);

  std::size_t line() const { return table_.line(); }
  [[noreturn]] void fail(const std::string& message) const { table_.fail(message); }
  double number(std::string_view field, std::string_view column) const {
    return table_.number(field, column);
  }

  /// The number of atoms that `field` is.
  std::size_t count(std::string_view field) const;

  /// Splits the line of one atom; valid until the next call. Throws Input_error unless it has at
  /// least `least` fields.
  const std::vector<std::string_view>& atom(std::size_t index, std::size_t count,
                                            std::size_t least);

 private:
  const std::string& name_;
  Table_reader table_;
  std::vector<std::string_view> fields_;
};

/// Where atoms that leave a box come in on its other side, their path between two frames is not the
/// straight line. The widths of a box in the directions of x and y in which it is periodic and
/// places may jump; the least of all frames.
class Periodic_widths {
 public:
  /// The width in a frame.
  void add(std::size_t direction, double width);

  /// The box of a frame is tilted: who leaves it in the direction of y also jumps in that of x.
  void add_tilt() { is_tilted_ = true; }

  /// Lets atoms go on to the nearest image of their next place, if the options ask for that. Else
  /// throws Input_error if an atom goes farther than half a width from one frame to the next, which
  /// is a jump; the message ends in `expected`. Throws also if there is no box, or none of one
  /// width, in which to unwrap, or if two images are equally near.
  void settle_jumps(Tracks_file& file, const Tracks_input& input, std::string_view expected) const;

 private:
  void expect_no_jumps(const Tracks_file& file, const std::string& name,
                       std::string_view expected) const;
  void unwrap(Tracks_file& file, const std::string& name) const;

  std::array<double, 2> least_ = {std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::infinity()};
  std::array<double, 2> greatest_ = {0, 0};
  bool is_tilted_ = false;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_FRAMES_OF_ATOMS_H
