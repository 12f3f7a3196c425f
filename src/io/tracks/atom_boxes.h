// SPDX-License-Identifier: GPL-3.0-or-later
//
// Periodic boxes of atoms. Where atoms that leave a box come in on its other side, their path
// between two frames is not the straight line.
#ifndef KINETRI_SRC_IO_TRACKS_ATOM_BOXES_H
#define KINETRI_SRC_IO_TRACKS_ATOM_BOXES_H

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tracks_readers.h"

namespace kinetri {

/// A box, as the plane shows it: a parallelepiped whose edges may lead aside.
struct Atom_box {
  Vector_2 corner;                ///< from which the edges go
  std::array<Vector_2, 3> edges;  ///< (0, 0) for one that is parallel to z
  std::array<bool, 3> is_periodic = {false, false, false};  ///< in the direction of each edge

  friend bool operator==(const Atom_box&, const Atom_box&) = default;
};

/// The boxes of the frames of a file.
class Atom_boxes {
 public:
  /// The box of the atoms from this line on, whose places may jump from one of its sides to the
  /// other. Precondition: the lines ascend.
  void add(std::size_t line, const Atom_box& box);

  /// Lets atoms go on to the nearest image of their next place, if the options ask for that. Else
  /// throws Input_error if an image of the next place of an atom is nearer than this place, which
  /// then is one behind a jump; the message ends in `expected`. Throws also if there is no box, or
  /// no single one, in which to unwrap, if two images are equally near, and if places in the plane
  /// do not tell the images: where three periodic edges lead aside in it.
  void settle_jumps(Tracks_file& file, const Tracks_input& input, std::string_view expected) const;

 private:
  // What lies between the images of a place.
  struct Images {
    std::size_t line = 0;
    Atom_box box;
    std::vector<Vector_2> basis;     // two at most, the shortest; empty if these do not suffice
    std::vector<Vector_2> shortest;  // of which one leads to the nearest image; not its negatives
  };

  static Images images_of(std::size_t line, const Atom_box& box);
  const Images& images_at(std::size_t line) const;
  void unwrap(Tracks_file& file, const std::string& name, std::string_view expected) const;
  void expect_no_jumps(const Tracks_file& file, const std::string& name,
                       std::string_view expected) const;

  std::vector<Images> boxes_;  // each differs from the one before
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_ATOM_BOXES_H
