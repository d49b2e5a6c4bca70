// SPDX-License-Identifier: LGPL-3.0-or-later
// What one side of a caster hides of the light from a triangle of a receiver: from all of its
// points, and from any of them. Proof: docs/illumination.md, "Deep umbra".
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_CELL_SHADOW_H
#define GNOMON_ALGORITHMS_ILLUMINATION_CELL_SHADOW_H

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/illumination/light_view.h"
#include "algorithms/illumination/visible_pieces.h"

namespace gnomon {

/// One side of a caster.
struct CasterSide {
  std::uint32_t caster = 0;  // in LightView::casters()
  bool front = true;
};

/// One side of a caster as the corners of a cell see it.
class CellShadow {
 public:
  static constexpr std::size_t kCorners = 3;

  CellShadow(LightPieces& pieces, const LightView& view, const CasterSide& side)
      : pieces_(pieces), view_(view), caster_(view.casters()[side.caster]), front_(side.front) {
    const Part& part = view.scene().parts[caster_.part];
    for (std::uint32_t c = 0; c < kCorners; ++c) {
      // Negative: behind the side that stops the light.
      heights_[c] = view.side_of(part.plane, pieces.apex(c), pieces.counts);
      if (part.flipped == front_) heights_[c] = -heights_[c];
      if (heights_[c] == Sign::kNegative && deepest_ == kCorners) deepest_ = c;
      in_front_ |= heights_[c] == Sign::kPositive;
    }
  }

  /// Whether some of the cell is behind that side.
  bool exists() const { return deepest_ != kCorners; }

  /// Finds the lines between which the light is hidden from every point of the cell, one for each
  /// edge, and the edges that leave nothing between them: `shut`. Returns false if some of the cell
  /// is not behind the caster.
  bool inner(std::vector<PlaneRef>& region, std::vector<std::uint32_t>& shut) {
    region.clear();
    shut.clear();
    if (!exists() || in_front_) return false;
    for (std::uint32_t e = 0; e < edges().size(); ++e) {
      const PlaneRef edge = edges()[e];
      // The tightest of the planes through the edge and a corner.
      std::uint32_t best = deepest_;
      for (std::uint32_t c = 0; c < kCorners; ++c) {
        if (c == deepest_) continue;
        if (heights_[c] == Sign::kZero) {
          // In the caster's plane: the plane of the two is the caster's, and the light is on its
          // wrong side unless the corner is on the caster's side of the edge, or on its line.
          if (turn(edge, deepest_, c) != Sign::kNegative) continue;
          if (shut.empty() || shut.back() != e) shut.push_back(e);
        } else if (turn(edge, best, c) == Sign::kNegative) {
          best = c;
        }
      }
      region.push_back(line(edge, best));
    }
    add_plane(region);
    return true;
  }

  /// The caster's edges as seen from its blocking side: counter-clockwise from the light.
  std::span<const PlaneRef> edges() const {
    return view_.scene().edges(view_.scene().parts[caster_.part]);
  }
  std::span<const VertexId> loop() const {
    return view_.scene().loop(view_.scene().parts[caster_.part]);
  }
  /// Whether the caster is in front of the planes through one of its edges as line_of_edge has
  /// them.
  bool is_in_front_of(PlaneRef edge) const { return edge.flipped() != front_; }

  /// Finds lines between which lies all that is hidden from any point of the cell.
  void outer(std::vector<PlaneRef>& region) {
    region.clear();
    for (const PlaneRef edge : edges()) {
      std::uint32_t best = deepest_;
      bool is_bounded = true;
      for (std::uint32_t c = 0; c < kCorners && is_bounded; ++c) {
        if (c == deepest_) continue;
        switch (heights_[c]) {
          case Sign::kNegative:
            if (turn(edge, best, c) == Sign::kPositive) best = c;
            break;
          case Sign::kZero:
            is_bounded = turn(edge, deepest_, c) != Sign::kPositive;
            break;
          case Sign::kPositive:
            // Between a corner behind and this one the cell crosses the caster's plane: beyond the
            // edge, or not.
            for (std::uint32_t d = 0; d < kCorners && is_bounded; ++d) {
              if (heights_[d] != Sign::kNegative) continue;
              is_bounded = turn(edge, d, c) == Sign::kNegative;
            }
            break;
        }
      }
      if (is_bounded) region.push_back(line(edge, best));
    }
    add_plane(region);
  }

 private:
  PlaneRef line(PlaneRef edge, std::uint32_t corner) {
    const PlaneRef made = pieces_.line_of_edge(edge.index(), corner);
    return edge.flipped() == front_ ? -made : made;
  }
  /// On which side of the plane through the edge and corner `from` is corner `to`; positive: the
  /// plane through `to` hides more.
  Sign turn(PlaneRef edge, std::uint32_t from, std::uint32_t to) {
    const Sign sign = view_.side_of_edge_plane(edge.index(), pieces_.apex(from), pieces_.apex(to),
                                               pieces_.counts);
    return edge.flipped() == front_ ? -sign : sign;
  }
  void add_plane(std::vector<PlaneRef>& region) {
    if (!caster_.cuts) return;
    const Part& part = view_.scene().parts[caster_.part];
    const PlaneRef made = pieces_.line_of_plane(part.plane);
    region.push_back(part.flipped == front_ ? -made : made);
  }

  LightPieces& pieces_;
  const LightView& view_;
  const LightView::Caster& caster_;
  bool front_;
  std::array<Sign, kCorners> heights_{};
  std::uint32_t deepest_ = kCorners;
  bool in_front_ = false;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_CELL_SHADOW_H
