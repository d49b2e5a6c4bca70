// SPDX-License-Identifier: LGPL-3.0-or-later
// From a classified scene to shaded faces: the second half of the 1992 paper's "Illumination" and
// what its "Discussion and Implementation" says about vertices. Fragments become the faces of a
// mesh, lit and penumbra faces are cut by a regular grid or where linear interpolation errs, and
// the illumination of their vertices is computed, once for all faces that share a vertex.
//
// Guarantees, all exact, for results of exact kernels:
//  * the faces of a side of a part tile it, as its fragments did; every face is convex and has the
//    classes of the fragment that it was cut from;
//  * no T-vertices: whatever vertex of a face lies inside an edge of another face on the same line
//    (of the same side, of a part that shares the edge, of a wall that stands on it) is a vertex of
//    that face too, as one more corner between two collinear edges;
//  * equal positions are one vertex, and a vertex's illumination by one light is computed once for
//    each oriented plane that it is on (where a caster touches that plane, illumination jumps:
//    there each penumbra face behind the caster has the limit from its own inside);
//  * the mesh does not depend on the number of threads.
// A corner of one coplanar polygon that touches the middle of an edge of another is not inserted
// there, nor are overlapping coplanar polygons fitted to each other.
#ifndef GNOMON_ALGORITHMS_SHADING_MESH_H
#define GNOMON_ALGORITHMS_SHADING_MESH_H

#include <gmpxx.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// A rational point in homogeneous integers without common factor: numerator / denominator, in
/// scene units. Equal points have equal numbers.
struct ExactPoint {
  std::array<mpz_class, 3> numerator;
  mpz_class denominator = 1;  // positive

  std::array<mpq_class, 3> rational() const;
  friend bool operator==(const ExactPoint&, const ExactPoint&) = default;
};

/// What a point receives from one light, in its intensity, and how far that may be off.
struct PointShade {
  double value = 0;
  double error_bound = 0;
};

/// A point of one side of a part, and a light.
struct ShadeRequest {
  std::uint32_t light = 0;  // number in the result that the mesh is made of
  std::uint32_t part = 0;
  Side side = Side::kFront;
  std::array<mpq_class, 3> point;
  bool unobstructed = false;  // the point is lit, casters need not be asked
  /// If there: the shade is that at the point's border of the face that this point is inside of,
  /// the limit along the line from here to `point`.
  const std::array<mpq_class, 3>* inwards = nullptr;
};

/// The illumination asked for. Called by many threads at once.
using ShadeFunction = std::function<PointShade(const ShadeRequest&)>;

struct ShadingOptions {
  // Regular gridding: the step of the grid in lit faces and in those in the penumbra of some light,
  // scene units; 0: not gridded. The lines are where x, y and z are multiples of the step, so that
  // the grids of neighbours meet; a polygon is cut along the two axes in which it is largest.
  mpq_class lit_step, penumbra_step;
  // The lines are at the doubles nearest to the multiples: where a scene of doubles has its own.
  bool round_lines = true;
  // Adaptive: a face is cut while the illumination in the middle of an edge or of the face is
  // farther from interpolation than this fraction of what its brightest vertex receives, or of the
  // mesh's brightest times kDark if that is more; 0: not adaptive. A step is halved each time, at
  // most max_depth times, beginning with those above or, where they are 0, with a power of two near
  // 1/8 of the scene's diagonal.
  static constexpr double kDark = 1.0 / 32;
  double tolerance = 0;
  unsigned max_depth = 6;
  double ambient = 0;  // what every point receives besides; all that the umbra has
  std::uint64_t max_faces = 4'000'000;
  std::function<void(double)> progress;  // fraction of the work done, 0..1; may be empty
  const std::atomic<bool>* interrupted = nullptr;
};

/// A convex loop, counter-clockwise seen from its side, some corners between collinear edges.
struct MeshFace {
  std::uint32_t part = 0;
  Side side = Side::kFront;
  std::uint64_t lit_by = 0;            // bit i: light number i of the result reaches all of it
  std::uint64_t penumbra_of = 0;       // bit i: it is in the penumbra of that light
  std::uint32_t first = 0, count = 0;  // into ShadingMesh::corners
};

struct MeshCorner {
  std::uint32_t vertex = 0;  // into points
  std::uint32_t sample = 0;  // into samples
};

/// A vertex as the faces of one oriented plane and of one set of umbras see it: where the shade is
/// continuous, faces share a sample.
struct MeshSample {
  std::uint32_t vertex = 0;
  std::uint32_t part = 0;  // one of those that it is on
  Side side = Side::kFront;
};

/// Counts of the 1992 paper's Figure 8, for one light.
struct LightShadingStats {
  std::uint32_t light = 0;                         // index into PreparedScene::lights
  std::uint64_t lit = 0, penumbra = 0, umbra = 0;  // corners of faces of that class
  // What was computed, vertices that faces share counted once: unobstructed, with the search for
  // casters, and the ambient term alone.
  std::uint64_t illuminated_lit = 0, illuminated_penumbra = 0, illuminated_umbra = 0;
  double seconds = 0;        // of computing them, wall clock
  double largest_error = 0;  // the largest error bound of a value, in the light's intensity
};

struct ShadingStats {
  std::uint64_t fragments = 0, faces = 0, vertices = 0;
  unsigned depth = 0;       // how many times adaptive subdivision cut something
  double grid_seconds = 0;  // from fragments to faces, without illumination; wall clock
  std::vector<LightShadingStats> lights;
};

struct ShadingMesh {
  std::vector<std::uint32_t>
      lights;  // indices into PreparedScene::lights; bit i of a face's classes
  std::vector<ExactPoint> exact_points;
  std::vector<std::array<double, 3>> points;  // nearest doubles
  std::vector<MeshFace> faces;                // by part, front before back
  std::vector<MeshCorner> corners;
  std::vector<MeshSample> samples;
  std::vector<double> values;  // of sample s by light i: values[s * lights.size() + i]; 0 in umbra
  double ambient = 0;
  ShadingStats stats;

  std::span<const MeshCorner> loop(const MeshFace& face) const {
    return {corners.data() + face.first, face.count};
  }
  /// The ambient term and what all lights give.
  double shade(std::uint32_t sample) const;
};

/// The paper's rules for a vertex on which classes meet: lit and penumbra faces share it as lit,
/// without a search for casters; an umbra face has the ambient term there, whatever others have.
/// The foot of a caster is an exception to the first: a penumbra face behind it has a value of its
/// own. Every side that receives has faces: those that see no light are one umbra face.
///
/// `result` needs exact points: combined_exact_points of several lights (ShadowOptions::combined),
/// exact_points of one. Runs on the threads of the caller's task arena (oneTBB). Errors: kUsage (a
/// rounded kernel's result, no exact points, Cover::kOverlay), kLimit (max_faces, a step 2^40 times
/// smaller than the scene), kInterrupted. Cost: O(n log n) exact operations for n corners, and as
/// many calls of `shade` as the stats say.
Expected<ShadingMesh> make_shading_mesh(const PreparedScene& scene, const ShadowResult& result,
                                        const ShadeFunction& shade, const ShadingOptions& options);

/// Cuts a face into triangles of its own corners (numbers within the face's loop), none of them
/// without area, so that all of its corners are corners of triangles; a thin triangle only where
/// there is no other way. The decisions are exact.
std::vector<std::array<std::uint32_t, 3>> triangulate(const ShadingMesh& mesh,
                                                      const MeshFace& face);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADING_MESH_H
