// SPDX-License-Identifier: LGPL-3.0-or-later
// How many shadow volumes of one light hold the points that a row of samples sees: counted along
// the ray of each sample over the walls and caps that it pierces (Crow 1977, third class; the
// stencil shadow volume). A point is in shadow iff the count is above zero, and the count is the
// number of casters between the point and the light.
//
// N(x) = N(E) + walls pierced between E and x (+c where the ray enters the volumes, -c where it
// leaves them) + caps pierced there. Before the nearest visible polygon only caps that the eye sees
// through can be, those of one-sided polygons seen from behind: the ray leaves their volumes.
//
// A wall of the edge (a, b) with shadow plane n is decided by signs, each of which changes at most
// once along a row: E and x strictly on different sides of n; and d between the planes (E, L, a)
// and (E, L, b), beyond (E, a, b) and towards n, which depend on no x and are found once a row.
// Where n holds E the wall is seen edge-on, and is never pierced. Degrees, bits: image_space.h.
//
// N(E) is the number of casters that hold the point E + 0+ d. For most casters no sign at E is
// zero, and they are counted once; for the others a zero is replaced by the plane's sign along d,
// so that they are counted where they hold the beginning of the ray.
#ifndef GNOMON_ALGORITHMS_SHADOW_POLYGONS_WALL_COUNTER_H
#define GNOMON_ALGORITHMS_SHADOW_POLYGONS_WALL_COUNTER_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/visible_row.h"
#include "algorithms/shadow_polygons/clip_planes.h"
#include "algorithms/shadow_polygons/neighbour_order.h"
#include "algorithms/shadow_polygons/one_perspective.h"
#include "algorithms/shadow_polygons/shadow_walls.h"

namespace gnomon {

template <ImageSpaceModel Space>
class WallCounter {
 public:
  /// Of the l-th light of the task.
  WallCounter(ImageScene<Space>& scene, const PixelTask& task, const ClipPlanes& clip,
              std::size_t l)
      : scene_(scene),
        task_(task),
        clip_(clip),
        light_(l),
        neighbours_(scene.space()),
        changes_(task.frame.width + 1) {
    make_walls();
    make_caps();
    switch (task.options.options.count) {
      case WallCount::kFromEye:
        if (task.rules.eye_may_be_in_shadow) count_casters_at_eye();
        break;
      case WallCount::kZPass:
        break;
      case WallCount::kZFail:
        if (!clip.far.valid()) list_casters_at_infinity();
        break;
    }
  }

  std::size_t walls() const { return walls_.size(); }
  std::size_t bytes() const { return walls_.size() * sizeof(Wall) + caps_.size() * sizeof(Cap); }

  /// Finds what the rays of a row can pierce.
  void start_row(std::uint32_t row, WorkCounts& work) {
    row_ = row;
    crossed_.clear();
    held_.clear();
    neighbours_.start_row(row);
    for (const Wall& wall : walls_) {
      Span span = whole_row();
      for (std::size_t k = 0; k < 3 && !span.empty(); ++k) {
        span = covered(span, wall.bounds[k], wall.sides[k]);
      }
      // Beside a lamp rays between the bounds may leave the wall's plane behind them.
      span = heading_to(span, wall.surface.plane, -wall.surface.eye_side);
      add_crossed(wall.surface, span);
    }
    work.at_least(Counter::kActiveWalls, crossed_.size());
    for (const Crossed& wall : crossed_) work[Counter::kWallSamples] += wall.span.size();
    for (const Cap& cap : caps_) {
      Span span = whole_row();
      for (const auto& [bound, side] : cap.bounds) {
        if (span.empty()) break;
        span = covered(span, bound, side);
      }
      add_crossed(cap.surface, span);
    }
    std::ranges::stable_sort(crossed_, {}, [](const Crossed& c) { return c.span.begin; });
    for (const Holding& caster : holding_) {
      Span span = whole_row();
      for (const auto& [plane, side] : caster) {
        if (span.empty()) break;
        span = heading_to(span, plane, side);
      }
      if (!span.empty()) held_.push_back(span);
    }
  }

  /// The counts of a span of samples on a part, into counts[span.begin ... span.end). Requires: the
  /// eye sees the part's side that faces the light, at all of them; start_row() of their row.
  void count(std::uint32_t part, Span span, std::span<std::int32_t> counts, WorkCounts& work) {
    const PlaneRef on = scene_.facing_eye(part);
    for (const Span& held : held_) add(+1, within(held, span));
    for (const Crossed& crossed : crossed_) {
      if (crossed.span.begin >= span.end) break;
      const Span both = within(crossed.span, span);
      if (both.empty()) continue;
      ++work[Counter::kWallTests];
      add_crossing(crossed.surface, both, on);
    }
    std::int32_t sum = held_always_;
    for (std::uint32_t i = span.begin; i < span.end; ++i) {
      sum += std::exchange(changes_[i], 0);
      counts[i] = sum;
    }
    changes_[span.end] = 0;
    if (!task_.rules.eye_in_several_volumes_counts_all) count_eye_by_first(span, counts);
    if (uses_neighbours()) count_by_neighbours(on, span, counts, work);
  }

