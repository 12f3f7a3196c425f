// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exact number of bytes that a program has allocated and not freed, by operator new and by GMP,
// which does not use it. Also lets an allocation fail. To be included in one source file of a
// program.
#ifndef KINETRI_TEST_SUPPORT_LIVE_BYTES_H
#define KINETRI_TEST_SUPPORT_LIVE_BYTES_H

#include <gmp.h>
#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace kinetri::test {

inline std::atomic<std::size_t> live_byte_count = 0;

/// The number of allocations by operator new before one fails; negative: none fails.
inline std::atomic<std::int64_t> allocations_before_failure = -1;

inline void count_allocation() {
  if (allocations_before_failure >= 0 && allocations_before_failure-- == 0) throw std::bad_alloc();
}

inline void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  live_byte_count += malloc_usable_size(memory);
  return memory;
}

inline void free_counted(void* memory) {
  live_byte_count -= malloc_usable_size(memory);
  std::free(memory);
}

/// The bytes of operator new since the start, and those of GMP since the first call.
inline std::size_t live_bytes() {
  static const bool counts_gmp = [] {
    mp_set_memory_functions([](std::size_t size) { return counted(std::malloc(size)); },
                            [](void* memory, std::size_t, std::size_t size) {
                              live_byte_count -= malloc_usable_size(memory);
                              return counted(std::realloc(memory, size));
                            },
                            [](void* memory, std::size_t) { free_counted(memory); });
    return true;
  }();
  static_cast<void>(counts_gmp);
  return live_byte_count;
}

}  // namespace kinetri::test

void* operator new(std::size_t size) {
  kinetri::test::count_allocation();
  return kinetri::test::counted(std::malloc(size));
}
// As the standard library's, which sanitizers replace.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto a = static_cast<std::size_t>(alignment);
  return kinetri::test::counted(std::aligned_alloc(a, (size + a - 1) / a * a));
}
void operator delete(void* memory) noexcept {
  kinetri::test::free_counted(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  kinetri::test::free_counted(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  kinetri::test::free_counted(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  kinetri::test::free_counted(memory);
}

#endif  // KINETRI_TEST_SUPPORT_LIVE_BYTES_H
