// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prefetching of the memory that an event will read.
#ifndef KINETRI_IMPL_TRIANGULATION_PREFETCH_H
#define KINETRI_IMPL_TRIANGULATION_PREFETCH_H

#include <cstddef>
#include <cstdint>

#include "kinetri/impl/base/compiler.h"

namespace kinetri::detail {

/// Prefetches a vertex, or the first cache line of a face, which has all but the hidden points.
template <class Handle>
KINETRI_ALWAYS_INLINE void prefetch(Handle handle) {
  constexpr std::size_t line = 64;
  prefetch_address(handle.operator->());
  if constexpr (requires { handle->point(); }) {
    const auto address = reinterpret_cast<std::uintptr_t>(handle.operator->());
    for (std::size_t i = line; i < sizeof(*handle); i += line) {
      prefetch_address(reinterpret_cast<const void*>(address + i));
    }
  }
}

/// Prefetches the vertices and the neighbors of a face.
template <class Face_handle>
KINETRI_ALWAYS_INLINE void prefetch_around(Face_handle face) {
  for (int i = 0; i < 3; ++i) {
    prefetch(face->vertex(i));
    prefetch(face->neighbor(i));
  }
}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_TRIANGULATION_PREFETCH_H
