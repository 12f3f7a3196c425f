// SPDX-License-Identifier: GPL-3.0-or-later
//
// Periodic boxes of atoms. If an atom leaves a box and enters it on the other side, its path
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

/// The projection of a box to the plane: a parallelepiped whose edges may be tilted.
struct Atom_box {
  Vector_2 corner;                ///< the origin of the edges
  std::array<Vector_2, 3> edges;  ///< (0, 0) for one that is parallel to z
  std::array<bool, 3> is_periodic = {false, false, false};  ///< in the direction of each edge

  friend bool operator==(const Atom_box&, const Atom_box&) = default;
};

/// The boxes of the frames of a file.
class Atom_boxes {
 public:
  /// Sets the box of the atoms from this line on. Precondition: the lines ascend. `are_wrapped`:
  /// whether their places may be those of any image; else the file says which image is meant.
  void add(std::size_t line, const Atom_box& box, bool are_wrapped = true);

  /// Sets Tracks_file::periodic_box, and moves each atom to the nearest image of its next position,
  /// if the options request it. Else
  /// throws Input_error if an image of the next position of an atom is nearer than that, so that it
  /// has jumped; the message ends in `expected`. Throws also if there is not exactly one box in
  /// which to unwrap, if two images are equally near, or if images are ambiguous in the plane,
  /// since three periodic edges have components in it.
  void settle_jumps(Tracks_file& file, const Tracks_input& input, std::string_view expected) const;

 private:
  // The lattice of the images of a position.
  struct Images {
    std::size_t line = 0;
    Atom_box box;
    std::vector<Vector_2> edges;     // that are periodic and not parallel to z
    std::vector<Vector_2> basis;     // at most two, reduced; empty if two do not suffice
    std::vector<Vector_2> shortest;  // one of them or their negatives leads to the nearest image
  };

  static Images images_of(std::size_t line, const Atom_box& box);
  const Images& images_at(std::size_t line) const;
  void expect_periodic_box(const Tracks_file& file, const std::string& name) const;
  void unwrap(Tracks_file& file, const std::string& name, std::string_view expected) const;
  void expect_no_jumps(const Tracks_file& file, const std::string& name,
                       std::string_view expected) const;

  std::vector<Images> boxes_;      // of wrapped places; each differs from the one before
  std::vector<Images> all_boxes_;  // the first, and the first other one if there is one
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TRACKS_ATOM_BOXES_H
