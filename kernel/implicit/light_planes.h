// SPDX-License-Identifier: LGPL-3.0-or-later
// Planes through one point or directional light and the rays in which they meet, for kernel
// `plane`: what each plane was made from, its integers, and its doubles for the filter.
//
// Planes [0, edges) are the shadow planes of the input edges; forks share them. All others are a
// stack of each fork's own: cuts of two support planes, and explicit integers (a trace of a scene
// BSP split, a prefix plane, a plane of another light). A made vertex is the ray in which the
// planes of its two edges meet, n_before x n_after in that order.
//
// The depth plane of a support plane n . x = d with value h at the light is n / h (for a
// directional light: the height at which a line to the light meets it): a linear function of rays
// that is larger where the plane is nearer. Comparing two of them decides which polygon shadows
// which; this is the exact form of a depth buffer's 1 / z.
//
// The doubles of a far lamp L (LightIntegers::far) are those of its far_ray() and in_far_rays(): q
// would be the same for all vertices but for its last bits. A depth is then the height as of a sun,
// L_z n / h . q less r_z: the difference of two depths is that of n / h, times L_z. Integers stay
// those of q.
//
// Guarantee: every bound is proven (LightBounds). Planes and rays are scaled by powers of two so
// that the largest component is in [1/2, 1) (made rays: at most 2); what cannot be scaled so has an
// infinite bound. Reference: Chin & Feiner 1989, sec. 4; docs/exactness.md.
#ifndef GNOMON_KERNEL_IMPLICIT_LIGHT_PLANES_H
#define GNOMON_KERNEL_IMPLICIT_LIGHT_PLANES_H

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "kernel/concept/light_space.h"
#include "kernel/implicit/filter_bounds.h"
#include "kernel/implicit/light_integers.h"
#include "kernel/implicit/plane_provenance.h"
#include "kernel/implicit/scene_planes.h"
#include "kernel/signs/corner.h"

namespace gnomon {

class LightPlanes {
 public:
  /// 32 bytes, as a vertex of three doubles and a number is.
  struct Vertex {
    std::array<double, 3> ray{};  // positive multiple of the direction in q coordinates, |.| <= 2
    /// Bound of the error of n . ray for a plane of slack 1; at least three times the error of any
    /// component. Infinite: the doubles say nothing.
    float bound = 0;
    VertexId source = kMadeVertex;
  };

  /// n / h of a support plane, in the units of stretched rays; see the head of the file.
  struct DepthPlane {
    std::array<double, 3> n{};  // each off by at most LightBounds::kDepthPlane |n_k|
    double magnitude = 0;       // largest |n_k|; infinite: the doubles say nothing
    Sign at_light = Sign::kZero;
    std::int8_t steepest = 0;  // of a far lamp: the axis of the support normal's largest component
  };
  const DepthPlane& depth_plane(PlaneId plane) const { return shared_->depths[plane]; }

  static constexpr bool kMakesPlanesOfVertices = false;

  /// Whether an edge's plane is the one that cut it; always.
  bool knows_identity() const { return true; }

