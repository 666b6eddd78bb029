#pragma once

// Counts allocations of the whole program, those of libraries included, by standing in for the C library's functions.
// To be included by one source of a test program. Sanitizers have stand-ins of their own: then nothing is counted.

#include <cstddef>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__)
#define HERSEY_COUNTS_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HERSEY_COUNTS_ALLOCATIONS 0
#endif
#endif
#if !defined(HERSEY_COUNTS_ALLOCATIONS) && defined(__GLIBC__)
#define HERSEY_COUNTS_ALLOCATIONS 1
#endif
#ifndef HERSEY_COUNTS_ALLOCATIONS
#define HERSEY_COUNTS_ALLOCATIONS 0
#endif

namespace hersey::test {

inline long allocations = 0;  // since the program began

constexpr bool counts_allocations = HERSEY_COUNTS_ALLOCATIONS == 1;

}  // namespace hersey::test

#if HERSEY_COUNTS_ALLOCATIONS
#define HERSEY_VISIBLE __attribute__((visibility("default")))  // shared libraries are to see it
extern "C" {

void* __libc_malloc(std::size_t);                 // NOLINT: glibc's names
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT
void* __libc_realloc(void*, std::size_t);         // NOLINT
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT

HERSEY_VISIBLE void* malloc(std::size_t size) noexcept {  // NOLINT
  ++hersey::test::allocations;
  return __libc_malloc(size);
}
HERSEY_VISIBLE void* calloc(std::size_t count, std::size_t size) noexcept {  // NOLINT
  ++hersey::test::allocations;
  return __libc_calloc(count, size);
}
HERSEY_VISIBLE void* realloc(void* block, std::size_t size) noexcept {  // NOLINT
  ++hersey::test::allocations;
  return __libc_realloc(block, size);
}
HERSEY_VISIBLE void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {  // NOLINT
  ++hersey::test::allocations;
  return __libc_memalign(alignment, size);
}
}
#endif
