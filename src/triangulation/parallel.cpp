// SPDX-License-Identifier: GPL-3.0-or-later
#include "kinetri/impl/triangulation/parallel.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <functional>

#include "base/thread_sanitizer.h"

namespace kinetri::detail {

std::size_t usable_threads(std::size_t threads) {
  using tbb::global_control;
  const std::size_t allowed = global_control::active_value(global_control::max_allowed_parallelism);
  if (threads == 0) threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  return std::min(threads, allowed);
}

void call_with_threads(std::size_t threads, const std::function<void()>& work) {
  if (threads < 2) return work();
  tbb::task_arena arena(static_cast<int>(usable_threads(threads)));
  arena.execute(work);
}

void for_each_index_in_parallel(std::size_t count, const std::function<void(std::size_t)>& work) {
  if (count == 1) return work(0);
  // ThreadSanitizer does not see that oneTBB orders the call before the tasks, and the tasks before
  // the return; the annotations say so. The tags are static because a task may read nothing of this
  // thread, not even the reference to `work`, before its first annotation.
  static char begun, done;
  annotate_happens_before(&begun);
  tbb::parallel_for(std::size_t{0}, count, [&work](std::size_t k) {
    annotate_happens_after(&begun);
    work(k);
    annotate_happens_before(&done);
  });
  annotate_happens_after(&done);
}

}  // namespace kinetri::detail
