// SPDX-License-Identifier: LGPL-3.0-or-later
// Crow 1977, first class, after Bouknight & Kelley: for every polygon the list of those that may
// shadow it, made before the picture is scanned out. A polygon O is on the list of R if it faces
// the light, is not behind R's plane everywhere, and its outline overlaps R's as the light sees
// them.
//
// Which pairs are asked is the method's choice: all of them, N^2; those whose outlines share a
// leaf of a tree of boxes, S (N / S)^2 of S sectors in the paper's terms; or those that share a
// tile. The answer is the same.
//
// Exactness: outlines overlap unless an edge plane of one of the two separates them, by the signs
// of the space; a list may be too long, never too short.
#ifndef GNOMON_ALGORITHMS_SCAN_OUT_OVERLAP_LISTS_H
#define GNOMON_ALGORITHMS_SCAN_OUT_OVERLAP_LISTS_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/box_tree.h"
#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/part_balls.h"
#include "algorithms/scan_out/direction_tiles.h"
#include "gnomon/algorithms/method_options.h"

namespace gnomon {

template <ImageSpaceModel Space>
class OverlapLists {
 public:
  /// Of every part that faces a light, or with `visible` of those among them that it says are.
  OverlapLists(ImageScene<Space>& scene, const PartBalls& balls, ListsBy by,
               const std::vector<bool>* visible)
      : scene_(scene), balls_(balls) {
    for (std::size_t l = 0; l < scene.light_count(); ++l) make(l, by, visible);
  }

  std::span<const std::uint32_t> of(std::uint32_t part, std::size_t l) const {
    const OfLight& own = lights_[l];
    return std::span(own.casters).subspan(own.first[part], own.first[part + 1] - own.first[part]);
  }
  /// Adds what was done.
  void count(WorkCounts& work) const {
    work[Counter::kOverlapTests] += tests_;
    work[Counter::kTileWrites] += tile_writes_;
    for (const OfLight& own : lights_) {
      work[Counter::kListEntries] += own.casters.size();
      work.at_least(Counter::kLongestList, own.longest);
    }
    std::uint64_t bytes = 0;
    for (const OfLight& own : lights_) {
      bytes += sizeof(std::uint32_t) * (own.casters.size() + own.first.size());
    }
    work.at_least(Counter::kListBytes, bytes);
  }

 private:
  struct OfLight {
    std::vector<std::uint32_t> casters;  // part after part
    std::vector<std::uint32_t> first;    // by part, and the end
    std::uint64_t longest = 0;
  };

  void make(std::size_t l, ListsBy by, const std::vector<bool>* visible) {
    const std::vector<Part>& parts = scene_.scene().parts;
    std::vector<std::uint32_t> casters;
    std::vector<Box> boxes;
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
      if (parts[p].casts && scene_.facing_light(p, l).valid()) casters.push_back(p);
      if (by != ListsBy::kAll) boxes.push_back(balls_.outline(scene_.light_point(l), p));
    }
    BoxTree tree;
    DirectionTiles tiles({}, {}, 1);
    if (by == ListsBy::kSectors) tree = BoxTree(boxes, casters);
    if (by == ListsBy::kTiles) tiles = DirectionTiles(boxes, casters, kTiles);
    tile_writes_ += tiles.writes();
    OfLight own;
    own.first.push_back(0);
    std::vector<std::uint32_t> asked;
    for (std::uint32_t p = 0; p < parts.size(); ++p) {
      if (scene_.facing_light(p, l).valid() && (visible == nullptr || (*visible)[p])) {
        asked.clear();
        if (by == ListsBy::kAll) asked = casters;
        if (by == ListsBy::kSectors) find(tree, boxes[p], asked);
        if (by == ListsBy::kTiles) tiles.find(boxes[p], asked);
        tests_ += asked.size();
        for (const std::uint32_t caster : asked) {
          if (overlaps(caster, p, l)) own.casters.push_back(caster);
        }
      }
      own.longest = std::max<std::uint64_t>(own.longest, own.casters.size() - own.first.back());
      own.first.push_back(static_cast<std::uint32_t>(own.casters.size()));
    }
    lights_.push_back(std::move(own));
  }

  static bool meet(const Box& a, const Box& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (a.high[k] < b.low[k] || b.high[k] < a.low[k]) return false;
    }
    return true;
  }
  static void find(const BoxTree& tree, const Box& box, std::vector<std::uint32_t>& found) {
    tree.find([&](const BoxTree::Node& node, std::uint32_t) { return meet(node.box, box); },
              [&](std::uint32_t caster) { return meet(tree.box(caster), box); }, found);
    std::ranges::sort(found);  // so that no list depends on the tree
  }

  bool overlaps(std::uint32_t caster, std::uint32_t part, std::size_t l) {
    const PlaneRef own = scene_.facing_light(part, l), other = scene_.facing_light(caster, l);
    // Coplanar parts do not shadow each other.
    return !own.same_plane(other) && !balls_.are_apart(scene_.light_point(l), caster, part) &&
           reaches(caster, own, Side::kFront) && reaches(part, other, Side::kBack) &&
           !separates(caster, part, l) && !separates(part, caster, l);
  }
  /// Is all of `other` outside of an edge of `part`, as the light sees them?
  bool separates(std::uint32_t part, std::uint32_t other, std::size_t l) {
    const std::size_t edges = scene_.scene().parts[part].count;
    for (std::size_t k = 0; k < edges; ++k) {
      if (!reaches(other, scene_.shadow_plane(part, k, l), Side::kFront)) return true;
    }
    return false;
  }
  /// Is a vertex of the part on that side?
  bool reaches(std::uint32_t part, PlaneRef plane, Side side) {
    return std::ranges::any_of(scene_.scene().loop(scene_.scene().parts[part]), [&](VertexId v) {
      return scene_.space().side_of_vertex(plane, v) == side;
    });
  }

  static constexpr std::uint32_t kTiles = 32;  // to a side

  ImageScene<Space>& scene_;
  const PartBalls& balls_;
  std::vector<OfLight> lights_;
  std::uint64_t tests_ = 0, tile_writes_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SCAN_OUT_OVERLAP_LISTS_H
