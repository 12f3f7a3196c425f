// SPDX-License-Identifier: GPL-3.0-or-later
//
// Output files that are whole or not there: written under a temporary name beside the target, which
// takes the target's place when everything has been written.
#ifndef KINETRI_IMPL_IO_OUTPUT_FILE_H
#define KINETRI_IMPL_IO_OUTPUT_FILE_H

#include <memory>
#include <optional>
#include <ostream>
#include <string>

#include "kinetri/impl/io/checksum.h"
#include "kinetri/impl/io/file_descriptor.h"
#include "kinetri/io/output_error.h"

struct stat;

namespace kinetri {

/// Nobody reads standard output any more: it is a pipe whose other end was closed.
class Unread_output_error : public Output_error {
 public:
  using Output_error::Output_error;
};

/// An output file. Until `commit` the target is untouched; without `commit` it stays so.
///
/// The temporary is in the target's directory, and hidden; what a killed process has left of one is
/// removed (temporary.h). An existing target keeps its permissions and is replaced in one step; a
/// symbolic link is followed. What is no regular file (/dev/null, a
/// named pipe) and standard output, named "-", are written directly.
class Output_file {
 public:
  /// Opens the output. Throws Output_error if the target is a directory or cannot be written, or if
  /// standard output is closed.
  explicit Output_file(std::string path);
  /// Removes the temporary if there is one.
  ~Output_file();

  /// Takes the other one's place; that one can only be destroyed.
  Output_file(Output_file&&) noexcept;
  Output_file& operator=(Output_file&&) = delete;

  /// The path as given to the constructor.
  const std::string& path() const noexcept { return path_; }

  /// What identifies the target: two outputs with the same one would overwrite each other. Empty if
  /// that cannot happen (/dev/null).
  const std::string& identity() const noexcept { return identity_; }

  /// Where to write. It fails when a write does; finish() says why.
  std::ostream& stream() noexcept;

  /// From now on a checksum is kept of what is written, unless the output is written directly.
  /// Precondition: nothing has been written.
  void keep_checksum();

  /// The checksum of the file, once it is complete. None if none is kept.
  const std::optional<Checksum>& checksum() const noexcept;

  /// Writes out what is buffered and closes the file. Throws Output_error if anything since the
  /// construction was not written, Unread_output_error if that is because nobody reads it. Where
  /// several outputs belong together, finish them all before the first commit. Idempotent.
  void finish();

  /// finish(), then the target is the new file. Throws Output_error. Idempotent.
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
  std::unique_ptr<std::string> temporary_;  // none if written directly, and after commit
  File_descriptor lock_;                    // of the temporary
  std::unique_ptr<Buffer> buffer_;
  std::unique_ptr<std::ostream> stream_;
  bool finished_ = false;
};

}  // namespace kinetri

#endif  // KINETRI_IMPL_IO_OUTPUT_FILE_H
