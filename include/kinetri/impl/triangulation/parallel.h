// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work on several threads. Of the library only src/triangulation/parallel.cpp includes oneTBB,
// whose templates are slow to compile.
#ifndef KINETRI_IMPL_TRIANGULATION_PARALLEL_H
#define KINETRI_IMPL_TRIANGULATION_PARALLEL_H

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// How many of `threads` threads (0: those of oneTBB's arena) oneTBB allows.
std::size_t usable_threads(std::size_t threads);

/// Calls work(), in which at most `threads` threads help if `threads` is 2 or more, else those of
/// the caller's arena.
void call_with_threads(std::size_t threads, const std::function<void()>& work);

/// Calls work(k) for each k below `count` on the threads of oneTBB; on this thread if `count` is 1.
/// An exception is rethrown after all threads have finished.
void for_each_index_in_parallel(std::size_t count, const std::function<void(std::size_t)>& work);

/// Divides elements into blocks, each for one thread.
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

/// Calls work(block) for each of the blocks, in the same way.
template <class Block, class Work>
void for_each_in_parallel(std::vector<Block>& blocks, const Work& work) {
  for_each_index_in_parallel(blocks.size(), [&](std::size_t k) { work(blocks[k]); });
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_PARALLEL_H
