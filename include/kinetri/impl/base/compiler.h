// SPDX-License-Identifier: GPL-3.0-or-later
//
// The only installed header that uses compiler extensions: hints to the processor and to
// ThreadSanitizer. None changes what a program computes; with a compiler without such an extension
// they do nothing.
#ifndef KINETRI_IMPL_BASE_COMPILER_H
#define KINETRI_IMPL_BASE_COMPILER_H

#include <cstddef>

#include "kinetri/base/platform.h"

/// Begins the declaration of a function that is to be inlined at every call.
#if defined(__GNUC__) || defined(__clang__)
#define KINETRI_ALWAYS_INLINE [[gnu::always_inline]] inline
#elif defined(_MSC_VER)
#define KINETRI_ALWAYS_INLINE __forceinline
#else
#define KINETRI_ALWAYS_INLINE inline
#endif

#if defined(__SANITIZE_THREAD__)
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

/// Starts to load the memory at `address` into the cache. The address may be invalid. A function
/// that does nothing but prefetch must be KINETRI_ALWAYS_INLINE too: GCC removes calls of such a
/// function, since it sees no effect in them.
KINETRI_ALWAYS_INLINE void prefetch_address([[maybe_unused]] const void* address) {
#if defined(__GNUC__) || defined(__clang__)
  __builtin_prefetch(address);
#endif
}

template <class Object>
KINETRI_ALWAYS_INLINE void prefetch_object(const Object& object) {
  constexpr std::size_t line = 64;
  const auto* const begin = reinterpret_cast<const std::byte*>(&object);
  for (std::size_t i = 0; i < sizeof(Object); i += line) prefetch_address(begin + i);
  prefetch_address(begin + sizeof(Object) - 1);
}

/// @{
/// Tells ThreadSanitizer that what a thread did before it called annotate_happens_before(tag)
/// happens before what another thread does after it has called annotate_happens_after(tag). Needed
/// if a library that was built without ThreadSanitizer synchronizes the two.
inline void annotate_happens_before([[maybe_unused]] void* tag) {
#ifdef KINETRI_THREAD_SANITIZER
  __tsan_release(tag);
#endif
}
inline void annotate_happens_after([[maybe_unused]] void* tag) {
#ifdef KINETRI_THREAD_SANITIZER
  __tsan_acquire(tag);
#endif
}
/// @}

}  // namespace kinetri::detail

#endif  // KINETRI_IMPL_BASE_COMPILER_H