  /// The plane of a scene-space edge in this light space, interior in front. `reversed` tells that
  /// the loop was reversed to be counter-clockwise from the light (a back side faces it). `from`
  /// and `to` are the edge's vertices in the order of the reversed loop.
  PlaneRef import_edge(PlaneRef scene_edge, PlaneId support, bool reversed, const Vertex& from,
                       const Vertex& to);
  Vertex import_vertex(const ScenePlanes::Vertex& vertex) const;
  /// The plane through this light and the line in which a plane of another light cuts `support`,
  /// same sides: how an edge made by one light's tree goes on to the next (1989, sec. 5).
  PlaneRef import_cut(const LightPlanes& other, PlaneRef plane, PlaneId support);
  /// Completes a made vertex once the planes of its edges are known.
  void finish_vertex(Vertex& vertex, PlaneRef before, PlaneRef after) const {
    vertex = made_vertex(before, after);
  }
  /// A fragment edge is its own shadow plane.
  PlaneRef shadow_plane(PlaneRef edge, const Vertex&, const Vertex&) { return edge; }
  PlaneRef add_prefix_plane(const PrefixPlane& plane) { return add_explicit(plane.n); }
  /// The one chart of a far lamp, as that of a sun, for far_chart_point(); none of other lights.
  std::optional<LightChart> far_chart() const {
    if (!integers().far) return std::nullopt;
    return LightChart{0, 1, 2, sgn(integers().light.grid[integers().axes.z])};
  }
  /// A plane of that chart, as a sun's would be given. Requires: far_chart().
  PlaneRef add_plane_of_far_chart(const PrefixPlane& plane) {
    return add_explicit(integers().from_far_rays(plane.n));
  }
  /// The front is the part of `first` in front of `second`. Degree: 5.
  PlaneRef cut_of_supports(PlaneId first, PlaneId second);
  /// Where the edge `edge`, leaving the front of `plane` (kFront first) or entering it, meets it.
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>&,
                  const Corner<Vertex>&) const {
    // Counter-clockwise and inside positive: leaving the front, the cut edge follows the edge.
    return leaving ? made_vertex(edge, plane) : made_vertex(plane, edge);
  }

  /// A plane and its doubles, to test many vertices against.
  struct LoadedPlane {
    std::array<double, 3> n;
    double slack;
    PlaneRef plane;
  };
  LoadedPlane load(PlaneRef ref) const {
    const FilteredPlane& plane = filtered(ref);
    return {plane.n, plane.slack, ref};
  }

  /// See the concept SectorSpaceModel.
  void make_edge_planes(EdgeId begin, EdgeId end);
  std::uint32_t plane_mark() const { return static_cast<std::uint32_t>(own_.size()); }
  void release_planes(std::uint32_t mark);

  /// In words, for explanations: "the shadow plane of edge 4-7", ...
  std::string describe(PlaneRef plane) const;

 protected:
  LightPlanes(const ScenePlanes& scene, const LightPoint& light);

  /// Doubles of a plane: largest |n_k| in [1/2, 1), each off by at most 2u * slack, slack >= 1.
  struct FilteredPlane {
    std::array<double, 3> n{};
    double slack = kNotMade;  // infinite: the doubles say nothing
  };
  static constexpr double kNotMade = 0;
  /// What forks have in common.
  struct Shared {
    Shared(const ScenePlanes& scene_planes, const LightPoint& light)
        : scene(&scene_planes), integers(scene_planes.geometry(), light) {}

    const ScenePlanes* scene;
    LightIntegers integers;
    int stretch = 0;                   // z of the doubles is scaled by 2^stretch (is_parallel())
    std::vector<FilteredPlane> edges;  // by EdgeId
    std::vector<DepthPlane> depths;    // by PlaneId
  };

  const LightIntegers& integers() const { return shared_->integers; }
  const Geometry& geometry() const { return *shared_->integers.geometry; }
  const ScenePlanes& scene() const { return *shared_->scene; }
  const DepthPlane& depth(PlaneId plane) const { return depth_plane(plane); }
  int stretch() const { return shared_->stretch; }

  bool is_edge(PlaneRef plane) const { return plane.index() < edge_count(); }
  /// Requires: is_edge().
  EdgeEnds ends_of(PlaneRef edge) const { return geometry().edges[edge.index()]; }
  /// Requires: not is_edge().
  const LightPlaneSource& source(PlaneRef plane) const {
    return sources_[plane.index() - edge_count()];
  }
  bool is_cut_of(PlaneRef plane, PlaneId first, PlaneId second) const {
    return !is_edge(plane) && source(plane).is_cut_of(first, second);
  }

