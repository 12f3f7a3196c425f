// SPDX-License-Identifier: GPL-3.0-or-later
//
// Work that several threads do. Only parallel.cpp includes oneTBB: its templates, instantiated for
// each piece of work, would take longer to compile than the work.
#ifndef KINETRI_IMPL_TRIANGULATION_PARALLEL_H
#define KINETRI_IMPL_TRIANGULATION_PARALLEL_H

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

/// How many of so many threads (0: those of oneTBB's arena) oneTBB lends here.
std::size_t usable_threads(std::size_t threads);

/// Calls work(). Two threads or more: no more than so many help in it. 0 and 1: those of oneTBB's
/// arena may help, as they may in the caller.
void call_with_threads(std::size_t threads, const std::function<void()>& work);

/// Calls work(k) for each k below the count, by as many threads as oneTBB lends; in this one if
/// the count is 1. What work throws is thrown once no thread works any more.
void for_each_index_in_parallel(std::size_t count, const std::function<void(std::size_t)>& work);

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

/// Calls work(block) for each of the blocks, in the same way.
template <class Block, class Work>
void for_each_in_parallel(std::vector<Block>& blocks, const Work& work) {
  for_each_index_in_parallel(blocks.size(), [&](std::size_t k) { work(blocks[k]); });
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_PARALLEL_H
