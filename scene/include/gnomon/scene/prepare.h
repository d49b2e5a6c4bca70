// SPDX-License-Identifier: LGPL-3.0-or-later
// Second step of the pipeline: from a scene as read to convex, exactly planar parts on one integer
// grid. All decisions are exact; nothing is moved, nothing is rounded, no vertex is invented.
//
// By the definitions (docs: semantics, "Scene"): repeated and collinear vertices dropped, loops of
// zero area dropped and listed, non-planar loops triangulated by ear clipping in the projection
// along the largest component of the area vector, non-convex loops and loops with holes
// triangulated with bridges and merged across diagonals while convex. Equal positions become one
// vertex, shared edges one edge, polygons in one support plane one plane, whatever their
// orientation.
#ifndef GNOMON_SCENE_PREPARE_H
#define GNOMON_SCENE_PREPARE_H

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/orientation.h"
#include "gnomon/scene/scene.h"

namespace gnomon {

/// One convex, exactly planar piece of an input polygon; most polygons are one part.
struct Part {
  std::uint32_t polygon = 0;  // index into Scene::polygons
  std::uint32_t first = 0;    // into PreparedScene::loop_vertices and loop_edges
  std::uint32_t count = 0;
  PlaneId plane = 0;     // into geometry.planes: the coplanar family
  bool flipped = false;  // the part's front is the back of that plane
  bool two_sided = false;
  bool casts = true;
};

struct PreparedLight {
  std::uint32_t light = 0;  // index into Scene::lights
  LightType type = LightType::kPoint;
  LightPoint point;                                 // point and directional
  std::vector<std::array<mpz_class, 3>> area_loop;  // area: on the scene's grid
  /// Where it shines: planes of the geometry, inside in front; none: everywhere. They may be planes
  /// of polygons, too, and their vertices may be light_vertices.
  std::vector<PlaneRef> region;
  bool is_eye = false;  // as Light::is_eye

  bool is_point() const { return type == LightType::kPoint; }
  bool is_directional() const { return type == LightType::kDirectional; }
  bool has_area() const { return type == LightType::kArea; }
};

/// Whether a part casts a shadow of this light, with a side that faces it.
inline bool casts_under(const PreparedLight& light, const Part& part) {
  return part.casts || light.is_eye;
}

/// What was done to an input polygon that was not convex and planar as it stood.
enum class Repair : std::uint8_t {
  kRepeatedVertices,   // dropped
  kCollinearVertices,  // dropped
  kZeroArea,           // whole polygon dropped
  kNotPlanar,          // triangulated
  kNotConvex,          // cut into convex parts
  kHoles,              // bridged and cut into convex parts
};

struct PreparationNote {
  std::uint32_t polygon = 0;
  Repair repair = Repair::kRepeatedVertices;
  std::string detail;  // such as "3.2 scene units off its plane; 2 parts"
};

/// What was done to an area light; the point set that it emits from is never changed.
struct LightNote {
  std::uint32_t light = 0;  // index into Scene::lights
  std::string detail;
};

struct PreparedScene {
  Geometry geometry;
  std::vector<VertexId> loop_vertices;  // of parts; geometry vertex ids
  std::vector<PlaneRef> loop_edges;  // edge from vertex i to i+1 of the loop: index() is the edge,
                                     // flipped() if it runs from edge.b to edge.a
  std::vector<Part> parts;           // in order of polygons
  std::vector<std::uint32_t> first_part;  // per polygon, size polygons + 1: parts of polygon p are
                                          // first_part[p] .. first_part[p+1]-1; none if dropped
  std::vector<PreparedLight> lights;      // in order of Scene::lights
  std::vector<PreparationNote> notes;     // sorted by polygon
  std::vector<LightNote> light_notes;     // sorted by light
  std::vector<std::uint32_t>
      vertex_of_input;          // Scene::vertices index -> geometry vertex id (kUnused)
  unsigned position_bits = 0;   // b: bits of the grid
  unsigned direction_bits = 0;  // e: bits of the largest directional component

  static constexpr std::uint32_t kUnused = 0xffffffffu;

  std::span<const VertexId> loop(const Part& part) const {
    return {loop_vertices.data() + part.first, part.count};
  }
  std::span<const PlaneRef> edges(const Part& part) const {
    return {loop_edges.data() + part.first, part.count};
  }
};

/// Loops and holes may touch themselves and each other in vertices and along edges (a keyhole, two
/// lobes that meet in a vertex, a hole on the border): the region is what counts, and what two
/// rings share cancels. Crossing is an error. An ear is clipped only if its closed triangle holds
/// no other vertex, so that touching vertices forbid it (scene/prepare/polygon_cut.h has the rule).
/// The smallest index of Scene::vertices stands for repeated vertices. Vertices that no loop names
/// have no part in the grid. Errors: kGeometry (a loop that crosses itself or runs round an area
/// twice, a hole that crosses or leaves its loop or overlaps another, degenerate or non-planar area
/// light, zero to_light), kIndex. Cost: O(n log n) for n vertices, more where
/// very many edges meet or overlap (watched: prepare_control.h). Large scenes are worked on by all
/// threads of the caller's task arena (oneTBB); the result, errors included, does not depend on
/// their number.
Expected<PreparedScene> prepare(const Scene& scene);

}  // namespace gnomon

#endif  // GNOMON_SCENE_PREPARE_H
