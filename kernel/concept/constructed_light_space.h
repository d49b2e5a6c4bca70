// SPDX-License-Identifier: LGPL-3.0-or-later
// What the light spaces of all kernels that construct their vertices have in common: planes by
// number, and what is known by identity. The arithmetic is the derived kernel's.
//
// Planes [0, edges) are the shadow planes of the input edges, so that importing an edge is no more
// than its number; forks share them. All others (prefix planes, cuts, planes of scene BSP splits)
// are a stack of each fork's own. Without identity no edge has a plane of its own, and every shadow
// plane is computed from two vertices and put on the stack.
//
// Identities: (1) the planes of the corner's edges contain it; (2) the plane of edge (a, b)
// contains the input vertices a and b; (3) a support plane contains the loops that lie in it, its
// three defining vertices, and what was cut along it. Exactness: the derived kernel's.
#ifndef GNOMON_KERNEL_CONCEPT_CONSTRUCTED_LIGHT_SPACE_H
#define GNOMON_KERNEL_CONCEPT_CONSTRUCTED_LIGHT_SPACE_H

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/concept/light_space.h"
#include "kernel/signs/corner.h"

namespace gnomon {

/// Identity (3) but for cuts: does the support plane contain the corner's loop, or is the corner
/// one of the three vertices that define it?
template <class Vertex>
bool is_known_on_support(const Geometry& geometry, PlaneId plane, const Corner<Vertex>& corner) {
  if (plane == corner.support) return true;
  const VertexId source = corner.vertex.source;
  if (source == kMadeVertex) return false;
  const SupportTriple& triple = geometry.planes[plane];
  return source == triple.a || source == triple.b || source == triple.c;
}

/// The derived kernel has, for its friend, all without identity:
///  - Plane shadow_plane_of(const Vertex& from, const Vertex& to) const;
///  - Side side(const Plane&, const Vertex&) const;
///    the side of an oriented plane;
///  - Vertex meet(const Plane&, const Vertex&, const Vertex&) const;
///    where an edge meets a plane.
/// Its scene space has
///  - Side side_of_support(PlaneId, const Vertex&) const.
template <class Derived, class Scene, class Plane>
class ConstructedLightSpace {
 public:
  using SceneSpace = Scene;
  using Vertex = typename Scene::Vertex;
  static constexpr bool kExact = Scene::kExact;
  static constexpr bool kMakesPlanesOfVertices = true;

  /// Whether vertices and edges are known to be on the planes that made them.
  bool knows_identity() const { return identity_; }

  /// Edge planes not made yet are made here, so that calling make_edge_planes first is only
  /// necessary before several threads use forks.
  PlaneRef import_edge(PlaneRef scene_edge, PlaneId, bool reversed, const Vertex& from,
                       const Vertex& to) {
    if (!identity_) return {};  // shadow_plane computes it if and when the fragment is inserted
    const SceneEdges names = scene_->edges();
    if (!names.is_input_edge(scene_edge)) return add(self().shadow_plane_of(from, to));
    const EdgeId edge = names.edge(scene_edge);
    if (!edges_[edge].is_made()) make_edge_plane(edge);
    return PlaneRef(edge, scene_edge.flipped() != reversed);
  }
  Vertex import_vertex(const Vertex& vertex) const { return vertex; }
  /// Vertices carry coordinates, so that an edge cut for another light needs no plane here.
  PlaneRef import_cut(const Derived&, PlaneRef, PlaneId) { return {}; }
  void finish_vertex(Vertex&, PlaneRef, PlaneRef) const {}
  /// With identity an edge keeps its plane, unless it was cut along a support plane or for another
  /// light; a new one is computed from the two vertices.
  PlaneRef shadow_plane(PlaneRef edge, const Vertex& from, const Vertex& to) {
    return identity_ && edge.valid() && !is_cut(edge) ? edge
                                                      : add(self().shadow_plane_of(from, to));
  }

  void make_edge_planes(EdgeId begin, EdgeId end) {
    if (!identity_) return;
    for (EdgeId edge = begin; edge < end; ++edge) make_edge_plane(edge);
  }
  Derived fork() const { return self(); }
  std::uint32_t plane_mark() const { return static_cast<std::uint32_t>(own_.size()); }
  void release_planes(std::uint32_t mark) { own_.resize(mark); }
  /// Support plane `second` itself: what it cuts is on it by identity.
  PlaneRef cut_of_supports(PlaneId, PlaneId second) { return push(OwnPlane{{}, second}); }

