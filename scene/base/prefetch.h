// SPDX-License-Identifier: LGPL-3.0-or-later
// A hint for loops that visit memory at random.
#ifndef GNOMON_SCENE_BASE_PREFETCH_H
#define GNOMON_SCENE_BASE_PREFETCH_H

namespace gnomon::scene_detail {

/// Asks for the memory at `address` to be in the cache soon; any address will do.
inline void prefetch(const void* address) {
  __builtin_prefetch(address);
  // GCC takes a function that only prefetches for one without effects, and drops calls to it.
  __asm__ volatile("");
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_BASE_PREFETCH_H
