// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stops a compiler that is not set to C++20, with one message instead of hundreds. Every public
// header includes this one, itself or by way of the first that it includes.
#ifndef KINETRI_BASE_CXX20_H
#define KINETRI_BASE_CXX20_H

#if defined(_MSVC_LANG) ? _MSVC_LANG <= 201703L : __cplusplus <= 201703L
#error "Kinetri needs C++20; expected -std=c++20 or later (MSVC: /std:c++20)"
// Compilers go on after #error, but not after a header that does not exist.
#include <kinetri_needs_cxx20>
#endif

#endif  // KINETRI_BASE_CXX20_H
