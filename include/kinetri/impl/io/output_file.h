// SPDX-License-Identifier: GPL-3.0-or-later
//
// Output files that are complete or absent: written under a temporary name beside the target, and
// renamed when everything has been written.
#ifndef KINETRI_IMPL_IO_OUTPUT_FILE_H
#define KINETRI_IMPL_IO_OUTPUT_FILE_H

#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "kinetri/base/error.h"
#include "kinetri/impl/io/checksum.h"
#include "kinetri/impl/io/file_descriptor.h"

struct stat;

namespace kinetri {

/// Standard output is a pipe whose reader has closed it.
class Unread_output_error : public Output_error {
 public:
  using Output_error::Output_error;
};

/// An output file. Only `commit` changes the target.
///
/// The temporary is a hidden file in the target's directory; those left by killed processes are
/// removed (temporary.h). An existing target keeps its permissions and is replaced in one step; a
/// symbolic link is followed. Other files than regular ones (/dev/null, a named pipe) and standard
/// output, named "-", are written directly.
class Output_file {
 public:
  /// Opens the output. Throws Output_error if the target is a directory or cannot be written, or if
  /// standard output is closed.
  explicit Output_file(std::string path);
  /// Removes the temporary if there is one.
  ~Output_file();

  /// The other object can only be destroyed afterwards.
  Output_file(Output_file&&) noexcept;
  Output_file& operator=(Output_file&&) = delete;

  /// The path as given to the constructor.
  const std::string& path() const noexcept { return path_; }

  /// Identifies the target: two outputs with the same identity would overwrite each other. Empty if
  /// that cannot happen (/dev/null).
  const std::string& identity() const noexcept { return identity_; }

  /// The stream to write to. It fails when a write does; finish() throws the reason.
  std::ostream& stream() noexcept;

  /// Computes a checksum from now on, unless the output is written directly. Precondition: nothing
  /// has been written.
  void keep_checksum();

  /// The checksum of the file, once it is complete. None if none is computed.
  const std::optional<Checksum>& checksum() const noexcept;

  /// Flushes and closes the file. Throws Output_error if anything since the construction was not
  /// written, Unread_output_error if the reader has closed the pipe. If several outputs belong
  /// together, finish them all before the first commit. Idempotent.
  void finish();

  /// Calls finish(), then replaces the target. Throws Output_error. Idempotent.
  void commit();

  /// Removes the temporaries of all outputs that are not committed. For handlers of signals that
  /// end the process: async-signal-safe; the outputs cannot be used afterwards. Covers the first 16
  /// outputs that are open at a time.
  static void remove_all_temporaries() noexcept;

 private:
  class Buffer;

  void open_temporary(const struct stat* existing);
  void open_directly(bool character_device);
  void discard() noexcept;

  std::string path_;
  std::string identity_;
  std::string target_;                      // the file that the temporary replaces
  std::unique_ptr<std::string> temporary_;  // null if written directly, and after commit
  File_descriptor lock_;                    // of the temporary
  std::unique_ptr<Buffer> buffer_;
  std::unique_ptr<std::ostream> stream_;
  bool finished_ = false;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_OUTPUT_FILE_H
