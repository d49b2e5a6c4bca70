// SPDX-License-Identifier: LGPL-3.0-or-later
// Random integers that are the same on every machine and with every compiler: xoshiro256** seeded
// by splitmix64, and distributions of our own (the standard library leaves its own unspecified). No
// floating-point arithmetic is used.
#ifndef GNOMON_SCENE_BASE_RANDOM_H
#define GNOMON_SCENE_BASE_RANDOM_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace gnomon {

class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {  // splitmix64
      std::uint64_t z = (seed += 0x9e3779b97f4a7c15u);
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
      word = z ^ (z >> 31);
    }
  }

  /// 64 random bits.
  std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Uniform in [0, bound). Requires: bound > 0.
  std::uint64_t below(std::uint64_t bound) {
    const std::uint64_t excess =
        (0 - bound) % bound;  // 2^64 mod bound: values below it are drawn again
    for (;;) {
      const std::uint64_t value = next();
      if (value >= excess) return value % bound;
    }
  }

  /// Uniform in [low, high]. Requires: low <= high.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low) + 1));
  }

  /// True in `part` of `whole` cases.
  bool chance(std::uint64_t part, std::uint64_t whole) { return below(whole) < part; }

  template <class T>
  void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  std::uint64_t state_[4];
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_RANDOM_H
