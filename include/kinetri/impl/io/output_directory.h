// SPDX-License-Identifier: GPL-3.0-or-later
//
// Directories of output files that are complete or absent: as Output_file, for many files at once.
#ifndef KINETRI_IMPL_IO_OUTPUT_DIRECTORY_H
#define KINETRI_IMPL_IO_OUTPUT_DIRECTORY_H

#include <memory>
#include <string>
#include <string_view>

#include "kinetri/impl/io/output_file.h"

namespace kinetri {

/// A directory of output files. They are written into a hidden directory beside the target, which
/// replaces the target in `commit`, and else is removed.
class Output_directory {
 public:
  /// Throws Output_error if the target exists and is not an empty directory, or cannot be replaced
  /// (the current directory, a mount point); or if no directory can be created beside it, which is
  /// tried and undone.
  explicit Output_directory(std::string path);
  /// Removes uncommitted files.
  ~Output_directory();

  /// The other object can only be destroyed afterwards.
  Output_directory(Output_directory&&) noexcept;
  Output_directory& operator=(Output_directory&&) = delete;

  /// The path as given to the constructor.
  const std::string& path() const noexcept { return path_; }

  /// The target's absolute path, without symbolic links: outputs conflict if theirs are equal, or
  /// one is below the other.
  const std::string& identity() const noexcept { return identity_; }

  /// Writes a file. Throws Output_error if not all of it can be written. Precondition: `name` is a
  /// plain file name that has not been used in this directory.
  void write(std::string_view name, std::string_view content);

  /// Replaces the target by the new directory, even without files. Throws Output_error, for
  /// instance if the target is no longer empty. Nothing can be written afterwards. Idempotent.
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
  std::unique_ptr<Temporary> temporary_;  // null before the first file, and after commit
  bool committed_ = false;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_OUTPUT_DIRECTORY_H
