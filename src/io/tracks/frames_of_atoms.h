// SPDX-License-Identifier: GPL-3.0-or-later
//
// The common part of dumps of LAMMPS and files of XYZ: frames with numbers of atoms.
#ifndef KINETRI_SRC_IO_TRACKS_FRAMES_OF_ATOMS_H
#define KINETRI_SRC_IO_TRACKS_FRAMES_OF_ATOMS_H

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tracks_readers.h"

namespace kinetri {

/// Reads lines, including blank ones and comments.
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

  /// The number of atoms in `field`.
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

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_FRAMES_OF_ATOMS_H
