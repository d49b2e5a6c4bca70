// SPDX-License-Identifier: LGPL-3.0-or-later
// The kernel `plane` in the light space of one point or directional light, where SVBSP decides: on
// which side of a plane through the light is a vertex of a fragment?
//
// A plane is its provenance: an input edge (q_a x q_b), or explicit integers (a trace of a scene
// BSP split, a prefix plane, a plane of another light). A vertex is an input vertex, or the ray in
// which the planes of its two edges meet, n_before x n_after, in that order. Both carry doubles
// with proven error bounds for the filter; what the filter leaves open is computed again from the
// provenance in integers.
//
// Guarantee: every decision is exact on every input, whatever the magnitudes: a filter answers only
// if its value and bound are finite and the bound is at least 2^-900, so that nothing that
// underflowed can matter. Degree: 3 for input vertices, 6 for crossings, 9 / 12 / 15 with one, two,
// three traces. Reference: Chin & Feiner 1989, sec. 4; docs/exactness.md.
#ifndef GNOMON_KERNEL_PLANE_LIGHT_SPACE_H
#define GNOMON_KERNEL_PLANE_LIGHT_SPACE_H

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "gnomon/kernel/light_space.h"
#include "gnomon/kernel/plane_scene_space.h"

namespace gnomon {

template <class Stats = NoStats>
class PlaneLightSpace {
 public:
  using SceneSpace = PlaneSceneSpace<Stats>;
  static constexpr bool kExact = true;

  struct Vertex {
    std::array<double, 3> ray{};  // positive multiple of the direction in q coordinates
    double magnitude = 0;         // largest |ray_k|
    double error = 0;             // of each component; infinite: the doubles say nothing
    VertexId source = kMadeVertex;
  };

  PlaneLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options);

  /// Whether an edge's plane is the one that cut it; always.
  bool knows_identity() const { return true; }
  /// Sign of the support plane at the light: whether its front faces the light.
  Sign light_side(PlaneId plane) const;

  /// The plane of a scene-space edge in this light space, interior in front. `reversed` tells that
  /// the loop was reversed to be counter-clockwise from the light (a back side faces it). `from`
  /// and `to` are the edge's vertices in the order of the reversed loop.
  PlaneRef import_edge(PlaneRef scene_edge, PlaneId support, bool reversed, const Vertex& from,
                       const Vertex& to);
  Vertex import_vertex(const typename SceneSpace::Vertex& vertex) const;
  /// The plane through this light and the line in which a plane of another light cuts `support`,
  /// same sides: how an edge made by one light's tree goes on to the next (1989, sec. 5).
  PlaneRef import_cut(const PlaneLightSpace& other, PlaneRef plane, PlaneId support);
  /// Completes a made vertex once the planes of its edges are known.
  void finish_vertex(Vertex& vertex, PlaneRef before, PlaneRef after) const;
  /// A fragment edge is its own shadow plane.
  PlaneRef shadow_plane(PlaneRef edge, const Vertex&, const Vertex&) { return edge; }
  PlaneRef add_prefix_plane(const PrefixPlane& plane);

  /// Identities: (1) the planes of the corner's edges contain it; (2) the plane of edge (a, b)
  /// contains the input vertices a and b. Exactness: always.
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner);
  /// Where the edge `edge`, leaving the front of `plane` (kFront first) or entering it, meets it.
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;

  /// Enclosure of the corner's position on its support plane, in grid units times 2^-b.
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const;
  /// The same, exactly, in scene units.
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;
  /// In words, for explanations: "edge 12 (4-7)", "trace", ...
  std::string describe(PlaneRef plane) const;
  StageCounts stage_counts() const { return stats_.counts(); }

 private:
  static constexpr std::uint32_t kExplicit = 0xffffffffu;
  struct Plane {
    std::array<double, 3> n{};
    double magnitude = 0;
    double error = 0;
    std::uint32_t a = 0;
    std::uint32_t b = kExplicit;  // edge a-b, or explicit_[a] if b is kExplicit
  };

  std::array<mpq_class, 3> exact_grid_position(const Corner<Vertex>& corner) const;
  template <class Int>
  Vector3<Int> q(VertexId v) const;
  template <class Int>
  Vector3<Int> exact_normal(PlaneRef plane) const;
  template <class Int>
  Sign exact_side(PlaneRef plane, const Corner<Vertex>& corner) const;
  unsigned bits_of(PlaneRef plane) const {
    const Plane& p = planes_[plane.index()];
    return p.b == kExplicit ? explicit_bits_[p.a] : edge_bits_;
  }
  bool is_small(PlaneRef plane) const {
    const Plane& p = planes_[plane.index()];
    return p.b != kExplicit || explicit_bits_[p.a] <= 63;
  }
  std::array<double, 3> scaled(const Vector3<mpz_class>& v, bool is_normal,
                               unsigned magnitude_bits) const;
  std::array<double, 3> scaled(const Vector3<Int128>& v, bool is_normal,
                               unsigned magnitude_bits) const;
  PlaneRef add_explicit(Vector3<mpz_class> normal);
  PlaneRef trace(PlaneId support, const ExactPlane<mpz_class>& cut);
  ExactPlane<mpz_class> in_scene(PlaneRef plane) const;

  const Geometry* geometry_;
  SceneSpace* scene_;
  LightPoint light_;
  LightAxes axes_;
  unsigned q_bits_;     // magnitude bits of q
  unsigned edge_bits_;  // magnitude bits of an edge plane
  int stretch_ = 0;     // z of the doubles is scaled by 2^stretch (directional lights)
  bool narrow_;         // q fits into 64 bits
  std::array<std::int64_t, 3> narrow_light_{};
  std::array<Ball, 3> light_enclosure_;  // position times 2^-b, or direction times a power of two
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> plane_of_edge_;  // edge -> plane, kExplicit if not made yet
  std::vector<Vector3<mpz_class>> explicit_;
  std::vector<unsigned> explicit_bits_;
  std::unordered_map<std::uint64_t, PlaneRef> traces_;     // (support plane, cutting plane)
  std::map<std::array<std::uint64_t, 3>, PlaneRef> cuts_;  // (other light, its plane, support)
  Stats stats_;
};

extern template class PlaneLightSpace<NoStats>;
extern template class PlaneLightSpace<CountStats>;

}  // namespace gnomon

#endif  // GNOMON_KERNEL_PLANE_LIGHT_SPACE_H
