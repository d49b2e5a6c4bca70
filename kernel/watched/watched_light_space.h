// SPDX-License-Identifier: LGPL-3.0-or-later
// The light space of watched runs: kernel `plane`, a rounded kernel beside it if one is tested, and
// the watch that settles every decision (decision_watch.h).
//
// Planes of the two kernels are numbered apart. Planes [0, edges) are those of the input edges in
// both, if the rounded one knows by identity, and the numbers of the watched space are the same;
// all others have a number here and a table. Without identity an edge has no plane in the rounded
// kernel until it computes one.
#ifndef GNOMON_KERNEL_WATCHED_WATCHED_LIGHT_SPACE_H
#define GNOMON_KERNEL_WATCHED_WATCHED_LIGHT_SPACE_H

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kernel/implicit/implicit_light_space.h"
#include "kernel/watched/watched_scene_space.h"

namespace gnomon {

class WatchedLightSpace {
 public:
  /// Kernel `plane`, and the integers behind its planes.
  struct Exact : ImplicitLightSpace<NoStats> {
    using ImplicitLightSpace::ImplicitLightSpace;
    ExactPlane<mpz_class> in_scene(PlaneRef plane) const {
      return integers().in_scene(exact_normal<mpz_class>(plane));
    }
    /// Its value at the light is that of a directional one's direction, or of the point.
    const LightPoint& light() const { return integers().light; }
  };
  using SceneSpace = WatchedSceneSpace;
  using Vertex = WatchedVertex<Exact::Vertex>;
  static constexpr bool kExact = false;
  static constexpr bool kParallel = false;
  static constexpr bool kMakesPlanesOfVertices = false;

  WatchedLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options)
      : scene_(&scene),
        watch_(&scene.watch()),
        edge_count_(static_cast<std::uint32_t>(scene.geometry().edges.size())),
        exact_(scene.exact(), light, options),
        rounded_(scene.rounded() != nullptr ? scene.rounded()->light(light) : nullptr) {}
  WatchedLightSpace(WatchedLightSpace&&) = default;
  WatchedLightSpace fork() const { return WatchedLightSpace(*this); }

  bool knows_identity() const { return scene_->knows_identity(); }
  Sign light_side(PlaneId plane) const;

  PlaneRef import_edge(PlaneRef edge, PlaneId support, bool reversed, const Vertex& from,
                       const Vertex& to);
  Vertex import_vertex(const SceneSpace::Vertex& vertex) const {
    return {
        exact_.import_vertex(vertex.exact), vertex.tested, vertex.source, 0, {}, {}, vertex.hash};
  }
  void finish_vertex(Vertex& vertex, PlaneRef before, PlaneRef after) const;
  PlaneRef shadow_plane(PlaneRef edge, const Vertex& from, const Vertex& to);
  PlaneRef add_prefix_plane(const PrefixPlane& plane);
  PlaneRef import_cut(const WatchedLightSpace& other, PlaneRef plane, PlaneId support);
  PlaneRef cut_of_supports(PlaneId first, PlaneId second);
  /// The rounded kernel makes the planes of edges when they are imported.
  void make_edge_planes(EdgeId begin, EdgeId end) { exact_.make_edge_planes(begin, end); }
  std::uint32_t plane_mark() const { return static_cast<std::uint32_t>(own_.size()); }
  void release_planes(std::uint32_t mark);

  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner);
  Side side_of_support(PlaneId plane, const Corner<Vertex>& corner);
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;

  ChartPoint chart_point(const LightChart& chart, const Corner<Vertex>& corner) const {
    return exact_.chart_point(chart, exact_corner(corner));
  }
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const {
    return exact_.position(exact_corner(corner));
  }
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const {
    return exact_.exact_position(exact_corner(corner));
  }
  StageCounts stage_counts() const { return {}; }

 private:
  struct Plane {
    PlaneRef exact, tested;
    PlaneName name;
    std::uint64_t hash = 0;
    bool is_support_cut = false;                    // made by cut_of_supports()
    std::uint32_t exact_mark = 0, tested_mark = 0;  // of both kernels before it was added
  };

  WatchedLightSpace(const WatchedLightSpace& other)
      : scene_(other.scene_),
        watch_(other.watch_),
        edge_count_(other.edge_count_),
        exact_(other.exact_),
        rounded_(other.rounded_ ? other.rounded_->fork() : nullptr),
        own_(other.own_) {}

  /// A plane as both kernels have it, in the orientation of the reference.
  Plane at(PlaneRef ref) const;
  Plane new_plane() const;
  PlaneRef add(Plane plane, const PlaneName& name);
  bool is_there(PlaneRef ref) const { return ref.index() < edge_count_ + own_.size(); }
  Corner<Exact::Vertex> exact_corner(const Corner<Vertex>& corner) const {
    const Corner<Vertex> c =
        known_corner(corner, watch_->flips(), [&](const Corner<Vertex>& made) -> std::uint64_t {
          if (!is_there(made.before) || !is_there(made.after)) return 0;
          return hash_of_meeting(at(made.before), at(made.after));
        });
    return {at(c.before).exact, c.vertex.exact, at(c.after).exact, corner.support};
  }
  WideCorner tested_corner(const Corner<Vertex>& c) const {
    return {at(c.before).tested, c.vertex.tested, at(c.after).tested, c.support};
  }
  static Predicate predicate_of(const PlaneName& name);
  static std::uint64_t hash_of_meeting(const Plane& before, const Plane& after);
  /// Rounded kernels have a made vertex on the support plane of its loop, not on its ray.
  static std::uint64_t hash_of_corner(const Corner<Vertex>& corner) {
    const bool made = corner.vertex.source == kMadeVertex;
    return made ? mixed(corner.vertex.hash, corner.support) : corner.vertex.hash;
  }
  std::uint64_t question(const Plane& plane, const Corner<Vertex>& corner) const {
    return watch_->question(predicate_of(plane.name), plane.hash, hash_of_corner(corner));
  }
  void describe(DifferingDecision& decision, const PlaneName& name,
                const ExactPlane<mpz_class>& plane, const Corner<Vertex>& corner) const;

  SceneSpace* scene_;
  DecisionWatch* watch_;
  std::uint32_t edge_count_;
  Exact exact_;
  std::unique_ptr<RoundedLight> rounded_;
  std::vector<Plane> own_;  // after those of the edges; a stack
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_WATCHED_WATCHED_LIGHT_SPACE_H
