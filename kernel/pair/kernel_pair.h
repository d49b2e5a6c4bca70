// SPDX-License-Identifier: LGPL-3.0-or-later
// Two kernels in lock-step: a space that asks a kernel under test and a reference kernel every
// question, goes on with the reference's answer, and keeps the first decision on which they differ,
// in words. Any algorithm runs on a pair unchanged, so that it shows *where* a rounded kernel first
// went wrong.
//
// Planes of the two kernels are numbered independently; the pair has numbers of its own and a
// table. Reference: CGAL's Filtered_kernel checker (Kernel_checker) for the idea.
#ifndef GNOMON_KERNEL_PAIR_KERNEL_PAIR_H
#define GNOMON_KERNEL_PAIR_KERNEL_PAIR_H

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/kernel/differing_decision.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// What both spaces of a pair share: the record, and the wish to stop.
struct LockStep {
  std::optional<DifferingDecision> first;
  std::atomic<bool> stop{false};
  std::uint64_t decisions = 0;
};

struct PairOptions : KernelOptions {
  LockStep* lock_step = nullptr;
};

template <class A, class B>
struct PairVertex {
  A tested;
  B exact;
  VertexId source = kMadeVertex;
};

std::string describe_vertex(VertexId source);

template <SceneSpaceModel Tested, SceneSpaceModel Exact>
class PairSceneSpace {
 public:
  using Vertex = PairVertex<typename Tested::Vertex, typename Exact::Vertex>;
  static constexpr bool kExact = Exact::kExact;

  PairSceneSpace(const Geometry& geometry, const KernelOptions& options)
      : tested_(geometry, options),
        exact_(geometry, options),
        lock_step_(static_cast<const PairOptions&>(options).lock_step) {}

  Vertex input_vertex(VertexId v) const {
    return {tested_.input_vertex(v), exact_.input_vertex(v), v};
  }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) {
    const Side tested = tested_.side_of_plane(plane, tested_corner(corner));
    const Side exact = exact_.side_of_plane(plane, exact_corner(corner));
    if (tested != exact && !lock_step_->first) {
      lock_step_->first = DifferingDecision{
          "support plane " + std::to_string(plane.index()) + " of the scene BSP",
          describe_vertex(corner.vertex.source),
          corner.vertex.source != kMadeVertex ? geometry().positions[corner.vertex.source]
                                              : exact_.approximate(corner.vertex.exact),
          tested_.approximate(corner.vertex.tested),
          corner.support,
          tested,
          exact,
          lock_step_->decisions};
      lock_step_->stop = true;
    }
    ++lock_step_->decisions;
    return exact;
  }
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const {
    return {tested_.crossing(plane, edge, leaving, tested_corner(from), tested_corner(to)),
            exact_.crossing(plane, edge, leaving, exact_corner(from), exact_corner(to)),
            kMadeVertex};
  }
  const Geometry& geometry() const { return exact_.geometry(); }
  SceneEdges edges() const { return exact_.edges(); }
  std::array<double, 3> approximate(const Vertex& vertex) const {
    return exact_.approximate(vertex.exact);
  }
  StageCounts stage_counts() const { return {}; }
  Tested& tested() { return tested_; }
  Exact& exact() { return exact_; }
  LockStep& lock_step() const { return *lock_step_; }

 private:
  static Corner<typename Tested::Vertex> tested_corner(const Corner<Vertex>& c) {
    return {c.before, c.vertex.tested, c.after, c.support};
  }
  static Corner<typename Exact::Vertex> exact_corner(const Corner<Vertex>& c) {
    return {c.before, c.vertex.exact, c.after, c.support};
  }

  Tested tested_;
  Exact exact_;
  LockStep* lock_step_;
};

template <LightSpaceModel Tested, LightSpaceModel Exact>
class PairLightSpace {
 public:
  using SceneSpace = PairSceneSpace<typename Tested::SceneSpace, typename Exact::SceneSpace>;
  using Vertex = PairVertex<typename Tested::Vertex, typename Exact::Vertex>;
  static constexpr bool kExact = Exact::kExact;

  PairLightSpace(SceneSpace& scene, const LightPoint& light, const KernelOptions& options)
      : tested_(scene.tested(), light, options),
        exact_(scene.exact(), light, options),
        scene_(&scene),
        lock_step_(&scene.lock_step()) {}

