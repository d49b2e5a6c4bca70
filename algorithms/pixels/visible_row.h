// SPDX-License-Identifier: LGPL-3.0-or-later
// Which part the eye sees at each sample of a row: parts are drawn one after another, and where one
// is drawn already, an exact comparison of depth decides (Catmull 1974, with rows of polygons in
// place of rows of depths).
//
// Of coplanar parts the one of the smallest index is seen. Exactness: that of the space.
#ifndef GNOMON_ALGORITHMS_PIXELS_VISIBLE_ROW_H
#define GNOMON_ALGORITHMS_PIXELS_VISIBLE_ROW_H

#include <algorithm>
#include <cstdint>
#include <span>

#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/row_search.h"

namespace gnomon {

/// The samples of a row that a part covers. Requires: the eye sees the part.
template <class Space>
Span covered_span(ImageScene<Space>& scene, std::uint32_t part, std::uint32_t row) {
  Space& space = scene.space();
  Span span{0, space.frame().width};
  const std::size_t edges = scene.scene().parts[part].count;
  for (std::size_t k = 0; k < edges && !span.empty(); ++k) {
    const RayPlaneRef edge = scene.ray_plane(part, k);
    span = part_where(
        span,
        [&](std::uint32_t i) {
          return space.covers(edge, {i, row}) == Sign::kPositive;
        },
        space.guess_covers(edge, row));
  }
  return span;
}

/// The part of a span where `plane` has this sign at the samples on the support plane `on`.
template <class Space>
Span part_on_side(Space& space, Span span, PlaneRef plane, PlaneRef on, std::uint32_t row,
                  Sign side) {
  return part_where(
      span,
      [&](std::uint32_t i) {
        return space.side_at_sample(plane, on, {i, row}) == side;
      },
      space.guess_side(plane, on, row));
}

/// The part of a span, of samples on the support plane `on`, that is in the region of a light.
template <class Space>
Span part_in_region(Space& space, Span span, const PreparedLight& light, PlaneRef on,
                    std::uint32_t row) {
  for (const PlaneRef plane : light.region) {
    if (plane.same_plane(on)) continue;
    span = part_on_side(space, span, plane, on, row, Sign::kPositive);
    if (span.empty()) break;
  }
  return span;
}

/// Draws a part into a row, and calls drawn(span) for each span of it that nothing drawn before
/// hides. Requires: the part covers the span.
template <class Space, class Drawn>
void draw_span(ImageScene<Space>& scene, std::uint32_t part, Span span, std::uint32_t row,
               std::span<std::uint32_t> seen, WorkCounts& work, const Drawn& drawn) {
  const PlaneRef plane = scene.facing_eye(part);
  for (Span run{span.begin, span.begin}; run.begin < span.end; run.begin = run.end) {
    const std::uint32_t other = seen[run.begin];
    while (run.end < span.end && seen[run.end] == other) ++run.end;
    Span nearer = run;
    if (other != Pixels::kNoPart) {
      const PlaneRef other_plane = scene.facing_eye(other);
      if (plane.same_plane(other_plane)) {
        if (other < part) continue;
      } else {
        ++work[Counter::kDepthTests];
        // What is drawn lies behind the part where it is on the other side of the part's plane.
        nearer = part_on_side(scene.space(), run, plane, other_plane, row, Sign::kNegative);
      }
    }
    std::fill(seen.begin() + nearer.begin, seen.begin() + nearer.end, part);
    if (!nearer.empty()) drawn(nearer);
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PIXELS_VISIBLE_ROW_H
