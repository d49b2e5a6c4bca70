// SPDX-License-Identifier: LGPL-3.0-or-later
// On which sides of support planes vertices or parts lie, and which vertices are on the lines of
// edges, where integers had to tell: mostly on them, as the corners of a wall are on the ground and
// those of houses in a row on one line. No light changes that, so that what one light has asked for
// is known for all that follow.
//
// Guarantee: what is kept is exact, so that it changes the time and no answer, whichever lights
// come before. Threads may share it: an entry is one word, which is read and written at once.
#ifndef GNOMON_ALGORITHMS_CONTOUR_SCENE_MEMO_H
#define GNOMON_ALGORITHMS_CONTOUR_SCENE_MEMO_H

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace gnomon {

class SceneMemo {
 public:
  /// For a scene of so many parts: one to two words for each. No page of them is touched before
  /// something is kept in it, as few scenes need them all.
  explicit SceneMemo(std::size_t parts)
      : mask_(std::bit_ceil(std::clamp<std::size_t>(parts, 1u << 8, 1u << 20)) - 1),
        words_(static_cast<std::uint64_t*>(std::calloc(mask_ + 1, sizeof(std::uint64_t)))) {
    if (!words_) throw std::bad_alloc();
  }

  /// What find() gives, which is the same in every light: 1, 2 or 3, or 0, which is not kept.
  template <class Find>
  unsigned value(std::uint32_t one, std::uint32_t other, const Find& find) {
    if ((one | other) >> kBits != 0) return find();
    const std::uint64_t key = (std::uint64_t{one} << kBits | other) << 2;
    // What is near in the scene has near numbers, and is asked for together.
    const std::atomic_ref<std::uint64_t> word(words_[(one * 0x9e3779b9u + other) & mask_]);
    const std::uint64_t known = word.load(std::memory_order_relaxed);
    if ((known ^ key) - 1 < 3) return static_cast<unsigned>(known & 3);
    const unsigned value = find();
    if (value != 0) word.store(key | value, std::memory_order_relaxed);
    return value;
  }

 private:
  static constexpr unsigned kBits = 31;  // of a number: two of them and a value are a word

  struct Free {
    void operator()(std::uint64_t* words) const { std::free(words); }
  };
  std::size_t mask_;
  std::unique_ptr<std::uint64_t[], Free> words_;  // the value in the lowest bits; 0: nothing yet
};

/// Those of a scene.
struct SceneMemos {
  explicit SceneMemos(std::size_t part_count)
      : vertices(part_count), parts(part_count), lines(part_count) {}
  SceneMemo vertices, parts;  // against support planes
  SceneMemo lines;            // vertices against lines of edges
};

/// Whether a polygon has corners that are nearer to the light than a plane, and such that are
/// behind it.
struct SidesOfPlane {
  bool nearer = false, behind = false;

  bool both() const { return nearer && behind; }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_SCENE_MEMO_H
