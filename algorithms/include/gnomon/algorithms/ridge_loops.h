// SPDX-License-Identifier: LGPL-3.0-or-later
// The ridge edges of solids as loops: the outline of each closed component as a point or
// directional light sees it, cut where ridge edges pass over each other and strung anew, so that
// each loop bounds a region of one depth of facing polygons. External and hole loops bound the
// shadow that the solid casts; internal ones the shadow that it casts on itself.
//
// Thakur, Cheng & Miura, section 2: ridge edges, visible and hidden ones, pseudo intersection
// points (PIPs), separation into loops, imaginary edges.
//
// Exactness: everything is decided by signs of integers. Docs: ridge-loops.md.
#ifndef GNOMON_ALGORITHMS_RIDGE_LOOPS_H
#define GNOMON_ALGORITHMS_RIDGE_LOOPS_H

#include <gmpxx.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// How the hidden neighbour of a ridge edge's facing polygon lies.
enum class RidgeKind : std::uint8_t {
  kVisible,  // VRE: behind the facing polygon's plane, or in it
  kHidden,   // HRE: in front of it, so that the edge is reflex
  kBorder    // there is none: the component is open
};

struct RidgeEdge {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  PlaneRef edge;                 // the facing side on its left, as seen from the light
  std::uint32_t facing = 0;      // a part that faces the light and has this edge
  std::uint32_t hidden = kNone;  // the part on its other side; kNone at a border
  RidgeKind kind = RidgeKind::kVisible;
};

/// Where two ridge edges cross as seen from the light, inside of both.
struct PseudoIntersection {
  static constexpr std::uint32_t kTouch = 0xffffffffu;
  std::uint32_t first = 0, second = 0;  // into RidgeLoops::edges
  std::uint32_t nearer = kTouch;        // the one of them that is nearer to the light; kTouch: they
                                        // meet in space
  std::uint32_t ray = 0;
};

enum class LoopKind : std::uint8_t {
  kExternal,  // one facing polygon inside, none outside
  kHole,      // the light passes inside
  kInternal   // at least one facing polygon on either side
};
/// "external", "hole", "internal".
const char* name_of(LoopKind kind);

/// From one ray to the next along a ridge edge.
struct LoopStep {
  std::uint32_t ray = 0;   // where it starts
  std::uint32_t edge = 0;  // of RidgeLoops::edges
  /// It starts on another edge than the one that the step before ended on, at another depth: the
  /// paper's imaginary edge, seen as a point.
  bool imaginary = false;
};

struct RidgeLoop {
  LoopKind kind = LoopKind::kExternal;
  /// Facing polygons of the component on its left; on its right there is one less.
  std::uint32_t depth = 1;
  std::vector<LoopStep> steps;
};

/// The loops of one component, and what they are made of.
struct RidgeLoops {
  std::uint32_t component = 0;  // of find_components()
  std::uint32_t facing_parts = 0;
  std::vector<RidgeEdge> edges;
  std::vector<PseudoIntersection> crossings;
  std::vector<RidgeLoop> loops;
  /// Where loops turn, as directions: of a directional light a multiple of (u, v, 1) in a chart
  /// across its direction, of a point light of the way from the point to the light. Seen from the
  /// light, the left of a to b is where det(a, b, x) > 0. Primitive integers.
  std::vector<std::array<mpz_class, 3>> rays;
  std::uint64_t pairs = 0;      // of edges that were tested for crossing
  std::uint64_t cancelled = 0;  // stretches of edges that run both ways along one another

  std::uint64_t all_pairs() const {
    return edges.empty() ? 0 : std::uint64_t{edges.size()} * (edges.size() - 1) / 2;
  }
};

/// Also components with edges that have no partner, whose borders are taken for ridge edges.
enum class OpenComponents : std::uint8_t { kRefused, kAllowed };

/// Of every component with a part that faces the light and casts, in their order. `light`: index
/// into PreparedScene::lights.
///
/// At a ray where edges meet, an incoming edge is followed by the outgoing one that bounds the same
/// depth: going round clockwise from it, the first outgoing one that no incoming one between has
/// taken. Where two cross this is the other edge, as in the paper (section 2.4).
///
/// Errors: kUsage (an area light), kGeometry (an open component, unless allowed; names polygon and
/// edge), kInterrupted (`interrupted`, if given, became true).
/// Cost: n log n for n edges, and the pairs whose boxes of directions meet; for each loop one look
/// at every facing part of its component.
Expected<std::vector<RidgeLoops>> ridge_loops(const Scene& scene, const PreparedScene& prepared,
                                              std::uint32_t light,
                                              OpenComponents open = OpenComponents::kRefused,
                                              const std::atomic<bool>* interrupted = nullptr);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RIDGE_LOOPS_H