  Side side_of_plane(PlaneRef ref, const Corner<Vertex>& corner) const {
    if (identity_ && (ref.same_plane(corner.before) || ref.same_plane(corner.after))) {
      return Side::kOn;
    }
    const Plane* plane;
    if (is_edge(ref)) {
      const EdgePlane& edge = edges_[ref.index()];
      const VertexId source = corner.vertex.source;
      if (source != kMadeVertex && (source == edge.a || source == edge.b)) return Side::kOn;
      plane = &edge.plane;
    } else {
      const OwnPlane& own = own_[ref.index() - edge_count_];
      if (own.is_cut()) {
        const Side side = side_of_support(own.support, corner);
        return ref.flipped() ? opposite(side) : side;
      }
      plane = &own.plane;
    }
    const Side side = self().side(*plane, corner.vertex);
    return ref.flipped() ? opposite(side) : side;
  }
  Side side_of_support(PlaneId plane, const Corner<Vertex>& corner) const {
    if (identity_ && (is_known_on_support(scene_->geometry(), plane, corner) ||
                      is_cut_along(corner.before, plane) || is_cut_along(corner.after, plane))) {
      return Side::kOn;
    }
    return scene_->side_of_support(plane, corner.vertex);
  }
  Vertex crossing(PlaneRef ref, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const {
    if (is_edge(ref)) return self().meet(edges_[ref.index()].plane, from.vertex, to.vertex);
    const OwnPlane& own = own_[ref.index() - edge_count_];
    if (own.is_cut()) return scene_->crossing(PlaneRef(own.support), edge, leaving, from, to);
    return self().meet(own.plane, from.vertex, to.vertex);
  }

  std::string describe(PlaneRef ref) const {
    if (is_edge(ref)) {
      const EdgePlane& edge = edges_[ref.index()];
      return "the shadow plane of edge " + std::to_string(edge.a) + "-" + std::to_string(edge.b);
    }
    const OwnPlane& own = own_[ref.index() - edge_count_];
    if (own.is_cut()) return "support plane " + std::to_string(own.support);
    return "a plane through the light";
  }
  StageCounts stage_counts() const { return {}; }

 protected:
  ConstructedLightSpace(Scene& scene, bool identity)
      : scene_(&scene),
        identity_(identity),
        edge_count_(identity ? static_cast<std::uint32_t>(scene.geometry().edges.size()) : 0),
        edges_(std::make_shared<EdgePlane[]>(edge_count_)) {}

  Scene& scene() const { return *scene_; }
  PlaneRef add(Plane plane) { return push(OwnPlane{std::move(plane), kNoSupport}); }

 private:
  static constexpr PlaneId kNoSupport = 0xffffffffu;
  struct EdgePlane {
    Plane plane;
    VertexId a = kMadeVertex, b = kMadeVertex;
    bool is_made() const { return a != kMadeVertex; }
  };
  struct OwnPlane {
    Plane plane;
    PlaneId support = kNoSupport;  // cut_of_supports: the plane is this one
    bool is_cut() const { return support != kNoSupport; }
  };

  const Derived& self() const { return static_cast<const Derived&>(*this); }
  bool is_edge(PlaneRef ref) const { return ref.index() < edge_count_; }
  bool is_cut(PlaneRef ref) const {
    return ref.valid() && !is_edge(ref) && own_[ref.index() - edge_count_].is_cut();
  }
  /// Edges that other lights cut, and corners of no loop, have no plane here.
  bool is_cut_along(PlaneRef ref, PlaneId support) const {
    return ref.valid() && !is_edge(ref) && own_[ref.index() - edge_count_].support == support;
  }
  void make_edge_plane(EdgeId edge) {
    const EdgeEnds ends = scene_->geometry().edges[edge];
    edges_[edge] = {
        self().shadow_plane_of(scene_->input_vertex(ends.a), scene_->input_vertex(ends.b)), ends.a,
        ends.b};
  }
  PlaneRef push(OwnPlane plane) {
    own_.push_back(std::move(plane));
    return PlaneRef(edge_count_ + static_cast<std::uint32_t>(own_.size() - 1));
  }

  Scene* scene_;
  bool identity_;
  std::uint32_t edge_count_;            // with identity, the geometry's; else 0
  std::shared_ptr<EdgePlane[]> edges_;  // shared by forks
  std::vector<OwnPlane> own_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_CONSTRUCTED_LIGHT_SPACE_H
