// SPDX-License-Identifier: LGPL-3.0-or-later
// What an algorithm may ask of a kernel. The same BSP and SVBSP source runs on every type that
// models these concepts; it asks for decisions and constructions and does no arithmetic on
// coordinates itself.
#ifndef GNOMON_KERNEL_CONCEPT_KERNEL_CONCEPT_H
#define GNOMON_KERNEL_CONCEPT_KERNEL_CONCEPT_H

#include <array>
#include <concepts>

#include "gnomon/kernel/geometry.h"
#include "gnomon/kernel/kernel_options.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/concept/light_space.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/corner.h"

namespace gnomon {

/// A space in which convex loops are split by planes: the scene's, or that of one light.
///
/// side_of_plane(plane, corner) is the side of `plane`, in the orientation of the reference, on
/// which the corner's vertex lies: kFront, kOn or kBack (orientation.h). Of every kernel holds
///  (1) side_of_plane(-plane, corner) is the opposite side;
///  (2) the same question has the same answer, whatever was asked before.
/// Of exact kernels, and of rounded ones with identity, holds
///  (3) a corner is on the planes of its two edges and on the support plane of its loop.
/// Exactness: exact kernels answer for the exact point. Degree and bits: those of the space, see
/// precision_plan.h; kernel `plane` states them with each predicate.
///
/// crossing(plane, edge, leaving, from, to) is the vertex where the edge from `from` to `to` meets
/// `plane`. Requires: the two ends are strictly on different sides of `plane`; `leaving` tells
/// whether `from` is in front. It is a construction: exact on exact kernels, rounded on all others.
template <class S>
concept DecisionSpace = requires(S& space, const S& constant, PlaneRef plane, bool leaving,
                                 const Corner<typename S::Vertex>& corner) {
  typename S::Vertex;
  { S::kExact } -> std::convertible_to<bool>;
  { space.side_of_plane(plane, corner) } -> std::same_as<Side>;
  { constant.crossing(plane, plane, leaving, corner, corner) } -> std::same_as<typename S::Vertex>;
  { constant.stage_counts() } -> std::same_as<StageCounts>;
};

/// Three dimensions: decisions of the scene BSP about support planes.
template <class S>
concept SceneSpaceModel = DecisionSpace<S> &&
    std::constructible_from<S, const Geometry&, const KernelOptions&> &&
    requires(const S& space, VertexId id, const typename S::Vertex& vertex) {
  { space.input_vertex(id) } -> std::same_as<typename S::Vertex>;
  { space.approximate(vertex) } -> std::same_as<std::array<double, 3>>;
  { space.edges() } -> std::same_as<SceneEdges>;
};

/// A space that can say where a corner is, so that areas can be measured.
template <class S>
concept MeasuredSpace = DecisionSpace<S> &&
    requires(const S& constant, const Corner<typename S::Vertex>& corner) {
  { constant.position(corner) } -> std::same_as<std::array<Ball, 3>>;
  { constant.exact_position(corner) } -> std::same_as<std::array<mpq_class, 3>>;
};

/// Planes through one light: decisions of the SVBSP tree.
template <class S>
concept LightSpaceModel = DecisionSpace<S> && SceneSpaceModel<typename S::SceneSpace> &&
    std::constructible_from<S, typename S::SceneSpace&, const LightPoint&, const KernelOptions&> &&
    requires(S& space, const S& constant, PlaneRef ref, PlaneId plane, bool reversed,
             typename S::Vertex& vertex, const typename S::SceneSpace::Vertex& scene_vertex,
             const Corner<typename S::Vertex>& corner, const PrefixPlane& prefix,
             std::uint32_t mark) {
  { constant.knows_identity() } -> std::same_as<bool>;
  /// Whether shadow_plane() makes a plane through the ends of an edge that has none (not valid()):
  /// then edges that other lights cut may cast.
  { S::kMakesPlanesOfVertices } -> std::convertible_to<bool>;
  { constant.light_side(plane) } -> std::same_as<Sign>;
  { space.import_edge(ref, plane, reversed, vertex, vertex) } -> std::same_as<PlaneRef>;
  { constant.import_vertex(scene_vertex) } -> std::same_as<typename S::Vertex>;
  /// Planes other than those of edges are a stack: release_planes(m) forgets those added since
  /// plane_mark() was m.
  { constant.plane_mark() } -> std::same_as<std::uint32_t>;
  space.release_planes(mark);
  constant.finish_vertex(vertex, ref, ref);
  /// The plane through the light of a fragment's edge, given by the plane that made it and its
  /// ends.
  { space.shadow_plane(ref, vertex, vertex) } -> std::same_as<PlaneRef>;
  { space.add_prefix_plane(prefix) } -> std::same_as<PlaneRef>;
  { constant.position(corner) } -> std::same_as<std::array<Ball, 3>>;
  { constant.exact_position(corner) } -> std::same_as<std::array<mpq_class, 3>>;
};

/// What the sectors algorithm needs besides: it has no order of the polygons, so it compares their
/// depths, cuts one polygon where it passes through the plane of another, and runs on many threads.
template <class S>
concept SectorSpaceModel = LightSpaceModel<S> &&
    requires(S& space, const S& constant, EdgeId edge, PlaneId plane, const LightChart& chart,
             const Corner<typename S::Vertex>& corner) {
  /// Whether forks may be used by different threads at the same time.
  { S::kParallel } -> std::convertible_to<bool>;
  /// A space with the same planes so far; what either adds later is its own. Cheap: edge planes are
  /// shared. The original must outlive it and make no more edge planes.
  { constant.fork() } -> std::same_as<S>;
  /// Makes the planes of the edges [edge, edge) ahead, so that import_edge of a whole polygon only
  /// looks them up. Disjoint ranges may be made by different threads if kParallel. An edge's plane
  /// that was not made ahead is made by the first import_edge that asks for it, so that one thread
  /// alone need not call this.
  space.make_edge_planes(edge, edge);
  /// On which side of a support plane, in its own orientation, is the corner, a point of the
  /// support plane of its loop?
  { space.side_of_support(plane, corner) } -> std::same_as<Side>;
  /// A plane that cuts support plane `first` where `second` does; its front is the part of `first`
  /// in front of `second`. Not for planes that do not meet in a line. It cuts loops of `first`
  /// only, since it may be `second` itself: what else is to be cut there wants shadow_plane() of
  /// the edge that it made.
  { space.cut_of_supports(plane, plane) } -> std::same_as<PlaneRef>;
  { constant.chart_point(chart, corner) } -> std::same_as<ChartPoint>;
};

/// What area lights need, in three dimensions: planes through three points (of casters and lights),
/// and the sides that the corners of loops have of them. A *corner* names a point: an input vertex,
/// or a made one by its loop's support plane and the planes of its two edges; the support of a face
/// of a shadow volume is a plane added here. Geometry holds the vertices, edges and planes of the
/// lights, too.
///
/// A plane is named as in scene space (SceneEdges): below edges().planes a support plane; then the
/// input edges, which are names of edges of loops and cut nothing; from `planes + edges` on the
/// planes added here, a stack.
template <class S>
concept VolumeSpaceModel = DecisionSpace<S> && SceneSpaceModel<typename S::SceneSpace> &&
    std::constructible_from<S, const typename S::SceneSpace&, const KernelOptions&> &&
    requires(S& space, const S& constant, VertexId id, int axis, double value, std::uint32_t mark,
             const LightPoint& direction, const Corner<typename S::Vertex>& corner,
             const std::array<double, 3>& fractions) {
  /// Whether forks may be used by different threads at the same time.
  { S::kParallel } -> std::convertible_to<bool>;
  /// A space with the same planes so far; what either adds later is its own.
  { constant.fork() } -> std::same_as<S>;
  { constant.geometry() } -> std::same_as<const Geometry&>;
  { constant.edges() } -> std::same_as<SceneEdges>;
  { constant.input_vertex(id) } -> std::same_as<typename S::Vertex>;
  /// The plane through three points, counter-clockwise seen from its front; not valid() if they are
  /// on one line. Support planes and edges named by the corners must not be added planes: the
  /// points are of input polygons, or of lights cut by support planes.
  { space.add_plane(corner, corner, corner) } -> std::same_as<PlaneRef>;
  /// The same with a third point at infinity: the plane through two points and along a direction.
  { space.add_plane(corner, corner, direction) } -> std::same_as<PlaneRef>;
  /// The plane on which coordinate `axis` is `value` of the grid's extent, 0 to 1; its front is
  /// where the coordinate is larger.
  { space.add_axis_plane(axis, value) } -> std::same_as<PlaneRef>;
  /// The made vertex where three such planes meet; the caller names it by them.
  { constant.axis_point(fractions) } -> std::same_as<typename S::Vertex>;
  { constant.plane_mark() } -> std::same_as<std::uint32_t>;
  space.release_planes(mark);
  /// Fractions of the grid's extent (all axes alike): certified on exact kernels.
  { constant.position(corner) } -> std::same_as<std::array<Ball, 3>>;
  /// Scene units; the exact point on exact kernels.
  { constant.exact_position(corner) } -> std::same_as<std::array<mpq_class, 3>>;
  /// Scene units; the nearest doubles on exact kernels.
  { constant.nearest_position(corner) } -> std::same_as<std::array<double, 3>>;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_KERNEL_CONCEPT_H
