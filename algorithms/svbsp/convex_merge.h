// SPDX-License-Identifier: LGPL-3.0-or-later
// Fragments of one part and class that share a whole edge become one where the result is convex,
// whatever cut them apart (Chin & Feiner 1989, sec. 6; Slater 1992, figure 6): at both ends of the
// edge the next vertex of the one is not behind the edge of the other. Greedily, in the order of
// fragments and their edges.
//
// The witness of what came of two: a caster of either that shadows all of it, else a smallest set
// of theirs that does.
//
// Exactness: the kernel's decisions, of degree 6 as all sides of vertices. Where a rounded kernel
// finds no single caster, the two stay apart.
#ifndef GNOMON_ALGORITHMS_SVBSP_CONVEX_MERGE_H
#define GNOMON_ALGORITHMS_SVBSP_CONVEX_MERGE_H

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algorithms/lights/light_scene.h"
#include "algorithms/partition/classified_loop.h"
#include "algorithms/partition/cone_clip.h"
#include "algorithms/partition/depth.h"

namespace gnomon {

template <SectorSpaceModel Space>
class ConvexMerge {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  explicit ConvexMerge(LightScene<Space>& light) : light_(light) {}

  /// Merges what can be; returns how many fragments went into others.
  std::uint64_t run(ClassifiedLoops<Vertex>& output) {
    std::vector<std::vector<std::uint32_t>> by_part(light_.scene.parts.size());
    for (std::uint32_t i = 0; i < output.fragments.size(); ++i) {
      by_part[output.fragments[i].loop.part].push_back(i);
    }
    std::vector<std::uint8_t> gone(output.fragments.size(), 0);
    std::uint64_t merged = 0;
    for (const std::vector<std::uint32_t>& fragments : by_part) {
      if (fragments.size() > 1) merged += merge_part(output, fragments, gone);
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < gone.size(); ++i) {
      if (gone[i] == 0) output.fragments[kept++] = output.fragments[i];
    }
    output.fragments.resize(kept);
    keep_used_sets(output);
    return merged;
  }
  /// What ClassifiedLoop::casters of the merged fragments are indices into.
  std::vector<std::vector<std::uint32_t>> take_caster_sets() { return std::move(sets_); }

 private:
  struct EdgeOf {
    std::uint32_t fragment = 0, edge = 0;
  };
  using Edges = std::unordered_multimap<std::uint32_t, EdgeOf>;  // by plane
  struct Witness {
    std::uint32_t caster = Fragment::kNoCaster, casters = Fragment::kNoCaster;
  };

  /// Leaves out the sets of fragments that went into others.
  void keep_used_sets(ClassifiedLoops<Vertex>& output) {
    std::vector<std::vector<std::uint32_t>> used;
    for (ClassifiedLoop& fragment : output.fragments) {
      if (fragment.casters == Fragment::kNoCaster) continue;
      used.push_back(std::move(sets_[fragment.casters]));
      fragment.casters = static_cast<std::uint32_t>(used.size() - 1);
    }
    sets_ = std::move(used);
  }

  Loop view(const ClassifiedLoops<Vertex>& output, std::uint32_t fragment) const {
    const LoopRange& range = output.fragments[fragment].loop;
    return output.loops.view(range, light_.plane_of(range.part));
  }
  void enter(const ClassifiedLoops<Vertex>& output, std::uint32_t fragment, Edges& edges) const {
    const Loop loop = view(output, fragment);
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      if (loop.edges[i].valid()) edges.emplace(loop.edges[i].index(), EdgeOf{fragment, i});
    }
  }

  std::uint64_t merge_part(ClassifiedLoops<Vertex>& output,
                           std::span<const std::uint32_t> fragments,
                           std::vector<std::uint8_t>& gone) {
    Edges edges;
    for (const std::uint32_t fragment : fragments) enter(output, fragment, edges);
    std::uint64_t merged = 0;
    for (const std::uint32_t fragment : fragments) {
      while (gone[fragment] == 0) {
        const std::optional<std::uint32_t> other = merge_one(output, fragment, edges, gone);
        if (!other) break;
        gone[*other] = 1;
        ++merged;
        enter(output, fragment, edges);  // old entries are seen to be stale
      }
    }
    return merged;
  }

