// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/heap.h"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#endif

namespace gnomon::cli {

#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)

namespace {

constexpr int kMebibyte = 1 << 20;
constexpr int kRoom = 1024 * kMebibyte;

bool is_limited(__rlimit_resource_t resource) {
  rlimit limit{};
  return ::getrlimit(resource, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY;
}

std::uintptr_t end_of_heap() { return reinterpret_cast<std::uintptr_t>(::sbrk(0)); }

/// Takes a block for good, though nobody touches it, and returns where the next one would begin.
std::uintptr_t set_aside(std::size_t bytes) {
  void* volatile block = std::malloc(bytes);  // volatile, so that compilers do not leave it out
  return reinterpret_cast<std::uintptr_t>(block) + ::malloc_usable_size(block);
}

}  // namespace

void prefer_a_heap_in_large_pages() {
  if (is_limited(RLIMIT_AS) || is_limited(RLIMIT_DATA)) return;
  // Larger arrays are mapped, each for itself; they are few.
  ::mallopt(M_MMAP_THRESHOLD, 32 * kMebibyte);
  ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());  // more than the room
  ::mallopt(M_TOP_PAD, kRoom);
  const std::uintptr_t begin = end_of_heap();
  // A block too large for what the heap has left, so that it grows.
  const std::uintptr_t behind = set_aside(kMebibyte);
  ::mallopt(M_TOP_PAD, 4 * kMebibyte);
  // The rest of the large page that was touched here. What follows begins with a large page.
  constexpr std::uintptr_t kLargePage = 2 * kMebibyte, kOwnBytes = 64;
  const std::uintptr_t rest = kLargePage - behind % kLargePage;
  if (rest > kOwnBytes) set_aside(rest - kOwnBytes);
  const std::uintptr_t end = end_of_heap();
  if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

#else

void prefer_a_heap_in_large_pages() {}

#endif

}  // namespace gnomon::cli
