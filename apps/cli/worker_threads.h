// SPDX-License-Identifier: GPL-3.0-or-later
//
// The worker threads of the program.
#ifndef KINETRI_APPS_WORKER_THREADS_H
#define KINETRI_APPS_WORKER_THREADS_H

#include <tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace kinetri::app {

/// The worker threads of oneTBB. All are created at once with the signals of interrupt.h blocked,
/// so that this thread, which writes the outputs, receives the signals.
///
/// If the system does not provide all threads within a second, the others may be created later, and
/// receive signals: the handler forwards them to the thread that writes outputs.
class Worker_threads {
 public:
  /// Limits the program to `number` threads, this one included, while this object exists; 0: to the
  /// default of oneTBB.
  explicit Worker_threads(std::size_t number);
  Worker_threads(const Worker_threads&) = delete;
  Worker_threads& operator=(const Worker_threads&) = delete;

 private:
  std::optional<tbb::global_control> limit_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_WORKER_THREADS_H