  bool knows_identity() const { return tested_.knows_identity(); }
  Sign light_side(PlaneId plane) const {
    const Sign tested = tested_.light_side(plane), exact = exact_.light_side(plane);
    if (tested != exact && !lock_step_->first) {
      lock_step_->first = DifferingDecision{"support plane " + std::to_string(plane),
                                            "the light",
                                            {},
                                            {},
                                            plane,
                                            side_of(tested),
                                            side_of(exact),
                                            lock_step_->decisions};
      lock_step_->stop = true;
    }
    ++lock_step_->decisions;
    return exact;
  }
  PlaneRef import_edge(PlaneRef edge, PlaneId support, bool reversed, const Vertex& from,
                       const Vertex& to) {
    return add(tested_.import_edge(edge, support, reversed, from.tested, to.tested),
               exact_.import_edge(edge, support, reversed, from.exact, to.exact));
  }
  Vertex import_vertex(const typename SceneSpace::Vertex& vertex) const {
    return {tested_.import_vertex(vertex.tested), exact_.import_vertex(vertex.exact),
            vertex.source};
  }
  void finish_vertex(Vertex& vertex, PlaneRef before, PlaneRef after) const {
    tested_.finish_vertex(vertex.tested, tested_ref(before), tested_ref(after));
    exact_.finish_vertex(vertex.exact, exact_ref(before), exact_ref(after));
  }
  PlaneRef shadow_plane(PlaneRef edge, const Vertex& from, const Vertex& to) {
    return add(tested_.shadow_plane(tested_ref(edge), from.tested, to.tested),
               exact_.shadow_plane(exact_ref(edge), from.exact, to.exact));
  }
  PlaneRef add_prefix_plane(const PrefixPlane& plane) {
    return add(tested_.add_prefix_plane(plane), exact_.add_prefix_plane(plane));
  }
  Side side_of_plane(PlaneRef plane, const Corner<Vertex>& corner) {
    const Side tested = tested_.side_of_plane(tested_ref(plane), tested_corner(corner));
    const Side exact = exact_.side_of_plane(exact_ref(plane), exact_corner(corner));
    if (tested != exact && !lock_step_->first) {
      const std::array<Ball, 3> rounded = tested_.position(tested_corner(corner));
      const std::array<mpq_class, 3> point = exact_.exact_position(exact_corner(corner));
      DifferingDecision decision{exact_.describe(exact_ref(plane)),
                                 describe_vertex(corner.vertex.source),
                                 {},
                                 {},
                                 corner.support,
                                 tested,
                                 exact,
                                 lock_step_->decisions};
      for (int k = 0; k < 3; ++k) {
        decision.position[k] = corner.vertex.source != kMadeVertex
                                   ? scene_->geometry().positions[corner.vertex.source][k]
                                   : point[k].get_d();
        decision.tested_position[k] = rounded[k].middle;
      }
      if (corner.vertex.source == kMadeVertex) {
        decision.vertex += ", where " + exact_.describe(exact_ref(corner.before)) + " meets " +
                           exact_.describe(exact_ref(corner.after));
      }
      lock_step_->first = std::move(decision);
      lock_step_->stop = true;
    }
    ++lock_step_->decisions;
    return exact;
  }
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const {
    return {tested_.crossing(tested_ref(plane), tested_ref(edge), leaving, tested_corner(from),
                             tested_corner(to)),
            exact_.crossing(exact_ref(plane), exact_ref(edge), leaving, exact_corner(from),
                            exact_corner(to)),
            kMadeVertex};
  }
  std::array<Ball, 3> position(const Corner<Vertex>& corner) const {
    return exact_.position(exact_corner(corner));
  }
  std::array<mpq_class, 3> exact_position(const Corner<Vertex>& corner) const {
    return exact_.exact_position(exact_corner(corner));
  }
  StageCounts stage_counts() const { return {}; }

 private:
  PlaneRef add(PlaneRef tested, PlaneRef exact) {
    planes_.emplace_back(tested, exact);
    return PlaneRef(static_cast<std::uint32_t>(planes_.size() - 1));
  }
  PlaneRef tested_ref(PlaneRef ref) const {
    const PlaneRef own = planes_[ref.index()].first;
    return ref.flipped() ? -own : own;
  }
  PlaneRef exact_ref(PlaneRef ref) const {
    const PlaneRef own = planes_[ref.index()].second;
    return ref.flipped() ? -own : own;
  }
  Corner<typename Tested::Vertex> tested_corner(const Corner<Vertex>& c) const {
    return {tested_ref(c.before), c.vertex.tested, tested_ref(c.after), c.support};
  }
  Corner<typename Exact::Vertex> exact_corner(const Corner<Vertex>& c) const {
    return {exact_ref(c.before), c.vertex.exact, exact_ref(c.after), c.support};
  }

  Tested tested_;
  Exact exact_;
  const SceneSpace* scene_;
  LockStep* lock_step_;
  std::vector<std::pair<PlaneRef, PlaneRef>> planes_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_PAIR_KERNEL_PAIR_H
