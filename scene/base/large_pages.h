// SPDX-License-Identifier: LGPL-3.0-or-later
// Large pages for large arrays: the first touch of each small page costs as much as reading some
// hundred bytes of a file.
#ifndef GNOMON_SCENE_BASE_LARGE_PAGES_H
#define GNOMON_SCENE_BASE_LARGE_PAGES_H

#include <cstddef>
#include <cstdint>
#include <vector>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace gnomon::scene_detail {

/// Asks the system for large pages under what lies wholly inside these bytes and was not touched
/// yet. A hint: it never fails.
inline void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t size) {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t kLargePage = std::uintptr_t{1} << 21;
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (address + kLargePage - 1) & ~(kLargePage - 1);
  const std::uintptr_t end = (address + size) & ~(kLargePage - 1);
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

/// Room for `count` elements, in large pages if they fill some.
template <class T>
void reserve_in_large_pages(std::vector<T>& elements, std::size_t count) {
  if (count <= elements.capacity()) return;
  elements.reserve(count);
  prefer_large_pages(elements.data(), elements.capacity() * sizeof(T));
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_BASE_LARGE_PAGES_H
