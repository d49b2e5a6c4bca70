// SPDX-License-Identifier: LGPL-3.0-or-later
// The scene space of watched runs: kernel `plane`, a rounded kernel beside it if one is tested, and
// the watch that settles every decision (decision_watch.h).
#ifndef GNOMON_KERNEL_WATCHED_WATCHED_SCENE_SPACE_H
#define GNOMON_KERNEL_WATCHED_WATCHED_SCENE_SPACE_H

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "gnomon/kernel/stage_counts.h"
#include "kernel/implicit/implicit_scene_space.h"
#include "kernel/watched/decision_watch.h"
#include "kernel/watched/watched_vertex.h"

namespace gnomon {

/// What watched spaces have in common: whether a rounded kernel, asked itself, would cut an edge.
template <class Rounded>
bool cuts_edge(Rounded& rounded, PlaneRef plane, const WideCorner& from, const WideCorner& to) {
  const Side side = rounded.side_of_plane(plane, from);
  return side != Side::kOn && side == opposite(rounded.side_of_plane(plane, to));
}

/// The rounded kernel's vertex where the edge `from`, `to` crosses a plane: where it finds the ends
/// on no two sides and would make none, the exact point in its numbers.
template <class Rounded, class ExactPoint>
WideVertex rounded_crossing(Rounded& rounded, PlaneRef plane, PlaneRef edge, bool leaving,
                            const WideCorner& from, const WideCorner& to,
                            const ExactPoint& exact_point) {
  if (cuts_edge(rounded, plane, from, to)) {
    return rounded.crossing(plane, edge, leaving, from, to);
  }
  return rounded_vertex(exact_point());
}

/// Where both kernels have a vertex; `point`: exactly, scene units.
template <class Vertex>
void tell_positions(DifferingDecision& decision, const Geometry& geometry, const Vertex& vertex,
                    const std::array<mpq_class, 3>& point) {
  for (std::size_t k = 0; k < 3; ++k) {
    decision.position[k] =
        vertex.source != kMadeVertex ? geometry.positions[vertex.source][k] : point[k].get_d();
  }
  decision.tested_position = nearest_doubles_of(vertex.tested);
}

class WatchedSceneSpace {
 public:
  using Exact = ImplicitSceneSpace<NoStats>;
  using Vertex = WatchedVertex<Exact::Vertex>;
  /// Methods run as on a rounded kernel, by the ways that hold where decisions contradict each
  /// other.
  static constexpr bool kExact = false;

  WatchedSceneSpace(const Geometry& geometry, const KernelOptions& options)
      : watch_(&DecisionWatch::current()),
        identity_(options.identity),
        exact_(geometry, options),
        rounded_(watch_->make_rounded(geometry, options)) {}

  Vertex input_vertex(VertexId v) const {
    Vertex vertex;
    vertex.exact = exact_.input_vertex(v);
    if (rounded_) vertex.tested = rounded_->input_vertex(v);
    vertex.source = v;
    vertex.hash = hash_of_input(v);
    return vertex;
  }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) {
    const Side exact = exact_.side_of_plane(plane, exact_corner(corner));
    std::optional<Side> tested;
    if (rounded_) tested = rounded_->side_of_plane(plane, tested_corner(corner));
    return watch_->settle(Predicate::kSceneBsp, question(plane, corner), plane.flipped(), exact,
                          tested,
                          [&](DifferingDecision& decision) { describe(decision, plane, corner); });
  }
  /// A flipped vertex is an input vertex here, and so known in every space.
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const {
    for (const Corner<Vertex>* end : {&from, &to}) {
      if (watch_->flips() && watch_->is_flipped(question(plane, *end))) return end->vertex;
    }
    Vertex vertex;
    vertex.exact = exact_.crossing(plane, edge, leaving, exact_corner(from), exact_corner(to));
    name_making(vertex, plane, edge, leaving, from.support);
    vertex.hash =
        hash_of_made(hash_of(name_of(plane)), hash_of(name_of(edge)), false, from.support);
    if (rounded_) {
      const WideCorner a = tested_corner(from), b = tested_corner(to);
      if (cuts_edge(*rounded_, plane, a, b)) {
        vertex.tested = rounded_->crossing(plane, edge, leaving, a, b);
      } else {
        const std::array<double, 3> x = exact_.approximate(vertex.exact);
        for (std::size_t k = 0; k < 3; ++k) vertex.tested.x[k] = x[k];
      }
    }
    return vertex;
  }
  const Geometry& geometry() const { return exact_.geometry(); }
  SceneEdges edges() const { return exact_.edges(); }
  std::array<double, 3> approximate(const Vertex& vertex) const {
    return exact_.approximate(vertex.exact);
  }
  StageCounts stage_counts() const { return {}; }

  bool knows_identity() const { return identity_; }
  DecisionWatch& watch() const { return *watch_; }
  Exact& exact() { return exact_; }
  const Exact& exact() const { return exact_; }
  /// Null in a run with a flipped decision.
  RoundedScene* rounded() const { return rounded_.get(); }

  PlaneName name_of(PlaneRef plane) const {
    const SceneEdges names = edges();
    if (!plane.valid()) return {};
    return names.is_input_edge(plane) ? PlaneName{PlaneName::Kind::kEdge, {names.edge(plane)}}
                                      : PlaneName{PlaneName::Kind::kSupport, {plane.index()}};
  }

 private:
  /// The planes of the scene are always there.
  Corner<Exact::Vertex> exact_corner(const Corner<Vertex>& corner) const {
    const Corner<Vertex> c = known_corner(
        corner, watch_->flips(), [](const Corner<Vertex>& made) { return made.vertex.hash; });
    return {c.before, c.vertex.exact, c.after, c.support};
  }
  static WideCorner tested_corner(const Corner<Vertex>& c) {
    return {c.before, c.vertex.tested, c.after, c.support};
  }
  std::uint64_t question(PlaneRef plane, const Corner<Vertex>& corner) const {
    return watch_->question(Predicate::kSceneBsp, hash_of(name_of(plane)), corner.vertex.hash);
  }
  void describe(DifferingDecision& decision, PlaneRef plane, const Corner<Vertex>& corner) const {
    decision.plane = name_of(plane);
    decision.corner = {corner.vertex.source, name_of(corner.before), name_of(corner.after),
                       corner.support};
    decision.position = corner.vertex.source != kMadeVertex
                            ? geometry().positions[corner.vertex.source]
                            : exact_.approximate(corner.vertex.exact);
    decision.tested_position = nearest_doubles_of(corner.vertex.tested);
    if (decision.exact == Side::kOn) return;
    decision.ulps =
        size_in_ulps(geometry(), ExactGeometry<mpz_class>(geometry()).plane(plane.index()),
                     exact_position(corner), rounded_->digits());
  }
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const;

  DecisionWatch* watch_;
  bool identity_;
  Exact exact_;
  std::unique_ptr<RoundedScene> rounded_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_WATCHED_WATCHED_SCENE_SPACE_H
