// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/worker_threads.h"

#include <pthread.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>

#include "cli/interrupt.h"

namespace kinetri::app {
namespace {

// While it exists, the signals that interrupt.cpp handles are blocked in this thread; threads that
// it creates inherit that.
class Signal_block {
 public:
  Signal_block() {
    const sigset_t handled = handled_signals();
    ::pthread_sigmask(SIG_BLOCK, &handled, &before_);
  }
  ~Signal_block() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  Signal_block(const Signal_block&) = delete;
  Signal_block& operator=(const Signal_block&) = delete;

 private:
  sigset_t before_ = {};
};

// A barrier with a time limit.
class Meeting {
 public:
  explicit Meeting(std::size_t number) : missing_(number) {}

  // Waits until all threads have called it, but at most a second.
  void wait() {
    std::unique_lock lock(mutex_);
    if (--missing_ == 0) all_are_here_.notify_all();
    all_are_here_.wait_until(lock, end_, [this] { return missing_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable all_are_here_;
  std::size_t missing_;
  const std::chrono::steady_clock::time_point end_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(1);
};

}  // namespace

// oneTBB creates a thread if there is work and all its threads are busy, and keeps it. So once all
// are busy at the same time, all have been created.
Worker_threads::Worker_threads(std::size_t number) {
  using tbb::global_control;
  if (number > 0) limit_.emplace(global_control::max_allowed_parallelism, number);
  const std::size_t threads = global_control::active_value(global_control::max_allowed_parallelism);
  if (threads == 1) return;
  const Signal_block block;
  tbb::task_arena arena(static_cast<int>(threads));
  Meeting meeting(threads);
  arena.execute([&] {
    const auto meet = [&](std::size_t /*one*/) { meeting.wait(); };
    tbb::parallel_for(std::size_t{0}, threads, meet, tbb::simple_partitioner());
  });
}

}  // namespace kinetri::app