 private:
  using Surface = ShadowSurface;
  struct Wall {
    Surface surface;
    std::array<RayPlaneRef, 3> bounds;  // (E, L, a), (E, b, L), (E, a, b)
    std::array<Sign, 3> sides;
  };
  struct Cap {
    Surface surface;
    std::vector<std::pair<RayPlaneRef, Sign>> bounds;
  };
  using Crossed = CrossedSurface;
  /// A caster whose volume holds a point of a ray if the ray heads for these sides of planes.
  using Holding = std::vector<std::pair<PlaneRef, Sign>>;

  Span whole_row() const { return {0, task_.frame.width}; }
  static Span within(Span a, Span b) {
    return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
  }
  Span covered(Span span, RayPlaneRef bound, Sign side) {
    Space& space = scene_.space();
    return part_where(
        span,
        [&](std::uint32_t i) {
          return space.covers(bound, {i, row_}) == side;
        },
        space.guess_covers(bound, row_));
  }
  Span heading_to(Span span, PlaneRef plane, Sign side) {
    constexpr double kNoGuess = -1;
    return part_where(
        span,
        [&](std::uint32_t i) {
          return scene_.space().heading(plane, {i, row_}) == side;
        },
        kNoGuess);
  }
  void add_crossed(const Surface& surface, Span span) {
    if (!span.empty()) crossed_.push_back({surface, span});
  }
  void add(std::int32_t change, Span span) {
    if (span.empty()) return;
    changes_[span.begin] += change;
    changes_[span.end] -= change;
  }

  void add_crossing(const Surface& surface, Span span, PlaneRef on) {
    Space& space = scene_.space();
    const Sign beyond = -surface.eye_side;
    const Span before_x = part_on_side(space, span, surface.plane, on, row_, beyond);
    if (task_.options.options.count != WallCount::kZFail) {
      add(surface.change, clip_.near.valid() ? part_on_side(space, before_x, surface.plane,
                                                            clip_.near, row_, surface.eye_side)
                                             : before_x);
      return;
    }
    // What lies beyond the point, or in it, is undone on the way from infinity, or from the plane
    // beyond which nothing is drawn.
    const Span one{span.begin, before_x.empty() ? span.end : before_x.begin};
    const Span other{before_x.empty() ? span.end : before_x.end, span.end};
    for (const Span behind : {one, other}) {
      add(-surface.change, clip_.far.valid()
                               ? part_on_side(space, behind, surface.plane, clip_.far, row_, beyond)
                               : behind);
    }
  }

  void make_walls() {
    Space& space = scene_.space();
    std::vector<Side> facing;
    for (std::uint32_t p = 0; p < task_.scene.parts.size(); ++p) {
      const PlaneRef plane = scene_.facing_light(p, light_);
      facing.push_back(!plane.valid()                                    ? Side::kOn
                       : plane.flipped() == task_.scene.parts[p].flipped ? Side::kFront
                                                                         : Side::kBack);
    }
    const ImagePoint at_light = ImagePoint::of(scene_.light(light_));
    for (const ShadowWall& wall :
         shadow_walls(task_.scene, facing, task_.options.options.volumes)) {
      const PlaneRef plane = scene_.shadow_plane_of(wall.edge, light_);
      const Sign eye = space.side_of_eye(plane);
      if (eye == Sign::kZero) continue;  // seen edge-on
      const auto [a, b] = scene_.ends_of(wall.edge);
      const auto volumes = static_cast<std::int32_t>(wall.multiplicity) * turn_of(a, b);
      walls_.push_back(
          {{plane, eye, eye == Sign::kNegative ? volumes : -volumes},
           {space.add_ray_plane(at_light, ImagePoint::at(a)),
            space.add_ray_plane(ImagePoint::at(b), at_light), scene_.ray_plane_of(wall.edge)},
           {-eye, -eye, eye}});
    }
  }

  /// Those that a ray may come through before what it sees; where it is followed further, all.
  void make_caps() {
    const bool all = task_.options.options.count == WallCount::kZFail ||
                     !task_.rules.eye_in_several_volumes_counts_all;
    Space& space = scene_.space();
    for (std::uint32_t p = 0; p < task_.scene.parts.size(); ++p) {
      const PlaneRef plane = scene_.facing_light(p, light_);
      if (!plane.valid() || !task_.scene.parts[p].casts) continue;
      if (!all && scene_.facing_eye(p).valid()) continue;
      const Sign eye = space.side_of_eye(plane);
      if (eye == Sign::kZero) continue;
      Cap cap{{plane, eye, eye == Sign::kPositive ? 1 : -1}, {}};
      const bool is_front = plane.flipped() == task_.scene.parts[p].flipped;
      for (const PlaneRef edge : task_.scene.edges(task_.scene.parts[p])) {
        // Loops are clockwise for an eye behind them.
        cap.bounds.emplace_back(scene_.ray_plane_of(edge), is_front ? eye : -eye);
      }
      caps_.push_back(std::move(cap));
    }
  }