  /// The fragment that went into this one.
  std::optional<std::uint32_t> merge_one(ClassifiedLoops<Vertex>& output, std::uint32_t fragment,
                                         const Edges& edges,
                                         const std::vector<std::uint8_t>& gone) {
    const ClassifiedLoop own = output.fragments[fragment];
    for (std::uint32_t i = 0; i < own.loop.count; ++i) {
      const PlaneRef plane = view(output, fragment).edges[i];
      if (!plane.valid()) continue;
      const auto [begin, end] = edges.equal_range(plane.index());
      candidates_.clear();
      for (auto entry = begin; entry != end; ++entry) candidates_.push_back(entry->second);
      std::ranges::sort(candidates_, [](const EdgeOf& a, const EdgeOf& b) {
        return std::pair(a.fragment, a.edge) < std::pair(b.fragment, b.edge);
      });
      for (const EdgeOf& candidate : candidates_) {
        if (candidate.fragment == fragment || gone[candidate.fragment] != 0) continue;
        const Loop a = view(output, fragment), b = view(output, candidate.fragment);
        if (candidate.edge >= b.size() || b.edges[candidate.edge] != -plane) continue;
        const ClassifiedLoop& other = output.fragments[candidate.fragment];
        if (own.state != other.state || own.reason != other.reason) continue;
        if (!join(a, i, b, candidate.edge)) continue;
        const std::optional<Witness> witness = witness_of(own, other);
        if (!witness) continue;
        ClassifiedLoop& result = output.fragments[fragment];
        result.loop = output.loops.append(joined());
        result.caster = witness->caster;
        result.casters = witness->casters;
        return candidate.fragment;
      }
    }
    return std::nullopt;
  }

  Loop joined() const { return joined_.view({0, joined_.size(), part_}, light_.plane_of(part_)); }
  /// The plane of an edge, also of a kernel that knows none by itself.
  PlaneRef plane_of(const Loop& loop, std::uint32_t edge) {
    return light_.space.shadow_plane(loop.edges[edge], loop.vertices[edge],
                                     loop.vertices[loop.next(edge)]);
  }
  bool same_vertex(const Loop& a, std::uint32_t at, PlaneRef through, const Vertex& other) {
    if (a.vertices[at].source != kMadeVertex || other.source != kMadeVertex) {
      return a.vertices[at].source == other.source;
    }
    return light_.space.side_of_plane(through, a.corner(at)) == Side::kOn;
  }

