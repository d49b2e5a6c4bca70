// SPDX-License-Identifier: LGPL-3.0-or-later
// What a scene says and perhaps does not mean. Its numbers are taken exactly, so that a window
// 1e-7 behind its wall is behind it, a one-sided shade that looks the wrong way casts nothing, and
// a lamp inside a solid whose faces look outwards shines through it. None of this is an error, and
// all of it is a common mistake; this finds it, and repair.h puts it right.
//
// Exactness: what is exactly equal is never reported as nearly so. Distances, angles and areas are
// computed in long double from exact differences, and serve as hints.
#ifndef GNOMON_SCENE_INTENT_H
#define GNOMON_SCENE_INTENT_H

#include <cstdint>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon {

/// Two polygons that are not in one plane, overlap, and are nearer than `near` all over where they
/// do.
struct NearlyCoplanarPair {
  std::uint32_t polygon = 0, other = 0;  // the smaller first
  double distance = 0;  // greatest, of the overlap, scene units; negative: behind the other's front
  double angle = 0;     // between the planes, degrees
  double overlap = 0;   // scene units squared
};

struct NearlySharedVertices {
  VertexId a = 0, b = 0;  // of PreparedScene::geometry, a < b
  double distance = 0;    // scene units
};

/// Edges of two polygons whose ends are nearly shared, or one shared and one nearly.
struct NearlySharedEdges {
  EdgeId a = 0, b = 0;
};

struct BentPolygon {
  std::uint32_t polygon = 0;
  double distance = 0;  // greatest, of a vertex from the plane of the polygon's area vector
};

enum class ComponentOrientation : std::uint8_t {
  kOutwards,
  kInwards,
  kMixed,  // some faces one way, some the other
  kFlat,   // no volume: such as a sheet of two polygons back to back
};

/// Polygons that share all their edges with one another: they bound a solid or a room.
struct ClosedComponent {
  std::vector<std::uint32_t> polygons;  // ascending
  ComponentOrientation orientation = ComponentOrientation::kFlat;
  bool two_sided = false;                    // some polygon is
  std::vector<std::uint32_t> lights_inside;  // point and area lights: indices into Scene::lights
  bool is_cavity = false;  // looks inwards and lies inside a component that looks outwards
};

struct Intent {
  double near = 0;  // what counted as near, scene units
  /// Neither pairs of polygons nor vertices nor components were looked at: the scene is too large.
  bool is_partial = false;
  std::vector<NearlyCoplanarPair> nearly_coplanar;  // sorted by polygons
  std::vector<NearlySharedVertices> near_vertices;  // sorted
  std::vector<NearlySharedEdges> near_edges;        // sorted
  std::vector<BentPolygon> bent;                    // by no more than `near`
  std::vector<ClosedComponent> closed;              // by their first polygons
  /// One-sided polygons of open components that face away from every light as a whole, and lie on
  /// no other polygon: they neither receive nor cast. Empty if there is no light.
  std::vector<std::uint32_t> facing_nothing;
  bool facing_was_looked_at = false;
  double farthest_coordinate = 0, diagonal = 0;

  /// A point or area light inside a component that looks outwards shines through it.
  bool is_seen_through(const ClosedComponent& component) const;
  /// A component that looks inwards, with no light inside, and in no solid.
  bool is_inside_out(const ClosedComponent& component) const;
  /// Doubles there are so coarse that they lose four digits and more.
  bool is_far_from_origin() const { return farthest_coordinate > 1e4 * diagonal; }
  /// Is anything of it worth a warning?
  bool is_doubtful() const;
};

struct IntentOptions {
  /// Scene units; 0 stands for 1e-5 of the median diameter of parts.
  double near = 0;
  /// Of larger scenes only what costs next to nothing is looked at.
  std::size_t most_parts = static_cast<std::size_t>(-1);
};

/// Cost: O(n log n) for n parts unless very many lie on one another, by a tree of boxes; all
/// threads of the caller's task arena work on it, and the result does not depend on their number.
Intent find_intent(const Scene& scene, const PreparedScene& prepared,
                   const IntentOptions& options = {});

}  // namespace gnomon

#endif  // GNOMON_SCENE_INTENT_H
