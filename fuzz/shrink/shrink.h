// SPDX-License-Identifier: GPL-3.0-or-later
// Makes a scene that fails smaller while it fails alike: fewer polygons, lights and vertices, then
// flags at their defaults and coordinates of few bits, by a fixed list of steps, the most rewarding
// first, round after round until no step of the list helps.
//
// Coordinates stay within the range that those of the first scene have, and 0, axis by axis, unless
// asked otherwise: a skylight does not become a needle a million units long.
//
// Guarantees: the result fails (as far as the caller's predicate is a function of the scene); every
// scene kept is smaller than the one before (SceneSize, compared from its first member to its
// last), so that it ends; equal input gives equal output. There is no other state than the best
// scene: shrinking a scene that an interrupted run left goes on from there. Nothing that prepare()
// refuses is tried, and nothing twice.
//
// It does not search: the result is locally minimal, and another order may end in a smaller one.
#ifndef GNOMON_FUZZ_SHRINK_SHRINK_H
#define GNOMON_FUZZ_SHRINK_SHRINK_H

#include <atomic>
#include <compare>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

/// How large a scene is, as shrinking sees it: the first member that differs decides.
struct SceneSize {
  std::uint64_t polygons = 0, lights = 0, holes = 0;
  std::uint64_t corners = 0;   // of all loops, those of holes and area lights too
  std::uint64_t repairs = 0;   // loops that are not planar or not convex
  std::uint64_t vertices = 0;  // of the list, those that no loop names too
  std::uint64_t flags = 0;     // that are not at their default: two_sided, casts, numbers, ...
  std::uint64_t bits = 0;    // of all coordinates: mantissa, distance of the exponent from 0, sign
  std::uint64_t values = 0;  // distinct coordinates on each axis
  std::uint64_t names = 0;   // ids that are not the short ones

  friend auto operator<=>(const SceneSize&, const SceneSize&) = default;
};

SceneSize size_of(const Scene& scene);

/// 16 hexadecimal digits that tell scenes apart: of all but name and "extra" (FNV-1a of the JSON).
std::string fingerprint_of(const Scene& scene);

/// Says whether a scene fails as the first one did: true for the scene that comes in, and the
/// same whenever it is asked for the same scene.
using StillFails = std::function<bool(const Scene&)>;

struct ShrinkProgress {
  const Scene& best;
  const SceneSize& size;
  std::string_view pass;  // such as "corners"
  std::uint64_t tries = 0, accepted = 0;
  bool improved = false;  // by the last try
};

struct ShrinkOptions {
  /// Scenes to try first, the simplest first: the first that fails is what is shrunk. They need not
  /// be smaller.
  std::vector<Scene> simpler;
  std::function<void(const ShrinkProgress&)> progress;  // after every try; may be empty
  const std::atomic<bool>* interrupted = nullptr;       // checked before every try
  std::uint64_t most_tries = 0;                         // 0: as many as it takes
  double seconds = 0;                                   // wall clock; 0: as long as it takes
  bool free_range = false;                              // coordinates may leave the first's range
  const Scene* range_of = nullptr;  // whose range that is, if it is another scene's
};

/// One kind of step, over all rounds.
struct ShrinkPass {
  std::string_view name;
  std::uint64_t tries = 0, accepted = 0;
};

struct ShrinkResult {
  Scene scene;
  bool locally_minimal = false;  // a whole round without success; else it was stopped
  SceneSize before, after;
  std::uint64_t tries = 0;  // times that the predicate was asked
  std::uint64_t accepted = 0;
  std::uint64_t refused = 0;   // not asked: prepare() refuses the scene
  std::uint64_t repeated = 0;  // not asked: tried before
  std::uint64_t rounds = 0;
  std::vector<ShrinkPass> passes;  // in the order of a round
};

ShrinkResult shrink(Scene scene, const StillFails& fails, const ShrinkOptions& options = {});

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SHRINK_SHRINK_H
