// SPDX-License-Identifier: LGPL-3.0-or-later
// From classified loops of light space to the result of one light: loops are grouped by part, a
// part whose loops agree is put out as it came in (1989, sec. 6), areas are measured, points
// exported.
//
// Exactness: on exact kernels fractions are certified enclosures, and exact rationals on request.
#ifndef GNOMON_ALGORITHMS_LIGHTS_LIGHT_SINK_H
#define GNOMON_ALGORITHMS_LIGHTS_LIGHT_SINK_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/lights/light_scene.h"
#include "algorithms/partition/classified_loop.h"
#include "algorithms/partition/fractions.h"

namespace gnomon {

/// Loops of one part after another, in the order in which they came; `start` has one entry more
/// than there are parts.
struct LoopsByPart {
  std::vector<ClassifiedLoop> loops;
  std::vector<std::uint32_t> start;

  LoopsByPart(std::span<const ClassifiedLoop> unsorted, std::size_t parts)
      : loops(unsorted.size()), start(parts + 1, 0) {
    for (const ClassifiedLoop& f : unsorted) ++start[f.loop.part + 1];
    for (std::size_t i = 1; i < start.size(); ++i) start[i] += start[i - 1];
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (const ClassifiedLoop& f : unsorted) loops[next[f.loop.part]++] = f;
  }
  std::span<ClassifiedLoop> of(std::uint32_t part) {
    return {loops.data() + start[part], start[part + 1] - start[part]};
  }
};

template <LightSpaceModel Space>
class LightSink {
 public:
  using Vertex = typename Space::Vertex;

  explicit LightSink(LightScene<Space>& light) : light_(light) {}

  /// The result of loops that tile every part that faces the light. `result` may hold counts.
  LightResult finish(ClassifiedLoops<Vertex>& tiling, LightResult result = {}) {
    return finish(tiling, nullptr, std::move(result));
  }
  /// The same areas, but what is put out is `painted`: shadows over lit polygons, which may overlap
  /// (Cover::kOverlay).
  LightResult finish_overlay(ClassifiedLoops<Vertex>& tiling, ClassifiedLoops<Vertex>& painted,
                             LightResult result = {}) {
    result.cover = Cover::kOverlay;
    result.background = LightState::kLit;
    return finish(tiling, &painted, std::move(result));
  }

 private:
  LightResult finish(ClassifiedLoops<Vertex>& tiling, ClassifiedLoops<Vertex>* painted,
                     LightResult result);
  void put_out(PartResult& part, std::span<const ClassifiedLoop> fragments,
               const LoopStore<Vertex>& loops, LightResult& result);
  /// `exact`: null unless exact fractions are asked for.
  void measure(PartResult& part, ExactFractions* exact, std::span<const ClassifiedLoop> fragments,
               const LoopStore<Vertex>& loops);

  LightScene<Space>& light_;
  LoopStore<Vertex> whole_;
};

template <LightSpaceModel Space>
LightResult LightSink<Space>::finish(ClassifiedLoops<Vertex>& tiling,
                                     ClassifiedLoops<Vertex>* painted, LightResult result) {
  const auto part_count = static_cast<std::uint32_t>(light_.scene.parts.size());
  result.light = light_.light;
  result.facing_parts = light_.facing.parts.size();
  result.facing_edges = light_.facing.edges;
  LoopsByPart tiles(tiling.fragments, part_count);
  tiling.fragments = {};
  LoopsByPart shadows(painted != nullptr ? std::span<const ClassifiedLoop>(painted->fragments)
                                         : std::span<const ClassifiedLoop>(),
                      part_count);
  const bool exactly = light_.options.output.exact_fractions;
  result.parts.reserve(part_count);
  result.exact_fractions.resize(exactly ? part_count : 0);
  for (std::uint32_t index = 0; index < part_count; ++index) {
    PartResult part;
    part.part = index;
    part.side = light_.facing.facing[index].side;
    part.reason = light_.facing.facing[index].reason;
    part.first_fragment = static_cast<std::uint32_t>(result.fragments.size());
    std::span<ClassifiedLoop> own = tiles.of(index);
    std::vector<ClassifiedLoop> outside;
    if (part.reason == ShadowReason::kNone && light_.region.place(index) == RegionPlace::kOutside) {
      outside.push_back({light_.import_part(index, tiling.loops), LightState::kShadow,
                         Fragment::kNoCaster, ShadowReason::kOutsideRegion});
      own = outside;
    }
    if (light_.options.output.merge && own.size() > 1 &&
        std::all_of(own.begin(), own.end(),
                    [&](const ClassifiedLoop& f) { return f.is_like(own[0]); })) {
      // The input polygon as it was (1989, sec. 6).
      own[0].loop = light_.import_part(index, tiling.loops);
      own = own.first(1);
    }
    measure(part, exactly ? &result.exact_fractions[index] : nullptr, own, tiling.loops);
    if (painted != nullptr && outside.empty()) {
      put_out(part, shadows.of(index), painted->loops, result);
    } else {
      put_out(part, own, tiling.loops, result);
    }
    result.parts.push_back(std::move(part));
  }
  return result;
}

template <LightSpaceModel Space>
void LightSink<Space>::put_out(PartResult& part, std::span<const ClassifiedLoop> fragments,
                               const LoopStore<Vertex>& loops, LightResult& result) {
  part.fragment_count = static_cast<std::uint32_t>(fragments.size());
  result.fragment_total += fragments.size();
  for (const ClassifiedLoop& f : fragments) {
    Fragment fragment;
    fragment.state = f.state;
    fragment.caster = f.caster;
    fragment.reason = f.reason;
    fragment.casters = f.casters;
    if (light_.options.keeps_any_points()) {
      export_loop(light_.space, light_.scene.geometry, light_.options,
                  loops.view(f.loop, light_.plane_of(part.part)), fragment, result.points,
                  result.exact_points);
    }
    result.fragments.push_back(fragment);
  }
}

template <LightSpaceModel Space>
void LightSink<Space>::measure(PartResult& part, ExactFractions* exact,
                               std::span<const ClassifiedLoop> fragments,
                               const LoopStore<Vertex>& loops) {
  part.lit = {0, 0};
  part.shadow = {1, 1};
  if (exact != nullptr) exact->shadow = 1;
  if (part.reason != ShadowReason::kNone || fragments.empty()) return;
  if (fragments.size() == 1) {  // fragments tile the part
    if (fragments[0].state == LightState::kLit) {
      std::swap(part.lit, part.shadow);
      if (exact != nullptr) std::swap(exact->lit, exact->shadow);
    }
    return;
  }
  const PlaneId plane = light_.plane_of(part.part);
  const Chart chart = chart_of(light_.scene.geometry, plane);
  whole_.clear();
  const LoopView<Vertex> whole = whole_.view(light_.import_part(part.part, whole_), plane);
  PartMeasure<Space> measure_part(light_.space, chart, whole, exact != nullptr);
  FractionSum lit, shadow;
  for (const ClassifiedLoop& f : fragments) {
    (f.state == LightState::kLit ? lit : shadow)
        .add(measure_part.fraction(loops.view(f.loop, plane)));
  }
  part.lit = lit.interval(Space::kExact);
  part.shadow = shadow.interval(Space::kExact);
  if (exact != nullptr) {
    exact->lit = lit.exact();
    exact->shadow = shadow.exact();
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_LIGHTS_LIGHT_SINK_H
