// SPDX-License-Identifier: GPL-3.0-or-later
//
// Hints to ThreadSanitizer. Without it they do nothing.
#ifndef KINETRI_SRC_BASE_THREAD_SANITIZER_H
#define KINETRI_SRC_BASE_THREAD_SANITIZER_H

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

#endif  // KINETRI_SRC_BASE_THREAD_SANITIZER_H
