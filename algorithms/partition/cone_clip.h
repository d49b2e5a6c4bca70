// SPDX-License-Identifier: LGPL-3.0-or-later
// What of a loop is inside a cone of planes through the light: one piece inside all of them, and
// the pieces that each plane cuts off.
//
// Guarantee on exact kernels: the pieces tile the loop, and nothing is cut in vain: if no area is
// inside all planes, the loop stays whole.
#ifndef GNOMON_ALGORITHMS_PARTITION_CONE_CLIP_H
#define GNOMON_ALGORITHMS_PARTITION_CONE_CLIP_H

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/split.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

enum class ConePlace : std::uint8_t {
  kOutside,  // no area is inside all planes
  kInside,   // all of it is
  kCut,      // `inside` is, `outside` is not
};

/// Keeps its workspace and the pieces of the last cut.
template <DecisionSpace Space>
class ConeClip {
 public:
  using Vertex = typename Space::Vertex;

  /// The pieces are appended to `loops`, where `loop` is, too. `support`: of the loop's part.
  ConePlace clip(Space& space, std::span<const PlaneRef> planes, const LoopRange& loop,
                 PlaneId support, LoopStore<Vertex>& loops) {
    spanning_.clear();
    outside_.clear();
    inside_ = loop;
    for (const PlaneRef plane : planes) {
      SplitRecord& record = spanning_.empty() ? first_record_ : record_;
      switch (record.decide(space, plane, loops.view(loop, support))) {
        case Placement::kFront:
          break;
        case Placement::kSpanning:
          spanning_.push_back(plane);
          break;
        case Placement::kBack:
        case Placement::kOn:
          return ConePlace::kOutside;
      }
    }
    if (spanning_.empty()) return ConePlace::kInside;
    const std::uint32_t mark = loops.size();
    for (std::size_t i = 0; i < spanning_.size(); ++i) {
      const PlaneRef plane = spanning_[i];
      const SplitRecord& record = i == 0 ? first_record_ : record_;
      if (i > 0) {
        const Placement placement = record_.decide(space, plane, loops.view(inside_, support));
        if (placement == Placement::kFront) continue;
        // Some of the loop is inside each plane, none inside all.
        if (placement != Placement::kSpanning) {
          loops.truncate(mark);
          return ConePlace::kOutside;
        }
      }
      ++cuts_;
      loops.reserve_more(2 * std::size_t{inside_.count} + 4);
      const SplitChildren pieces =
          make_children(space, plane, loops.view(inside_, support), record, crossings_, loops);
      if (pieces.back.count >= 3) {
        outside_.push_back(pieces.back);
      } else {
        ++vanished_;
      }
      inside_ = pieces.front;
      if (inside_.count < 3) {
        ++vanished_;
        break;
      }
    }
    return ConePlace::kCut;
  }

  /// Of the last loop that was inside or cut; fewer than three vertices: vanished (rounded
  /// kernels).
  const LoopRange& inside() const { return inside_; }
  std::span<const LoopRange> outside() const { return outside_; }
  /// Cuts by a plane so far.
  std::uint64_t cuts() const { return cuts_; }
  /// Children with fewer than three vertices that were dropped since the last call (rounded
  /// kernels).
  std::uint64_t take_vanished() { return std::exchange(vanished_, 0); }

 private:
  std::vector<PlaneRef> spanning_;
  std::vector<LoopRange> outside_;
  LoopRange inside_;
  SplitRecord first_record_, record_;
  std::vector<Vertex> crossings_;
  std::uint64_t cuts_ = 0, vanished_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_CONE_CLIP_H
