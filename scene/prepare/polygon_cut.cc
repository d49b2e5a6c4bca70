// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/prepare/polygon_cut.h"

#include "scene/base/exact_int.h"
#include "scene/prepare/bridges.h"
#include "scene/prepare/convex_merge.h"
#include "scene/prepare/ear_clipper.h"
#include "scene/prepare/ring_check.h"
#include "scene/prepare/sweep_cut.h"

namespace gnomon::scene_detail {
namespace {

template <class Int>
bool clip_ears(const Chart<Int>& chart, std::vector<RegionComponent> components,
               std::vector<Triangle>& triangles) {
  for (RegionComponent& component : components) {
    const std::optional<Ring> ring = Bridges<Int>(chart, std::move(component)).run();
    if (!ring || !EarClipper<Int>(chart, *ring).run(triangles)) return false;
  }
  return true;
}

}  // namespace

template <class Int>
tl::expected<std::vector<Ring>, CutProblem> cut_into_convex_parts(CutInput<Int> input) {
  const Chart<Int> chart(input);
  start_at_smallest_key(chart, input.rings[0]);
  RingCheck<Int> check(input, chart);
  if (auto problem = check.run()) return tl::unexpected(std::move(*problem));
  std::vector<RegionComponent> components;
  if (check.needs_tracing()) {
    auto traced = RegionTracer<Int>(chart, check.edges()).run();
    if (!traced) return tl::unexpected(std::move(traced.error()));
    components = std::move(*traced);
  } else {
    components.push_back({input.rings[0], {}});
  }

  std::size_t corners = 0;
  for (const Ring& ring : input.rings) corners += ring.size();
  std::vector<Triangle> triangles;
  const bool done = corners > input.most_for_ears
                        ? SweepCut<Int>(chart, components).run(triangles)
                        : clip_ears(chart, std::move(components), triangles);
  if (!done) return tl::unexpected(CutProblem{0, "cannot be triangulated"});
  std::vector<Ring> parts;
  if (input.planar) {
    parts = merge_convex(chart, triangles);
  } else {
    for (const Triangle& triangle : triangles) parts.emplace_back(triangle.begin(), triangle.end());
  }
  const auto by_key = [&](std::uint32_t a, std::uint32_t b) { return chart.key(a) < chart.key(b); };
  for (Ring& part : parts) start_at_smallest_key(chart, part);
  std::sort(parts.begin(), parts.end(), [&](const Ring& a, const Ring& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), by_key);
  });
  return parts;
}

template tl::expected<std::vector<Ring>, CutProblem> cut_into_convex_parts(CutInput<std::int64_t>);
template tl::expected<std::vector<Ring>, CutProblem> cut_into_convex_parts(CutInput<Int128>);
template tl::expected<std::vector<Ring>, CutProblem> cut_into_convex_parts(CutInput<Int256>);
template tl::expected<std::vector<Ring>, CutProblem> cut_into_convex_parts(CutInput<mpz_class>);

}  // namespace gnomon::scene_detail
