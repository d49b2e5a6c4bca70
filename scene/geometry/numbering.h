// SPDX-License-Identifier: LGPL-3.0-or-later
// Interning of many things at once, on all cores: equal things get one number, 0, 1, 2, ... in the
// order in which they first occur. Equality is always the caller's exact comparison, never the hash
// alone.
//
// All things are entered into one open hash table whose slots hold the index of a thing and a part
// of its hash. Who finds an equal thing in a slot lowers the slot's index to its own if that is
// smaller. So in the end a slot holds the smallest index of its class, whatever the order in which
// threads came, and numbers that follow the order of these do not depend on the number of threads.
#ifndef GNOMON_SCENE_GEOMETRY_NUMBERING_H
#define GNOMON_SCENE_GEOMETRY_NUMBERING_H

#include <atomic>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "scene/base/large_pages.h"
#include "scene/base/parallel.h"
#include "scene/base/prefetch.h"

namespace gnomon::scene_detail {

class Numbering {
 public:
  /// Numbers the things 0 .. n-1. Requires: n < 2^32 - 1; hash(i) equal for equal things;
  /// equal(i, j) an equivalence; both may be called by several threads at a time.
  template <class Hash, class Equal>
  Numbering(std::size_t n, const Hash& hash, const Equal& equal) {
    resize_in_large_pages(number_, n);
    first_of_equal(hash, equal);
    number_in_order();
  }

  std::uint32_t operator[](std::size_t thing) const { return number_[thing]; }
  /// How many different things there are.
  std::uint32_t count() const { return count_; }

  /// Calls f(i, number of i), in parallel, for the first thing of each number.
  template <class F>
  void for_each_first(const F& f) const {
    for_each_piece(number_.size(), kPieceOfCheapElements, [&](std::size_t begin, std::size_t end) {
      // A thing is the first of its number if and only if all smaller numbers came before it.
      std::uint32_t next = numbers_before_[begin / kPieceOfCheapElements];
      for (std::size_t i = begin; i < end; ++i) {
        if (number_[i] == next) f(i, next++);
      }
    });
  }

 private:
  /// A slot is 0 (empty) or (upper half of the hash) * 2^32 + index + 1.
  using Slot = std::uint64_t;
  static constexpr Slot kUpperHalf = 0xffffffff00000000u;
  static std::uint32_t index_of(Slot slot) { return static_cast<std::uint32_t>(slot) - 1; }

  struct Free {
    void operator()(Slot* slots) const { std::free(slots); }
  };
  using Slots = std::unique_ptr<Slot, Free>;

  /// Empty slots: zeros that the system gives page by page, so that all threads share the cost of
  /// touching them, and in large pages if it can, for they are visited at random.
  static Slots empty_slots(std::size_t count) {
    Slots slots(static_cast<Slot*>(std::calloc(count, sizeof(Slot))));
    if (slots == nullptr) throw std::bad_alloc();
    prefer_large_pages(slots.get(), count * sizeof(Slot));
    return slots;
  }

  /// Every bit of the result depends on all bits of h.
  static std::uint64_t spread(std::uint64_t h) {
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93u;
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93u;
    return h ^ (h >> 32);
  }

  /// number_[i] = the smallest index of a thing equal to i.
  template <class Hash, class Equal>
  void first_of_equal(const Hash& hash, const Equal& equal) {
    const std::size_t n = number_.size();
    const std::size_t mask =
        std::min(std::bit_ceil(n + n / 3 + 1), std::size_t{1} << 32) - 1;  // a place has 32 bits
    const Slots slots = empty_slots(mask + 1);

    const auto enter = [&](std::uint32_t thing, std::uint64_t h) {
      const Slot mine = (h & kUpperHalf) | (thing + 1u);
      for (std::size_t place = h & mask;; place = (place + 1) & mask) {
        const std::atomic_ref<Slot> slot(slots.get()[place]);
        Slot found = slot.load(std::memory_order_relaxed);
        if (found == 0 && slot.compare_exchange_strong(found, mine, std::memory_order_relaxed)) {
          return static_cast<std::uint32_t>(place);
        }
        if (((found ^ mine) & kUpperHalf) != 0 || !equal(index_of(found), thing)) continue;
        while (found > mine &&
               !slot.compare_exchange_weak(found, mine, std::memory_order_relaxed)) {
        }
        return static_cast<std::uint32_t>(place);
      }
    };
    // A block of hashes first, so that the table's memory is on its way when it is asked for.
    constexpr std::size_t kBlock = 32;
    for_each_piece(n, kPieceOfCheapElements, [&](std::size_t begin, std::size_t end) {
      std::uint64_t hashes[kBlock];
      for (std::size_t block = begin; block < end; block += kBlock) {
        const std::size_t size = std::min(kBlock, end - block);
        for (std::size_t k = 0; k < size; ++k) {
          hashes[k] = spread(hash(block + k));
          prefetch(slots.get() + (hashes[k] & mask));
        }
        for (std::size_t k = 0; k < size; ++k) {
          number_[block + k] = enter(static_cast<std::uint32_t>(block + k), hashes[k]);
        }
      }
    });
    for_each_index(n, [&](std::size_t i) { number_[i] = index_of(slots.get()[number_[i]]); });
  }

  void number_in_order() {
    numbers_before_.reserve(piece_count(number_.size(), kPieceOfCheapElements));
    for (std::size_t i = 0; i < number_.size(); ++i) {
      if (i % kPieceOfCheapElements == 0) numbers_before_.push_back(count_);
      // The first of its kind precedes i and has its number already.
      number_[i] = number_[i] == i ? count_++ : number_[number_[i]];
    }
  }

  std::vector<std::uint32_t> number_;
  std::vector<std::uint32_t> numbers_before_;  // per piece: numbers of things before it
  std::uint32_t count_ = 0;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_GEOMETRY_NUMBERING_H
