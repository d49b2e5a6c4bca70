// SPDX-License-Identifier: LGPL-3.0-or-later
// The volume space of watched runs: kernel `plane`, a rounded kernel beside it if one is tested,
// and the watch that settles every decision (decision_watch.h). Support planes and input edges have
// their numbers in both kernels; of planes added here a table holds both.
#ifndef GNOMON_KERNEL_WATCHED_WATCHED_VOLUME_SPACE_H
#define GNOMON_KERNEL_WATCHED_WATCHED_VOLUME_SPACE_H

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "kernel/implicit/implicit_volume_space.h"
#include "kernel/watched/watched_scene_space.h"

namespace gnomon {

class WatchedVolumeSpace {
 public:
  /// Kernel `plane`, and the integers behind its planes.
  struct Exact : ImplicitVolumeSpace<NoStats> {
    using ImplicitVolumeSpace::ImplicitVolumeSpace;
    ExactPlane<mpz_class> in_scene(PlaneRef ref) const {
      const Plane& plane = plane_at(ref.index());
      ExactPlane<mpz_class> result{exact_normal<mpz_class>(plane), 0};
      result.d =
          dot(result.n, position_of<mpz_class>(0)) - exact_value<mpz_class>(plane, result.n, 0);
      return result;
    }
  };
  using SceneSpace = WatchedSceneSpace;
  using Vertex = WatchedVertex<Exact::Vertex>;
  static constexpr bool kExact = false;
  static constexpr bool kParallel = false;

  WatchedVolumeSpace(const SceneSpace& scene, const KernelOptions& options);
  WatchedVolumeSpace(WatchedVolumeSpace&&) = default;
  WatchedVolumeSpace fork() const { return WatchedVolumeSpace(*this); }

  const Geometry& geometry() const { return exact_.geometry(); }
  SceneEdges edges() const { return exact_.edges(); }
  Vertex input_vertex(VertexId v) const;
  PlaneRef add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b, const Corner<Vertex>& c);
  PlaneRef add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b, const LightPoint& direction);
  PlaneRef add_axis_plane(int axis, double value);
  Vertex axis_point(const std::array<double, 3>& fractions) const;
  std::uint32_t plane_mark() const { return static_cast<std::uint32_t>(own_.size()); }
  void release_planes(std::uint32_t mark);

  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner);
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;

  std::array<Ball, 3> position(const Corner<Vertex>& corner) const {
    return exact_.position(exact_corner(corner));
  }
  std::array<Ball, 3> offset(VertexId origin, const Corner<Vertex>& corner) const {
    return exact_.offset(origin, exact_corner(corner));
  }
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const {
    return exact_.exact_position(exact_corner(corner));
  }
  std::array<double, 3> nearest_position(const Corner<Vertex>& corner) const {
    return exact_.nearest_position(exact_corner(corner));
  }
  StageCounts stage_counts() const { return {}; }

 private:
  struct Plane {
    PlaneRef exact, tested;
    PlaneName name;
    std::uint64_t hash = 0;
    std::uint32_t exact_mark = 0, tested_mark = 0;  // of both kernels before it was added
  };

  WatchedVolumeSpace(const WatchedVolumeSpace& other)
      : scene_(other.scene_),
        watch_(other.watch_),
        first_own_(other.first_own_),
        exact_(other.exact_),
        rounded_(other.rounded_ ? other.rounded_->fork() : nullptr),
        own_(other.own_) {}

  /// A plane or an edge as both kernels have it, in the orientation of the reference.
  Plane at(PlaneRef ref) const;
  Plane new_plane() const;
  PlaneRef add(Plane plane);
  /// Whether three points make a plane is a decision: kFront if they do, kOn if they are on a line.
  bool makes_plane(const Plane& plane);
  bool is_there(std::uint32_t plane) const { return plane < first_own_ + own_.size(); }
  Corner<Exact::Vertex> exact_corner(const Corner<Vertex>& corner) const {
    const Corner<Vertex> c =
        known_corner(corner, watch_->flips(), [&](const Corner<Vertex>& made) -> std::uint64_t {
          return is_there(made.before.index()) && is_there(made.after.index()) &&
                         is_there(made.support)
                     ? hash_of_meeting(made.before, made.after, made.support)
                     : 0;
        });
    return {at(c.before).exact, c.vertex.exact, at(c.after).exact, support_at(c.support, false)};
  }
  std::uint64_t hash_of_meeting(PlaneRef before, PlaneRef after, PlaneId support) const;
  WideCorner tested_corner(const Corner<Vertex>& c) const {
    return {at(c.before).tested, c.vertex.tested, at(c.after).tested, support_at(c.support, true)};
  }
  /// A support plane, or an added plane that a face lies in, by the kernel's own number.
  PlaneId support_at(PlaneId support, bool tested) const;
  static Predicate predicate_of(const PlaneName& name);
  std::uint64_t question(const Plane& plane, const Corner<Vertex>& corner) const {
    return watch_->question(predicate_of(plane.name), plane.hash, corner.vertex.hash);
  }
  void describe(DifferingDecision& decision, const Plane& plane,
                const Corner<Vertex>& corner) const;

  const SceneSpace* scene_;
  DecisionWatch* watch_;
  std::uint32_t first_own_;
  Exact exact_;
  std::unique_ptr<RoundedVolume> rounded_;
  std::vector<Plane> own_;  // a stack
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_WATCHED_WATCHED_VOLUME_SPACE_H
