// SPDX-License-Identifier: LGPL-3.0-or-later
// End caps of shadow volumes (Chin & Feiner 1992, "Discussion": a penumbra may end where it matters
// no more). Here a volume ends where it reaches no receiver any more, and nowhere else: caps are a
// cull, and no class depends on them. They are axis planes around the boxes of all receivers that
// may be in the volume; one that reaches no receiver is left out.
//
// Guarantee: every receiver that has a point inside of the volume is strictly inside of its caps:
// they are put outside of boxes by more than all rounding.
#ifndef GNOMON_ALGORITHMS_VOLUME_TREES_END_CAPS_H
#define GNOMON_ALGORITHMS_VOLUME_TREES_END_CAPS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/box.h"
#include "algorithms/partition/box_tree.h"
#include "algorithms/volume_trees/polyhedron.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// Where a volume ends.
struct VolumeEnd {
  bool reaches_nothing = false;
  std::vector<PlaneRef> caps;  // inside in front
};

class EndCaps {
 public:
  /// `box(part)`: of a receiver, in fractions of the grid's extent.
  template <class BoxOf>
  EndCaps(std::size_t parts, std::span<const std::uint32_t> receivers, const BoxOf& box) {
    std::vector<Box> boxes(parts);
    for (const std::uint32_t part : receivers) boxes[part] = box(part);
    receivers_ = BoxTree(std::move(boxes), {receivers.begin(), receivers.end()});
  }

  /// Adds the planes to the space. `caster` receives no shadow of its own.
  template <VolumeSpaceModel Space>
  VolumeEnd end_of(Space& space, const Polyhedron<typename Space::Vertex>& volume,
                   std::uint32_t caster) {
    if (volume.empty()) return {.reaches_nothing = true, .caps = {}};
    const std::optional<Box> whole = box_of(space, volume);
    if (!whole) return {};
    const auto may_meet = [&](const Box& box) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (box.low[k] > whole->high[k] + kMargin || box.high[k] < whole->low[k] - kMargin) {
          return false;
        }
      }
      return true;
    };
    found_.clear();
    receivers_.find(
        [&](const BoxTree::Node& node, std::uint32_t) { return may_meet(node.box); },
        [&](std::uint32_t part) { return part != caster && may_meet(receivers_.box(part)); },
        found_);
    if (found_.empty()) return {.reaches_nothing = true, .caps = {}};
    Box reached;
    for (const std::uint32_t part : found_) reached.add(receivers_.box(part));
    VolumeEnd end;
    for (std::size_t k = 0; k < 3; ++k) {
      const int axis = static_cast<int>(k);
      // Short numbers make short planes.
      const double low = (std::floor(reached.low[k] * kSteps) - 1) / kSteps;
      const double high = (std::ceil(reached.high[k] * kSteps) + 1) / kSteps;
      if (low > 0 && low > whole->low[k]) end.caps.push_back(space.add_axis_plane(axis, low));
      if (high < 1 && high < whole->high[k]) end.caps.push_back(-space.add_axis_plane(axis, high));
    }
    return end;
  }

 private:
  /// Boxes of receivers are off by 2^-53 (caster_tree.h).
  static constexpr double kMargin = 1e-12;
  /// Caps stand at multiples of one over this, a whole step or more outside of what they hold.
  static constexpr double kSteps = 0x1p16;

  /// None where a corner is not known.
  template <class Space>
  static std::optional<Box> box_of(const Space& space,
                                   const Polyhedron<typename Space::Vertex>& volume) {
    Box box;
    for (const PolyhedronFace& face : volume.faces) {
      for (std::uint32_t i = 0; i < face.count; ++i) {
        const std::array<Ball, 3> corner = space.position(volume.corner(face, i));
        std::array<double, 3> low{}, high{};
        for (std::size_t k = 0; k < 3; ++k) {
          if (!corner[k].is_finite()) return std::nullopt;
          low[k] = corner[k].lower();
          high[k] = corner[k].upper();
        }
        box.add(low);
        box.add(high);
      }
    }
    return box;
  }

  BoxTree receivers_;
  std::vector<std::uint32_t> found_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_VOLUME_TREES_END_CAPS_H
