// SPDX-License-Identifier: GPL-3.0-or-later
//
// Directories of output files that are whole or not there: as Output_file, for many files at once.
#ifndef KINETRI_IMPL_IO_OUTPUT_DIRECTORY_H
#define KINETRI_IMPL_IO_OUTPUT_DIRECTORY_H

#include <memory>
#include <string>
#include <string_view>

#include "kinetri/impl/io/output_file.h"

namespace kinetri {

/// A directory of output files. Its files are written into a hidden directory beside the target,
/// which takes the target's place with `commit`; without `commit` it is removed.
class Output_directory {
 public:
  /// Throws Output_error if the target is there and is no empty directory, or is one that cannot
  /// be replaced (the current one; one where a file system is mounted); or if no directory can be
  /// made beside it, which is tried. Leaves nothing there.
  explicit Output_directory(std::string path);
  /// Removes what has been written and not committed.
  ~Output_directory();

  /// Takes the other one's place; that one can only be destroyed.
  Output_directory(Output_directory&&) noexcept;
  Output_directory& operator=(Output_directory&&) = delete;

  /// The path as given to the constructor.
  const std::string& path() const noexcept { return path_; }

  /// The target's absolute path, without symbolic links: two outputs with the same one, or one
  /// below that of a directory, would be in each other's way.
  const std::string& identity() const noexcept { return identity_; }

  /// Writes a file. Throws Output_error if not all of it can be written. Precondition: `name` is a
  /// plain file name that has not been used in this directory.
  void write(std::string_view name, std::string_view content);

  /// The target is the new directory, without files if none was written. Throws Output_error, as
  /// where something was put into the target meanwhile. Nothing can be written afterwards.
  /// Idempotent.
  void commit();

  /// As Output_file::remove_all_temporaries: async-signal-safe. Covers the first 16 directories
  /// that are open at a time.
  static void remove_all_temporaries() noexcept;

 private:
  struct Temporary;

  void make_temporary();
  void discard() noexcept;

  std::string path_;
  std::string identity_;
  std::unique_ptr<Temporary> temporary_;  // none before the first file, and after commit
  bool committed_ = false;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_OUTPUT_DIRECTORY_H
