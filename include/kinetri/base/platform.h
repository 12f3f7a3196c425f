// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stops the compilation with one clear message if the compiler is not set to C++20, or if the
// arithmetic of the platform is not that of the error bounds. Every public header includes this
// one, directly or by its first include.
#ifndef KINETRI_BASE_PLATFORM_H
#define KINETRI_BASE_PLATFORM_H

// Compilers continue after #error, but not after a missing header.
#if defined(_MSVC_LANG) ? _MSVC_LANG <= 201703L : __cplusplus <= 201703L
#error "Kinetri needs C++20; expected -std=c++20 or later (MSVC: /std:c++20)"
#include <kinetri_needs_cxx20>
#endif

// CGAL's Interval_nt and the error bounds of MATH.md, section 7, are wrong if the compiler may
// rewrite floating-point expressions.
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || defined(_M_FP_FAST)
#error "Kinetri needs exact rounding; compile without -ffast-math, -Ofast and their parts"
#include <kinetri_needs_exact_rounding>
#endif

// With x87 registers a result is rounded twice, and when depends on the optimizer.
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "Kinetri needs binary64 arithmetic; on 32-bit x86 compile with -msse2 -mfpmath=sse"
#include <kinetri_needs_binary64>
#endif
#if defined(__DBL_MANT_DIG__) && (__DBL_MANT_DIG__ != 53 || __DBL_MAX_EXP__ != 1024)
#error "Kinetri needs IEEE 754: double must be binary64"
#include <kinetri_needs_binary64>
#endif

#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "Kinetri's files are little-endian; big-endian machines are not supported"
#include <kinetri_needs_little_endian>
#endif

// WebAssembly rounds to nearest always, and CGAL's Interval_nt does not notice.
#if defined(__wasm__) && !defined(CGAL_ALWAYS_ROUND_TO_NEAREST)
#error \
    "On WebAssembly Kinetri needs -DCGAL_ALWAYS_ROUND_TO_NEAREST: rounding modes do nothing there"
#include <kinetri_needs_cgal_always_round_to_nearest>
#endif

#endif  // KINETRI_BASE_PLATFORM_H
