// SPDX-License-Identifier: GPL-3.0-or-later
//
// Checkpoint files: the whole state of a simulation, to go on with later as if there had been no
// break. A text file of three parts: a first line that names format and version, the state as JSON,
// and a last line with the CRC-32 checksum of all before it. Beside the simulation, the state has
// the names, sizes and checksums of the files that its run has written.
#ifndef KINETRI_IO_CHECKPOINT_FILE_H
#define KINETRI_IO_CHECKPOINT_FILE_H

#include <cstdint>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "kinetri/io/output_error.h"
#include "kinetri/kinetic/basic_kinetic_traits_2.h"
#include "kinetri/simulation/simulation_snapshot.h"

namespace kinetri {

/// A file that belongs to a checkpoint: what a run has written before it was broken off.
struct Checkpoint_log {
  /// What it holds: the program has events, motions, initial-edges and edges.
  std::string output;
  std::string path;  ///< from the checkpoint's directory if it is below that, else from the root
  std::uint64_t bytes = 0;  ///< its size
  std::uint32_t crc32 = 0;  ///< its checksum, the CRC-32 of zlib

  friend bool operator==(const Checkpoint_log&, const Checkpoint_log&) = default;
};

/// What a checkpoint file holds.
struct Checkpoint {
  std::variant<Simulation_snapshot<Linear_kinetic_traits_2>,
               Simulation_snapshot<Polynomial_kinetic_traits_2>,
               Simulation_snapshot<Disc_kinetic_traits_2>,
               Simulation_snapshot<Polynomial_disc_kinetic_traits_2>>
      simulation;  ///< of the kind of motion that the simulation had
  /// The name of the response to collisions, for whoever restores the simulation and has to give it
  /// one: text in UTF-8. The program has the names of `named_responses`.
  std::string response = "none";
  /// What belongs to it, so that whoever continues it can tell whether it is still the same. Texts
  /// in UTF-8. Nothing here reads these files.
  std::vector<Checkpoint_log> logs = {};
};

/// Writes a checkpoint so that read_checkpoint gives every number back: binary64 numbers with
/// digits that read back exactly, -0 too, and exact times as fractions, or as the root of a
/// polynomial between two fractions. Of the counters it has those that tell what happened, and not
/// those of certificates, rechecks and what was discarded, which tell how the run was made: so the
/// text is the same however many threads made it. Errors are those of the stream. Cost: linear;
/// some 150 bytes a point.
void write_checkpoint(std::ostream& out, const Checkpoint& checkpoint);

/// Writes the file `path` whole, or not at all: it is written under a temporary name beside its
/// place, which it then takes. Throws Output_error.
void write_checkpoint_file(const std::string& path, const Checkpoint& checkpoint);

/// Reads a checkpoint. Throws Input_error `name: what is wrong, what was expected` if it is none,
/// is one of another version, is damaged (its checksum differs), or holds what no checkpoint holds:
/// a line of more than 2^24 bytes, for one. A file that is none is refused after its first bytes.
/// Whether the state makes sense is seen when a simulation is made of it, which throws
/// Snapshot_error. Cost: linear; needs memory for several times the size of the text.
Checkpoint read_checkpoint(std::istream& in, const std::string& name);

/// Reads the file `path`, or standard input if it is "-". Throws as read_checkpoint, and if the
/// path is a directory or cannot be opened.
Checkpoint read_checkpoint_file(const std::string& path);

}  // namespace kinetri

#endif  // KINETRI_IO_CHECKPOINT_FILE_H
