// SPDX-License-Identifier: LGPL-3.0-or-later
// Blots: convex outlines of what casts, as seen from the light (Crow 1977, second class: the
// silhouette of an object is an "anti-window"; what lies within it and farther is in shadow).
#ifndef GNOMON_ALGORITHMS_BLOTS_BLOT_LIST_H
#define GNOMON_ALGORITHMS_BLOTS_BLOT_LIST_H

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/partition/chart_box.h"
#include "algorithms/partition/loop_store.h"
#include "kernel/signs/corner.h"

namespace gnomon {

using BlotId = std::uint32_t;  // ascending, front to back

struct Blot {
  static constexpr BlotId kNone = std::numeric_limits<BlotId>::max();
  std::uint32_t first_plane = 0, plane_count = 0;
  std::uint32_t first_loop = 0, loop_count = 0;
  std::uint32_t object = 0;  // whose outline it is
  std::uint32_t caster = 0;  // a part, or the number of parts and a solid
  BlotId next = kNone;       // of the same object
  bool alive = true;         // else absorbed
  ChartBox box;
};

/// The blots of one cell.
class BlotList {
 public:
  void clear(std::size_t objects) {
    blots_.clear();
    planes_.clear();
    loops_.clear();
    first_.assign(objects, Blot::kNone);
  }
  /// `planes`: of its outline, inside in front. `loops`: what of the object's faces is in it.
  BlotId add(Blot blot, std::span<const PlaneRef> planes, std::span<const LoopRange> loops) {
    const auto id = static_cast<BlotId>(blots_.size());
    blot.first_plane = static_cast<std::uint32_t>(planes_.size());
    blot.plane_count = static_cast<std::uint32_t>(planes.size());
    blot.first_loop = static_cast<std::uint32_t>(loops_.size());
    blot.loop_count = static_cast<std::uint32_t>(loops.size());
    planes_.insert(planes_.end(), planes.begin(), planes.end());
    loops_.insert(loops_.end(), loops.begin(), loops.end());
    blot.next = first_[blot.object];
    first_[blot.object] = id;
    blots_.push_back(blot);
    return id;
  }
  Blot& operator[](BlotId id) { return blots_[id]; }
  const Blot& operator[](BlotId id) const { return blots_[id]; }
  std::span<const PlaneRef> planes(BlotId id) const {
    return {planes_.data() + blots_[id].first_plane, blots_[id].plane_count};
  }
  std::span<const LoopRange> loops(BlotId id) const {
    return {loops_.data() + blots_[id].first_loop, blots_[id].loop_count};
  }
  /// Calls visit(id) for the living blots of an object.
  template <class Visit>
  void for_each_of(std::uint32_t object, const Visit& visit) const {
    for (BlotId id = first_[object]; id != Blot::kNone; id = blots_[id].next) {
      if (blots_[id].alive) visit(id);
    }
  }

 private:
  std::vector<Blot> blots_;
  std::vector<PlaneRef> planes_;
  std::vector<LoopRange> loops_;
  std::vector<BlotId> first_;  // by object
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BLOTS_BLOT_LIST_H
