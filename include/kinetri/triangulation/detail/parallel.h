// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work that several threads do.
#ifndef KINETRI_TRIANGULATION_DETAIL_PARALLEL_H
#define KINETRI_TRIANGULATION_DETAIL_PARALLEL_H

#include <tbb/parallel_for_each.h>

#include <vector>

#ifdef __SANITIZE_THREAD__
#define KINETRI_THREAD_SANITIZER
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define KINETRI_THREAD_SANITIZER
#endif
#endif
#ifdef KINETRI_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace kinetri::detail {

/// Calls work(block) for each of the blocks, by as many threads as oneTBB lends; in this one, in
/// their order, where there is only one block.
template <class Block, class Work>
void for_each_in_parallel(std::vector<Block>& blocks, const Work& work) {
  if (blocks.size() == 1) return work(blocks.front());
#ifdef KINETRI_THREAD_SANITIZER
  // It does not see into oneTBB's library, which has work begin after what came before, and what
  // comes next after the work. A task may read nothing before it is told so, hence the address of
  // something global.
  static char begun, done;
  __tsan_release(&begun);
  tbb::parallel_for_each(blocks, [&work](Block& block) {
    __tsan_acquire(&begun);
    work(block);
    __tsan_release(&done);
  });
  __tsan_acquire(&done);
#else
  tbb::parallel_for_each(blocks, work);
#endif
}

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_DETAIL_PARALLEL_H
