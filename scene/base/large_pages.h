// SPDX-License-Identifier: LGPL-3.0-or-later
// Large pages for large arrays: a page that is touched for the first time costs more than reading
// a thousand bytes of a file, and one large page hardly more than a hundred small ones.
#ifndef GNOMON_SCENE_BASE_LARGE_PAGES_H
#define GNOMON_SCENE_BASE_LARGE_PAGES_H

#include <cstddef>
#include <cstdint>
#include <vector>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace gnomon::scene_detail {

inline constexpr std::size_t kLargePage = std::size_t{1} << 21;

/// Asks the system for large pages under these bytes, which were just allocated and not touched. A
/// hint: it never fails.
inline void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t size) {
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t kSmallPage = std::uintptr_t{1} << 12;
  if (size < kLargePage) return;
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = address & ~(kSmallPage - 1);
  const std::uintptr_t end = (address + size + kSmallPage - 1) & ~(kSmallPage - 1);
  madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

/// Room for `count` elements, in large pages if they fill some.
template <class T>
void reserve_in_large_pages(std::vector<T>& elements, std::size_t count) {
  if (count <= elements.capacity()) return;
  elements.reserve(count);
  prefer_large_pages(elements.data(), elements.capacity() * sizeof(T));
}

/// `count` elements, in large pages if they fill some.
template <class T>
void resize_in_large_pages(std::vector<T>& elements, std::size_t count) {
  reserve_in_large_pages(elements, count);
  elements.resize(count);
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_BASE_LARGE_PAGES_H
