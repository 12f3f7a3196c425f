// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work that several threads do.
#ifndef KINETRI_TRIANGULATION_DETAIL_PARALLEL_H
#define KINETRI_TRIANGULATION_DETAIL_PARALLEL_H

#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "kinetri/base/compiler.h"

namespace kinetri::detail {

/// Elements in blocks, each for one thread.
template <class Element>
std::vector<std::span<const Element>> blocks_of(std::span<const Element> elements,
                                                std::size_t size = 4096) {
  std::vector<std::span<const Element>> blocks;
  for (std::span<const Element> left = elements; !left.empty();) {
    blocks.push_back(left.first(std::min(size, left.size())));
    left = left.subspan(blocks.back().size());
  }
  return blocks;
}

/// Calls work(block) for each of the blocks, by as many threads as oneTBB lends; in this one, in
/// their order, where there is only one block.
template <class Block, class Work>
void for_each_in_parallel(std::vector<Block>& blocks, const Work& work) {
  if (blocks.size() == 1) return work(blocks.front());
  // ThreadSanitizer does not see into oneTBB's library, where work begins after what came before
  // the call, and what comes after the call begins after the work. The tag is global because a task
  // may read nothing of this thread, the function below included, before it has been told so.
  static char begun, done;
  const auto work_in_order = [&work](Block& block) {
    annotate_happens_after(&begun);
    work(block);
    annotate_happens_before(&done);
  };
  annotate_happens_before(&begun);
  tbb::parallel_for_each(blocks, work_in_order);
  annotate_happens_after(&done);
}

}  // namespace kinetri::detail

#endif  // KINETRI_TRIANGULATION_DETAIL_PARALLEL_H
