// SPDX-License-Identifier: GPL-3.0-or-later
//
// Temporaries: files and directories beside a target that they will replace. Those of killed
// processes are removed by a later process that writes the same target.
//
// A living process holds a lock (flock) on its temporary, which ends with the process. Locks may be
// invisible to another machine that shares the directory, or through another file system on top of
// this one. So the name of a temporary names the running kernel and file system of its lock, and
// only processes there remove it. It remains if locks are not supported, or after a restart of the
// system.
#ifndef KINETRI_SRC_IO_TEMPORARY_H
#define KINETRI_SRC_IO_TEMPORARY_H

#include <signal.h>

#include <filesystem>
#include <string>

#include "kinetri/impl/io/file_descriptor.h"

namespace kinetri {

enum class Temporary_kind { file, directory };

/// A new temporary. No process removes it while a descriptor of it is open.
struct Made_temporary {
  std::string path;            ///< `.kinetri-` and the target's name are its beginning
  File_descriptor descriptor;  ///< of a file for writing; none after an error
  int error = 0;               ///< an errno
};

/// Removes the temporaries of ended processes beside the target, then creates an empty one with a
/// unique name. Cost: reads the target's directory.
Made_temporary make_temporary(Temporary_kind kind, const std::filesystem::path& target);

/// Removes the directory and its files, but no subdirectories. `descriptor` is open for it.
void remove_directory(int descriptor, const char* path);

/// Blocks signals to this thread during its lifetime.
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
