// SPDX-License-Identifier: LGPL-3.0-or-later
// Interning: numbers equal things 0, 1, 2, ... in the order in which they are first seen. The
// things stay with the caller; the table holds their numbers and hashes. Equality is always the
// caller's exact comparison, never the hash alone.
#ifndef GNOMON_SCENE_BASE_INDEX_TABLE_H
#define GNOMON_SCENE_BASE_INDEX_TABLE_H

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "scene/base/prefetch.h"

namespace gnomon::scene_detail {

class IndexTable {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  IndexTable() : slots_(64) {}

  /// Room for so many things. Requires: none was entered yet.
  void reserve(std::size_t expected) {
    std::size_t size = 64;
    while (size < 2 * expected) size *= 2;
    slots_.assign(size, Slot{});
  }
  /// Asks for the memory that find_or_enter() with this hash will look at first.
  void look_ahead(std::uint64_t hash) const {
    prefetch(&slots_[place(static_cast<std::uint32_t>(hash >> 32))]);
  }

  /// The number of an equal thing seen before, or kNone after `next` was entered for this one.
  /// `is_equal(i)` compares with thing i.
  template <class IsEqual>
  std::uint32_t find_or_enter(std::uint64_t hash, std::uint32_t next, IsEqual is_equal) {
    if (2 * count_ >= slots_.size()) grow();
    const auto short_hash = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t i = place(short_hash);; i = (i + 1) & (slots_.size() - 1)) {
      Slot& slot = slots_[i];
      if (slot.index == kNone) {
        slot = {next, short_hash};
        ++count_;
        return kNone;
      }
      if (slot.hash == short_hash && is_equal(slot.index)) return slot.index;
    }
  }

 private:
  struct Slot {
    std::uint32_t index = kNone;
    std::uint32_t hash = 0;
  };
  std::size_t place(std::uint32_t hash) const { return hash & (slots_.size() - 1); }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.index == kNone) continue;
      std::size_t i = place(slot.hash);
      while (slots_[i].index != kNone) i = (i + 1) & (slots_.size() - 1);
      slots_[i] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_BASE_INDEX_TABLE_H