  /// Puts a and b together across edge i of a, which is edge j of b, into joined_; false if they do
  /// not share all of it, or are not convex together.
  bool join(const Loop& a, std::uint32_t i, const Loop& b, std::uint32_t j) {
    const std::uint32_t n = a.size(), m = b.size();
    // The edge runs from a's vertex i, which is b's j + 1, to a's i + 1, which is b's j.
    const std::uint32_t start = i, end = a.next(i);
    const std::uint32_t before = a.previous(i), after = a.next(i);  // edges of a
    const std::uint32_t b_next = b.next(j), b_before = b.previous(j);
    const PlaneRef own_before = plane_of(a, before), own_after = plane_of(a, after);
    if (!same_vertex(a, start, plane_of(b, b_next), b.vertices[b_next]) ||
        !same_vertex(a, end, plane_of(b, b_before), b.vertices[j])) {
      return false;
    }
    const Side at_start = light_.space.side_of_plane(own_before, b.corner(b.next(b_next)));
    const Side at_end = light_.space.side_of_plane(own_after, b.corner(b_before));
    if (at_start == Side::kBack || at_end == Side::kBack) return false;
    joined_.clear();
    part_ = a.part;
    // All of a from the end of the edge to its start, then b's other vertices; a straight angle is
    // no vertex.
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t at = (end + k) % n;
      if (at == end && at_end == Side::kOn) continue;
      if (at == start) {
        if (at_start != Side::kOn) joined_.push(a.vertices[at], b.edges[b_next]);
      } else {
        joined_.push(a.vertices[at], a.edges[at]);
      }
    }
    for (std::uint32_t k = 2; k < m; ++k) {
      const std::uint32_t at = (j + k) % m;
      joined_.push(b.vertices[at], b.edges[at]);
    }
    if (joined_.size() < 3) return false;
    for (std::uint32_t k = 0; k < joined_.size(); ++k) {
      if (joined_.vertex(k).source != kMadeVertex) continue;
      light_.space.finish_vertex(
          joined_.vertex(k), joined_.edge(k == 0 ? joined_.size() - 1 : k - 1), joined_.edge(k));
    }
    return true;
  }

  std::vector<std::uint32_t> casters_of(const ClassifiedLoop& fragment) const {
    if (fragment.casters != Fragment::kNoCaster) return sets_[fragment.casters];
    return {fragment.caster};
  }

  /// Of joined(); none if a rounded kernel finds none.
  std::optional<Witness> witness_of(const ClassifiedLoop& a, const ClassifiedLoop& b) {
    if (a.state == LightState::kLit || a.reason != ShadowReason::kNone) return Witness{};
    if (a.caster == b.caster && a.casters == b.casters) return Witness{a.caster, a.casters};
    std::vector<std::uint32_t> all = casters_of(a);
    for (const std::uint32_t caster : casters_of(b)) {
      if (std::ranges::find(all, caster) == all.end()) all.push_back(caster);
    }
    for (const std::uint32_t caster : all) {
      if (hides(std::span(&caster, 1))) return Witness{caster, Fragment::kNoCaster};
    }
    if (!Space::kExact) return std::nullopt;
    // Polygons are named, not parts: a polygon's parts go together.
    for (std::size_t i = 0; i < all.size();) {
      const std::uint32_t polygon = light_.part(all[i]).polygon;
      std::vector<std::uint32_t> others;
      std::ranges::copy_if(all, std::back_inserter(others), [&](std::uint32_t part) {
        return light_.part(part).polygon != polygon;
      });
      if (!others.empty() && hides(others)) {
        all = std::move(others);
        i = 0;
      } else {
        ++i;
      }
    }
    sets_.push_back(std::move(all));
    return Witness{Fragment::kNoCaster, static_cast<std::uint32_t>(sets_.size() - 1)};
  }

  /// Whether these casters shadow all of joined() together.
  bool hides(std::span<const std::uint32_t> casters) {
    loops_.clear();
    const PlaneId own = light_.plane_of(part_);
    std::vector<LoopRange> open{loops_.append(joined())}, next;
    for (const std::uint32_t caster : casters) {
      next.clear();
      for (const LoopRange& piece : open) subtract(caster, piece, own, next);
      std::swap(open, next);
      if (open.empty()) return true;
    }
    return false;
  }
  /// Appends what of a piece the caster does not shadow.
  void subtract(std::uint32_t caster, const LoopRange& piece, PlaneId own,
                std::vector<LoopRange>& rest) {
    const PlaneId other = light_.plane_of(caster);
    const DepthSides sides =
        own == other ? DepthSides{}
                     : depth_sides(light_.space, light_.facing, other, loops_.view(piece, own));
    if (!sides.behind) return rest.push_back(piece);
    planes_.clear();
    caster_loop_.clear();
    const LoopRange whole =
        light_.with_edge_planes(light_.import_part(caster, caster_loop_), caster_loop_);
    for (std::uint32_t i = 0; i < whole.count; ++i) planes_.push_back(caster_loop_.edge(i));
    if (sides.nearer) planes_.push_back(-depth_cut(light_.space, light_.facing, own, other));
    switch (clip_.clip(light_.space, planes_, piece, own, loops_)) {
      case ConePlace::kInside:
        return;
      case ConePlace::kOutside:
        return rest.push_back(piece);
      case ConePlace::kCut:
        for (const LoopRange& outside : clip_.outside()) rest.push_back(outside);
    }
  }

  LightScene<Space>& light_;
  std::vector<std::vector<std::uint32_t>> sets_;
  std::vector<EdgeOf> candidates_;
  LoopStore<Vertex> joined_;
  std::uint32_t part_ = 0;
  LoopStore<Vertex> loops_, caster_loop_;
  std::vector<PlaneRef> planes_;
  ConeClip<Space> clip_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SVBSP_CONVEX_MERGE_H
