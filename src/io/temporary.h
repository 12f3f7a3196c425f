// SPDX-License-Identifier: GPL-3.0-or-later
//
// Temporaries: files and directories beside a target whose place they are to take. A process that
// is killed leaves them behind, and a later one that writes the same target removes them.
//
// A living process is known by a lock (flock) on its temporary, which ends with the process however
// that ends. A lock tells nothing where it is not seen: by another machine that has the same folder
// over a network, or through another file system on top of this one. So the name of a temporary
// says in which running kernel and file system its lock is held, and only there it is taken for
// left over. It stays where there is any doubt: where locks are not supported, or after a restart
// of the system.
#ifndef KINETRI_SRC_IO_TEMPORARY_H
#define KINETRI_SRC_IO_TEMPORARY_H

#include <signal.h>

#include <filesystem>
#include <string>

#include "kinetri/impl/io/file_descriptor.h"

namespace kinetri {

enum class Temporary_kind { file, directory };

/// What was made. As long as a descriptor for it is open, no process takes it for left over.
struct Made_temporary {
  std::string path;            ///< `.kinetri-` and the target's name are its beginning
  File_descriptor descriptor;  ///< of a file for writing; none if nothing could be made
  int error = 0;               ///< why: an errno
};

/// Removes what other processes have left beside the target, then makes a temporary of this process
/// there, an empty one. Its name is used only once. Cost: reads the target's directory.
Made_temporary make_temporary(Temporary_kind kind, const std::filesystem::path& target);

/// Removes the directory and the files in it, but no directory in it. `descriptor` is one of it.
void remove_directory(int descriptor, const char* path);

/// Holds signals back from this thread as long as it lives.
class Signals_held_back {
 public:
  Signals_held_back() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  ~Signals_held_back() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  Signals_held_back(const Signals_held_back&) = delete;
  Signals_held_back& operator=(const Signals_held_back&) = delete;

 private:
  sigset_t before_;
};

}  // namespace kinetri

#endif  // KINETRI_SRC_IO_TEMPORARY_H