  /// Magnitude bits of a plane's integers, and whether they are made from 64-bit ones.
  unsigned plane_bits(PlaneRef plane) const;
  bool is_narrow(PlaneRef plane) const;
  /// A plane's integers, from its provenance: plane_bits(), in the reference's orientation.
  template <class Int>
  Vector3<Int> exact_normal(PlaneRef plane) const;
  /// The ray of a made corner, exactly, in the type of a product of two planes.
  template <class Factor, class Int>
  auto exact_ray(const Corner<Vertex>& corner) const {
    return cross<Product<Int, Factor, Factor>>(exact_normal<Factor>(corner.before),
                                               exact_normal<Factor>(corner.after));
  }

 private:
  struct Explicit {
    Vector3<mpz_class> n;
    unsigned bits = 0;  // of the largest component's magnitude
  };

  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(shared_->edges.size()); }
  const FilteredPlane& filtered(PlaneRef plane) const {
    const std::uint32_t index = plane.index();
    return index < edge_count() ? shared_->edges[index] : own_[index - edge_count()];
  }
  Vertex made_vertex(PlaneRef before, PlaneRef after) const {
    const FilteredPlane& m = filtered(before);
    const FilteredPlane& n = filtered(after);
    const double sign = before.flipped() != after.flipped() ? -1 : 1;
    Vertex vertex;
    vertex.ray = {sign * (m.n[1] * n.n[2] - m.n[2] * n.n[1]),
                  sign * (m.n[2] * n.n[0] - m.n[0] * n.n[2]),
                  sign * (m.n[0] * n.n[1] - m.n[1] * n.n[0])};
    vertex.bound = LightBounds::made(m.slack, n.slack);
    return vertex;
  }
  /// From a plane of rays; of a far lamp of far_ray().
  template <class Int>
  FilteredPlane filtered_from(const Vector3<Int>& normal) const;
  void make_depth_planes();
  template <class Normal, class Int>
  DepthPlane depth_plane(PlaneId id) const;
  PlaneRef add(const FilteredPlane& plane, LightPlaneSource source);
  PlaneRef add_explicit(Vector3<mpz_class> normal);
  PlaneRef trace(PlaneId support, const ExactPlane<mpz_class>& cut);
  /// A plane as one of the scene, in its own orientation.
  const ExactPlane<mpz_class>& plane_in_scene(PlaneRef plane) const;

  std::shared_ptr<Shared> shared_;
  // Planes after those of the edges; a stack.
  std::vector<FilteredPlane> own_;
  std::vector<LightPlaneSource> sources_;
  std::vector<Explicit> explicit_;
  std::unordered_map<std::uint64_t, PlaneRef> traces_;  // (support plane, cutting plane)
  struct CutKey {
    const LightPlanes* other;
    std::uint32_t plane;
    PlaneId support;
    friend bool operator==(const CutKey&, const CutKey&) = default;
  };
  struct CutHash {
    std::size_t operator()(const CutKey& key) const {
      constexpr std::size_t kOdd = 0x9e3779b97f4a7c15u;
      const std::size_t both = (std::size_t{key.plane} << 32 | key.support) * kOdd;
      return (both ^ both >> 32) + std::hash<const LightPlanes*>()(key.other);
    }
  };
  std::unordered_map<CutKey, PlaneRef, CutHash> cuts_;
  // Of support planes that are cut, and of planes that cut them for other lights.
  std::unordered_map<PlaneId, ExactPlane<mpz_class>> supports_;
  mutable std::unordered_map<std::uint32_t, ExactPlane<mpz_class>> in_scene_;
};

template <class Int>
Vector3<Int> LightPlanes::exact_normal(PlaneRef ref) const {
  Vector3<Int> n;
  if (is_edge(ref)) {
    n = integers().edge_normal<Int>(ends_of(ref));
  } else if (const LightPlaneSource& from = source(ref); from.is_explicit()) {
    for (int k = 0; k < 3; ++k) n[k] = integer_from<Int>(explicit_[from.a].n[k]);
  } else {
    n = integers().cut_of_supports<Int>(from.a, from.b);
  }
  if (ref.flipped()) {
    for (Int& x : n) x = -x;
  }
  return n;
}

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_LIGHT_PLANES_H
