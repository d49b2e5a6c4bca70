// SPDX-License-Identifier: LGPL-3.0-or-later
// Hidden lines: by how many polygons each part of an edge is hidden from an eye, or from a light.
// Appel's quantitative invisibility, from the edges that the eye sees alone: the count at the start
// of an edge, and how it changes where the edge passes behind a contour edge or through a polygon.
//
// Appel 1967; Crow 1977, "first class", has shadows from the same counts, taken towards the light.
//
// Exactness: all decisions are exact and all parameters rational, on every grid.
#ifndef GNOMON_ALGORITHMS_HIDDEN_LINES_H
#define GNOMON_ALGORITHMS_HIDDEN_LINES_H

#include <gmpxx.h>

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// An edge of the geometry, and the polygons that it bounds.
struct OutlineEdge {
  EdgeId edge = 0;
  std::vector<std::uint32_t> polygons;  // indices into Scene::polygons, ascending
};

/// The edges of all polygons of which a side faces the light (facing_sides.h): for each polygon the
/// contour of those of its parts that face. So edges between parts that a polygon was cut into are
/// not among them, unless the polygon is not planar and folds back there. Ascending.
std::vector<OutlineEdge> outline_edges(const PreparedScene& scene, std::span<const Side> facing);

/// A part of an edge, from the end of the part before it, or from the edge's first vertex (0).
struct LinePart {
  mpq_class end;                // 1 is the edge's second vertex; the edge is a + t (b - a)
  std::uint32_t hidden_by = 0;  // quantitative invisibility between its ends
};

struct HiddenLine {
  EdgeId edge = 0;
  std::vector<LinePart> parts;  // neighbours differ in hidden_by; the last ends at 1
};

struct HiddenLines {
  std::vector<HiddenLine> lines;  // one for each edge that was asked for, in that order
  // What it took.
  std::uint64_t facing_polygons = 0;  // convex parts that face and hide
  std::uint64_t contour_edges = 0;
  std::uint64_t contour_tests = 0;  // pairs of an edge and a contour edge
  std::uint64_t polygon_tests = 0;  // pairs of an edge and a polygon that it may pass through
  std::uint64_t breakpoints = 0;    // inside of edges, where the count changes
  std::uint64_t counted = 0;        // starts counted anew
  std::uint64_t handed_on = 0;      // starts known from another edge of the vertex
};

struct HiddenLineOptions {
  /// Counts at the start of every edge, and hands nothing on. The answer is the same.
  bool count_every_start = false;
  const std::atomic<bool>* interrupted = nullptr;
};

/// The parts of the edges by the number of parts of polygons that hide them from the light; an eye
/// is a light with `is_eye`, from which every polygon hides.
///
/// A polygon of which a side faces the light *hides* a point x if x is behind its plane and the
/// segment from x to the light passes through it. No polygon that holds x hides it. Where the
/// segment meets the border of a polygon all along a part, the point is counted twice, moved to the
/// left and to the right as seen from the light, and the larger count is taken: so closed polygons
/// hide, and two that share an edge count once. Of an edge whose line holds the light all closed
/// polygons count. docs/hidden-lines.md has examples.
///
/// Degree: brackets of three vertices and the light are of degree 3 in positions (2, and 1 in the
/// direction, for a directional light); a breakpoint is a quotient of two, and two are ordered by
/// degree 6. Bits: 3b + 2 and 6b + 3 for b-bit grids, signs included.
///
/// Requires: a point or directional light; its region is not looked at. Errors: kInterrupted.
/// Cost: a search in a tree of boxes for each edge; edges are worked on by all threads of the
/// caller's arena, and the result does not depend on them.
Expected<HiddenLines> hidden_lines(const PreparedScene& scene, const PreparedLight& light,
                                   std::span<const EdgeId> edges,
                                   const HiddenLineOptions& options = {});

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_HIDDEN_LINES_H
