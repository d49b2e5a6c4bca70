// SPDX-License-Identifier: LGPL-3.0-or-later
// What the volume spaces of all kernels that construct their vertices have in common: planes by
// number, and what is known by identity. The arithmetic is the derived kernel's.
//
// Planes [0, planes) are the scene's support planes, [planes, planes + edges) name input edges and
// are never asked, and all others are a stack of each fork's own, above those that forks share, so
// that they share nothing that changes.
//
// Identities: (1) a corner is on the support plane of its loop and on the planes of its edges;
// (2) a plane contains the three corners that it was made from, input vertices and made ones alike;
// (3) it contains every corner on an input edge both of whose ends it was made from. Exactness: the
// derived kernel's.
#ifndef GNOMON_KERNEL_CONCEPT_CONSTRUCTED_VOLUME_SPACE_H
#define GNOMON_KERNEL_CONCEPT_CONSTRUCTED_VOLUME_SPACE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/concept/plane_takeover.h"
#include "kernel/concept/shared_stack.h"
#include "kernel/signs/corner.h"

namespace gnomon {

/// The derived kernel has, for its friend, all without identity:
///  - std::optional<Plane> plane_of(const Vertex&, const Vertex&, const Vertex&) const;
///    the plane through three points;
///  - std::optional<Plane> plane_of(const Vertex&, const Vertex&, const LightPoint&) const;
///    the plane through two points and along a direction;
///  - Plane axis_plane(int axis, double value) const;
///  - Side side(const Plane&, const Vertex&) const;
///    the side of an oriented plane;
///  - Vertex meet(const Plane&, const Vertex&, const Vertex&) const;
///    where an edge meets a plane.
/// Its scene space has
///  - Side side_of_support(PlaneId, const Vertex&) const.
template <class Derived, class Scene, class Plane>
class ConstructedVolumeSpace {
 public:
  using SceneSpace = Scene;
  using Vertex = typename Scene::Vertex;
  static constexpr bool kExact = Scene::kExact;

  /// Whether corners are known to be on the planes that made them.
  bool knows_identity() const { return identity_; }
  const Geometry& geometry() const { return scene_->geometry(); }
  SceneEdges edges() const { return scene_->edges(); }
  Vertex input_vertex(VertexId v) const { return scene_->input_vertex(v); }
  Derived fork() const { return self(); }

  /// The plane through three points, counter-clockwise seen from its front: normal (b - a) x (c -
  /// a). Not valid() if the kernel finds them on one line.
  PlaneRef add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b, const Corner<Vertex>& c) {
    return push(self().plane_of(a.vertex, b.vertex, c.vertex),
                {name_of(a), name_of(b), name_of(c)});
  }
  /// With the point at infinity towards a directional light as c: normal (b - a) x to_light.
  PlaneRef add_plane(const Corner<Vertex>& a, const Corner<Vertex>& b,
                     const LightPoint& direction) {
    return push(self().plane_of(a.vertex, b.vertex, direction), {name_of(a), name_of(b), kNoPoint});
  }
  /// Where a coordinate is `value` times the grid's extent, 2^b steps on every axis; the front is
  /// where it is larger.
  PlaneRef add_axis_plane(int axis, double value) {
    return push(self().axis_plane(axis, value), {kNoPoint, kNoPoint, kNoPoint});
  }
  std::uint32_t plane_mark() const { return static_cast<std::uint32_t>(own_.size()); }
  void release_planes(std::uint32_t mark) { own_.truncate(mark); }

  /// As TakesPlanes has them.
  void reserve_planes(std::size_t more) { own_.reserve(own_.size() + more); }
  void share_planes() { own_.share(); }
  PlaneShift take_planes(Derived fork) {
    const PlaneShift shift{first_own_, plane_mark()};
    for (OwnPlane& own : static_cast<ConstructedVolumeSpace&>(fork).own_.take()) {
      for (PointName& point : own.points) {
        if (point[1] == kNone) continue;  // an input vertex, or none
        for (std::uint32_t& plane : point) plane += plane < shift.first ? 0 : shift.by;
      }
      own_.push_back(std::move(own));
    }
    return shift;
  }