  /// 1; a map of the light's surroundings by one division turns an edge with one end behind it.
  std::int32_t turn_of(VertexId a, VertexId b) const {
    if (task_.rules.light_looks_all_around) return 1;
    return turn_in_one_perspective(task_.scene, task_.scene.lights[task_.lights[light_]].point, a,
                                   b);
  }

  template <class Use>
  void for_each_caster(const Use& use) {
    for (std::uint32_t p = 0; p < task_.scene.parts.size(); ++p) {
      if (scene_.facing_light(p, light_).valid() && task_.scene.parts[p].casts) use(p);
    }
  }

  void count_casters_at_eye() {
    Space& space = scene_.space();
    for_each_caster([&](std::uint32_t p) {
      Holding open;
      const auto holds = [&](PlaneRef plane, Sign side) {
        const Sign eye = space.side_of_eye(plane);
        if (eye == Sign::kZero) open.emplace_back(plane, side);
        return eye == Sign::kZero || eye == side;
      };
      if (!holds(scene_.facing_light(p, light_), Sign::kNegative)) return;
      for (std::size_t k = 0; k < task_.scene.parts[p].count; ++k) {
        if (!holds(scene_.shadow_plane(p, k, light_), Sign::kPositive)) return;
      }
      if (open.empty()) {
        ++held_always_;
      } else if (task_.rules.eye_on_planes_counts_by_sample) {
        holding_.push_back(std::move(open));
      }
    });
  }

  void list_casters_at_infinity() {
    for_each_caster([&](std::uint32_t p) {
      Holding planes{{scene_.facing_light(p, light_), Sign::kNegative}};
      for (std::size_t k = 0; k < task_.scene.parts[p].count; ++k) {
        planes.emplace_back(scene_.shadow_plane(p, k, light_), Sign::kPositive);
      }
      holding_.push_back(std::move(planes));
    });
  }

  /// The rule of the paper: the eye is in shadow if the ray leaves a volume first.
  void count_eye_by_first(Span span, std::span<std::int32_t> counts) {
    for (std::uint32_t i = span.begin; i < span.end; ++i) {
      const Surface* first = nullptr;
      for (const Crossed& crossed : crossed_) {
        if (i < crossed.span.begin || i >= crossed.span.end) continue;
        if (first == nullptr || is_before(scene_.space(), crossed.surface, *first, {i, row_})) {
          first = &crossed.surface;
        }
      }
      std::int32_t held = held_always_;
      for (const Span& other : held_) held += other.begin <= i && i < other.end ? 1 : 0;
      counts[i] += (first != nullptr && first->change < 0 ? 1 : 0) - held;
    }
  }

  bool uses_neighbours() const {
    return task_.options.options.count == WallCount::kFromEye &&
           (task_.options.options.neighbours || !task_.rules.order_of_walls_is_verified);
  }
  /// Counts again by the neighbours in depth alone, and counts the samples where that is wrong.
  void count_by_neighbours(PlaneRef on, Span span, std::span<std::int32_t> counts,
                           WorkCounts& work) {
    by_neighbours_.assign(counts.begin() + span.begin, counts.begin() + span.end);
    neighbours_.count(crossed_, on, span, by_neighbours_, work);
    for (const Span& held : held_) {
      const Span both = within(held, span);
      for (std::uint32_t i = both.begin; i < both.end; ++i) ++by_neighbours_[i - span.begin];
    }
    for (std::uint32_t i = span.begin; i < span.end; ++i) {
      const std::int32_t count = by_neighbours_[i - span.begin] + held_always_;
      if (count != counts[i]) ++work[Counter::kNeighbourMisses];
      if (!task_.rules.order_of_walls_is_verified) counts[i] = count;
    }
  }

  ImageScene<Space>& scene_;
  const PixelTask& task_;
  ClipPlanes clip_;
  std::size_t light_;
  std::vector<Wall> walls_;
  std::vector<Cap> caps_;
  std::int32_t held_always_ = 0;  // casters that hold where counting begins, for all samples
  std::vector<Holding> holding_;  // others that may
  NeighbourOrder<Space> neighbours_;
  std::vector<std::int32_t> by_neighbours_;  // counts of a span
  // Of a row:
  std::uint32_t row_ = 0;
  std::vector<Crossed> crossed_;  // by their first columns
  std::vector<Span> held_;
  std::vector<std::int32_t> changes_;  // of the count, by columns
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_POLYGONS_WALL_COUNTER_H
