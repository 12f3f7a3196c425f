// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checkpoint files: the whole state of a simulation, from which it can be resumed; also of one in a
// periodic box, with the box. A text file of three parts: a first line with format and version, the
// state as JSON, and a last line with the CRC-32 checksum of all before it. The state includes the
// names, sizes and checksums of the files that the run has written.
#ifndef KINETRI_IO_CHECKPOINT_FILE_H
#define KINETRI_IO_CHECKPOINT_FILE_H

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "kinetri/base/error.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/kinetic/periodic_box_2.h"
#include "kinetri/kinetic/periodic_kinetic_traits_2.h"
#include "kinetri/simulation/simulation_2.h"

namespace kinetri {

/// A file that belongs to a checkpoint: it was written by the run before the checkpoint.
struct Checkpoint_log {
  /// Its content: in the program events, motions, initial-edges or edges.
  std::string output;
  std::string path;  ///< from the checkpoint's directory if it is below that, else from the root
  std::uint64_t bytes = 0;  ///< its size
  std::uint32_t crc32 = 0;  ///< its checksum, the CRC-32 of zlib

  friend bool operator==(const Checkpoint_log&, const Checkpoint_log&) = default;
};

/// The content of a checkpoint file.
struct Checkpoint {
  std::variant<Simulation_snapshot<Linear_kinetic_traits_2>,
               Simulation_snapshot<Polynomial_kinetic_traits_2>,
               Simulation_snapshot<Disc_kinetic_traits_2>,
               Simulation_snapshot<Polynomial_disc_kinetic_traits_2>,
               Simulation_snapshot<Periodic_kinetic_traits_2>,
               Simulation_snapshot<Periodic_disc_kinetic_traits_2>>
      simulation;  ///< of the simulation's kind of motion, in the plane or in a periodic box
  /// The name of the response to collisions, which a snapshot does not store: text in UTF-8. The
  /// program uses the names of `named_responses`.
  std::string response = "none";
  /// The files that belong to it, so that a program that resumes it can verify them. Texts in
  /// UTF-8. Functions of this header do not read these files.
  std::vector<Checkpoint_log> logs = {};
  /// The box of a simulation in a periodic box, which a snapshot does not store; else none.
  std::optional<Periodic_box_2> periodic_box = std::nullopt;
};

/// Writes a checkpoint so that read_checkpoint restores every number: binary64 numbers with digits
/// that read back exactly, -0 too, and exact times as fractions, or as the root of a polynomial
/// between two fractions. Counters of certificates, rechecks and discarded entries are omitted,
/// since they depend on the number of threads: so the text does not. Errors are those of the
/// stream. Cost: linear; some 150 bytes a point. Precondition: there is a periodic box if and only
/// if the snapshot is that of a simulation in one.
void write_checkpoint(std::ostream& out, const Checkpoint& checkpoint);

/// Writes the file `path` completely or not at all: under a temporary name in the same directory,
/// then renamed. Throws Output_error.
void write_checkpoint_file(const std::string& path, const Checkpoint& checkpoint);

/// Reads a checkpoint. Throws Input_error `name: what is wrong, what was expected` if it is not one
/// (which its first bytes show), has another version, is damaged (its checksum differs), or has
/// invalid content, such as a line of more than 2^24 bytes, or a periodic box without area at the
/// time of the state. Whether the state is consistent is checked when a simulation is restored,
/// which throws Snapshot_error; and Periodic_box_error if a point is too far away from the periodic
/// box. Cost: linear; memory for several times the size of the text.
Checkpoint read_checkpoint(std::istream& in, const std::string& name);

/// Reads the file `path`, or standard input if it is "-". Throws as read_checkpoint, and if the
/// path is a directory or cannot be opened.
Checkpoint read_checkpoint_file(const std::string& path);

}  // namespace kinetri

#endif  // KINETRI_IO_CHECKPOINT_FILE_H