  /// Requires: not the name of an input edge.
  Side side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) const {
    if (identity_ && (ref.same_plane(corner.before) || ref.same_plane(corner.after) ||
                      ref.index() == corner.support)) {
      return Side::kOn;
    }
    Side side;
    if (ref.index() < planes_) {
      const SupportTriple& triple = geometry().planes[ref.index()];
      if (identity_ && is_made_from({triple.a, triple.b, triple.c}, corner)) return Side::kOn;
      side = scene_->side_of_support(ref.index(), corner.vertex);
    } else {
      const OwnPlane& own = own_[ref.index() - first_own_];
      if (identity_ && (is_made_from(own.inputs, corner) ||
                        (own.has_made && corner.vertex.source == kMadeVertex &&
                         contains(own.points, name_of(corner))))) {
        return Side::kOn;
      }
      side = self().side(own.plane, corner.vertex);
    }
    return ref.flipped() ? opposite(side) : side;
  }
  /// Requires: the ends are strictly on different sides.
  Vertex crossing(PlaneRef ref, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const {
    if (ref.index() < planes_) return scene_->crossing(ref, edge, leaving, from, to);
    return self().meet(own_[ref.index() - first_own_].plane, from.vertex, to.vertex);
  }

  std::string describe(PlaneRef ref) const {
    if (ref.index() < planes_) return "support plane " + std::to_string(ref.index());
    if (ref.index() < first_own_) return "input edge " + std::to_string(ref.index() - planes_);
    std::string text = "the plane of";
    for (const PointName& point : own_[ref.index() - first_own_].points) {
      text += point == kNoPoint   ? " -"
              : point[1] == kNone ? " " + std::to_string(point[0])
                                  : " (a made point)";
    }
    return text;
  }
  StageCounts stage_counts() const { return {}; }

 protected:
  /// `scene` must outlive the space and its forks, which only read it.
  ConstructedVolumeSpace(const Scene& scene, bool identity)
      : scene_(&scene),
        identity_(identity),
        planes_(scene.edges().planes),
        first_own_(planes_ + static_cast<std::uint32_t>(scene.geometry().edges.size())) {}

  const Scene& scene() const { return *scene_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  /// An input vertex and twice kNone, or the three planes of a made point, sorted.
  using PointName = std::array<std::uint32_t, 3>;
  static constexpr PointName kNoPoint{kNone, kNone, kNone};
  struct OwnPlane {
    Plane plane;
    std::array<PointName, 3> points;  // that it was made from
    std::array<VertexId, 3> inputs;   // those of them that are input vertices; else kNone
    bool has_made = false;            // whether some are made
  };

  static constexpr PointName input(VertexId v) { return {v, kNone, kNone}; }
  static PointName name_of(const Corner<Vertex>& corner) {
    if (corner.vertex.source != kMadeVertex) return input(corner.vertex.source);
    PointName name{corner.before.index(), corner.after.index(), corner.support};
    if (name[0] > name[1]) std::swap(name[0], name[1]);
    if (name[1] > name[2]) std::swap(name[1], name[2]);
    if (name[0] > name[1]) std::swap(name[0], name[1]);
    return name;
  }
  static bool contains(const std::array<PointName, 3>& points, const PointName& name) {
    return points[0] == name || points[1] == name || points[2] == name;
  }
  /// Identities (2), as far as input vertices go, and (3).
  bool is_made_from(const std::array<VertexId, 3>& inputs, const Corner<Vertex>& corner) const {
    const VertexId source = corner.vertex.source;
    if (source != kMadeVertex) return contains(inputs, source);
    return has_ends(inputs, corner.before) || has_ends(inputs, corner.after);
  }
  static bool contains(const std::array<VertexId, 3>& inputs, VertexId v) {
    return v == inputs[0] || v == inputs[1] || v == inputs[2];
  }
  bool has_ends(const std::array<VertexId, 3>& inputs, PlaneRef edge) const {
    if (edge.index() < planes_ || edge.index() >= first_own_) return false;
    const EdgeEnds ends = geometry().edges[edge.index() - planes_];
    return contains(inputs, ends.a) && contains(inputs, ends.b);
  }

  const Derived& self() const { return static_cast<const Derived&>(*this); }
  PlaneRef push(std::optional<Plane> plane, const std::array<PointName, 3>& points) {
    if (!plane) return {};
    OwnPlane own{std::move(*plane), points, {}, false};
    for (std::size_t i = 0; i < 3; ++i) {
      own.inputs[i] = points[i][1] == kNone ? points[i][0] : kNone;
      own.has_made = own.has_made || points[i][1] != kNone;
    }
    own_.push_back(std::move(own));
    return PlaneRef(first_own_ + static_cast<std::uint32_t>(own_.size() - 1));
  }

  const Scene* scene_;
  bool identity_;
  std::uint32_t planes_;
  std::uint32_t first_own_;
  SharedStack<OwnPlane> own_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_CONSTRUCTED_VOLUME_SPACE_H
