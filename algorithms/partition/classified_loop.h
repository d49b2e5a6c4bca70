// SPDX-License-Identifier: LGPL-3.0-or-later
// A loop of light space with its class under that light, as the methods for point and directional
// lights put it out.
#ifndef GNOMON_ALGORITHMS_PARTITION_CLASSIFIED_LOOP_H
#define GNOMON_ALGORITHMS_PARTITION_CLASSIFIED_LOOP_H

#include <cstdint>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "gnomon/algorithms/shadow_result.h"

namespace gnomon {

/// FilteredLoops holds loops, each in a cell of a tree. `CellLoop` has a range `loop` of `loops`,
/// and `is_like(other)`: whether the cells of two loops are of one class, so that the loops may be
/// merged.
template <class Vertex, class CellLoop>
struct FilteredLoops {
  LoopStore<Vertex> loops;
  std::vector<CellLoop> fragments;

  void clear() {
    loops.clear();
    fragments.clear();
  }
};

struct ClassifiedLoop {
  LoopRange loop;
  LightState state = LightState::kLit;
  std::uint32_t caster = Fragment::kNoCaster;
  ShadowReason reason = ShadowReason::kNone;
  std::uint32_t casters = Fragment::kNoCaster;  // as Fragment::casters

  bool is_like(const ClassifiedLoop& other) const {
    return state == other.state && caster == other.caster && reason == other.reason &&
           casters == other.casters;
  }
};

template <class Vertex>
struct ClassifiedLoops : FilteredLoops<Vertex, ClassifiedLoop> {
  void add(const LoopView<Vertex>& loop, LightState state, std::uint32_t caster) {
    this->fragments.push_back({this->loops.append(loop), state, caster});
  }
  void add_lit(const LoopView<Vertex>& loop) { add(loop, LightState::kLit, Fragment::kNoCaster); }
  void add_shadow(const LoopView<Vertex>& loop, std::uint32_t caster) {
    add(loop, LightState::kShadow, caster);
  }
  /// What the light's region does not hold.
  void add_outside(const LoopView<Vertex>& loop) {
    add(loop, LightState::kShadow, Fragment::kNoCaster);
    this->fragments.back().reason = ShadowReason::kOutsideRegion;
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_CLASSIFIED_LOOP_H
