// SPDX-License-Identifier: GPL-3.0-or-later
//
// The two tiers of checks that throw. The third tier, audits, returns a report instead
// (kinetri/triangulation/audit.h).
//
//   KINETRI_PRECONDITION(condition, message)  the caller's duty; always on; throws
//   Precondition_error KINETRI_ASSERT(condition, message)        our own invariant; always on;
//   throws Internal_error
//
// The message says what is wrong and, if necessary, what to do instead; a std::string is made only
// when the check fails.
//
// Both are for conditions that are cheap compared with the work they guard.
#ifndef KINETRI_IMPL_BASE_CHECK_H
#define KINETRI_IMPL_BASE_CHECK_H

#include <string>

#include "kinetri/base/platform.h"

namespace kinetri::detail {

[[noreturn]] void precondition_failed(const char* condition, const char* message, const char* file,
                                      int line);
[[noreturn]] inline void precondition_failed(const char* condition, const std::string& message,
                                             const char* file, int line) {
  precondition_failed(condition, message.c_str(), file, line);
}
[[noreturn]] void assertion_failed(const char* condition, const char* message, const char* file,
                                   int line);

}  // namespace kinetri::detail

/// Throws Precondition_error, with the condition, the message, the file and the line, if the
/// condition is false.
#define KINETRI_PRECONDITION(condition, message) \
  ((condition) ? static_cast<void>(0)            \
               : ::kinetri::detail::precondition_failed(#condition, message, __FILE__, __LINE__))

/// Throws Internal_error likewise.
#define KINETRI_ASSERT(condition, message) \
  ((condition) ? static_cast<void>(0)      \
               : ::kinetri::detail::assertion_failed(#condition, message, __FILE__, __LINE__))

#endif  // KINETRI_IMPL_BASE_CHECK_H
