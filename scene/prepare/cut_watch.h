// SPDX-License-Identifier: LGPL-3.0-or-later
// How far the polygons of a scene are, and whether to stop.
#ifndef GNOMON_SCENE_PREPARE_CUT_WATCH_H
#define GNOMON_SCENE_PREPARE_CUT_WATCH_H

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "gnomon/scene/prepare_control.h"

namespace gnomon::scene_detail {

/// Those of its holes and two more a hole, for its bridge, included.
inline std::size_t corners_of(const Polygon& polygon) {
  std::size_t corners = polygon.loop.size();
  for (const auto& hole : polygon.holes) corners += hole.size() + 2;
  return corners;
}

/// Shared by all threads of a preparation.
class SceneWatch {
 public:
  SceneWatch(const PrepareControl& control, std::uint64_t corners)
      : control_(control), corners_(std::max<std::uint64_t>(corners, 1)) {}

  bool stopped() const {
    return control_.interrupted != nullptr && control_.interrupted->load(std::memory_order_relaxed);
  }
  void add(std::uint64_t corners) {
    const std::uint64_t done = done_.fetch_add(corners, std::memory_order_relaxed) + corners;
    if (control_.progress) {
      control_.progress(static_cast<double>(done) / static_cast<double>(corners_));
    }
  }

 private:
  const PrepareControl& control_;
  std::uint64_t corners_;
  std::atomic<std::uint64_t> done_{0};
};

/// One polygon's share of it.
class CutWatch {
 public:
  CutWatch(SceneWatch& scene, std::uint64_t corners) : scene_(&scene), corners_(corners) {}

  bool stopped() const { return scene_->stopped(); }
  /// A fraction of the work on this polygon is done; small ones are not told piece by piece.
  void tell(double done) {
    constexpr std::uint64_t kLarge = 10'000;
    if (corners_ < kLarge) return;
    const auto reached = static_cast<std::uint64_t>(done * static_cast<double>(corners_));
    if (reached > told_) scene_->add(reached - told_);
    told_ = std::max(told_, reached);
  }

  /// Corners that stand for what has been told.
  std::uint64_t told() const { return told_; }

 private:
  SceneWatch* scene_;
  std::uint64_t corners_, told_ = 0;
};

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_PREPARE_CUT_WATCH_H
