// SPDX-License-Identifier: GPL-3.0-or-later
//
// The threads that the program works with.
#ifndef KINETRI_APPS_WORKER_THREADS_H
#define KINETRI_APPS_WORKER_THREADS_H

#include <tbb/global_control.h>

#include <cstddef>
#include <optional>

namespace kinetri::app {

/// The threads of oneTBB that work beside this one. All of them are made at once, with the signals
/// of interrupt.h blocked: so it is always this thread that takes these, which writes the outputs.
/// A thread that oneTBB makes when it is needed would take signals as this one does.
///
/// Where the system does not give so many threads within a second, the others may be made later,
/// and take signals: their handler hands them on to the thread that writes outputs.
class Worker_threads {
 public:
  /// With this one, `number` threads; 0: as many as oneTBB takes on this machine. As long as this
  /// object lives there are no more.
  explicit Worker_threads(std::size_t number);
  Worker_threads(const Worker_threads&) = delete;
  Worker_threads& operator=(const Worker_threads&) = delete;

 private:
  std::optional<tbb::global_control> limit_;
};

}  // namespace kinetri::app

#endif  // KINETRI_APPS_WORKER_THREADS_H
