// SPDX-License-Identifier: GPL-3.0-or-later
//
// The only installed header that uses compiler extensions: hints to the processor. None changes
// what a program computes; with a compiler without such an extension they do nothing.
#ifndef KINETRI_IMPL_BASE_COMPILER_H
#define KINETRI_IMPL_BASE_COMPILER_H

#include <cstddef>
#include <cstdint>

#include "kinetri/base/platform.h"

/// Begins the declaration of a function that is to be inlined at every call.
#if defined(__GNUC__) || defined(__clang__)
#define KINETRI_ALWAYS_INLINE [[gnu::always_inline]] inline
#elif defined(_MSC_VER)
#define KINETRI_ALWAYS_INLINE __forceinline
#else
#define KINETRI_ALWAYS_INLINE inline
#endif

namespace kinetri::detail {

/// Starts to load the memory at `address` into the cache. The address may be invalid. A function
/// that does nothing but prefetch must be KINETRI_ALWAYS_INLINE too: GCC removes calls of such a
/// function, since it sees no effect in them.
KINETRI_ALWAYS_INLINE void prefetch_address([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#endif
}

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

#endif  // KINETRI_IMPL_BASE_COMPILER_H
