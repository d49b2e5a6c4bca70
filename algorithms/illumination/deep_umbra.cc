// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/deep_umbra.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <queue>
#include <utility>

#include "algorithms/illumination/umbra_cell.h"
#include "algorithms/partition/fractions.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {
namespace {

using Point = std::array<mpq_class, 3>;

mpq_class twice_area(const Chart& chart, const Point& a, const Point& b, const Point& c) {
  const auto u = static_cast<std::size_t>(chart.u), v = static_cast<std::size_t>(chart.v);
  return abs(mpq_class((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u])));
}

/// Of one side: penumbra triangles, largest first, halved until they are decided.
class Subdivision {
 public:
  Subdivision(const LightView& view, const EdgeLines& lines, const PartResult& result,
              const LightResult& light)
      : view_(view),
        part_(view.scene().parts[result.part]),
        cells_(view, lines, part_, result.side),
        chart_(chart_of(view.scene().geometry, part_.plane)) {
    const auto loop = view.scene().loop(part_);
    const Geometry& geometry = view.scene().geometry;
    const auto position = [&](std::size_t i) {
      const ExactVector grid = view.grid_point(loop[i]);
      Point point;
      for (std::size_t k = 0; k < 3; ++k) point[k] = geometry.origin[k] + geometry.step * grid[k];
      return point;
    };
    for (std::size_t i = 2; i < loop.size(); ++i) {
      area_ += twice_area(chart_, position(0), position(i - 1), position(i));
    }
    for (std::uint32_t f = 0; f < result.fragment_count; ++f) {
      const Fragment& fragment = light.fragments[result.first_fragment + f];
      if (fragment.state != LightState::kPenumbra) continue;
      const Point* points = light.exact_points.data() + fragment.first;
      for (std::uint32_t i = 2; i < fragment.count; ++i) add(points[0], points[i - 1], points[i]);
    }
  }

  DeepUmbraBounds run(const PartResult& result, const AreaFractions& classes,
                      const DeepUmbraOptions& options) {
    DeepUmbraBounds bounds{result.part, result.side, {}, 0};
    if (queue_.empty()) {
      bounds.fraction = classes.umbra;
      return bounds;
    }
    while (!queue_.empty() && bounds.cells < options.max_cells && undecided_ > options.tolerance) {
      if (options.interrupted != nullptr && *options.interrupted) break;
      Cell cell = queue_.top();
      queue_.pop();
      undecided_ -= cell.fraction.middle;
      ++bounds.cells;
      std::vector<CasterSide> casters = *cell.casters;
      switch (cells_.decide(cell.triangle, casters)) {
        case CellAnswer::kDeep:
          deep_ = deep_ + cell.fraction;
          break;
        case CellAnswer::kSeen:
          break;
        case CellAnswer::kUndecided: {
          const auto shared = std::make_shared<const std::vector<CasterSide>>(std::move(casters));
          const Ball half{cell.fraction.middle / 2, cell.fraction.radius / 2 + Ball::kTiny};
          for (UmbraCell& child : cell.triangle.halves(view_.scene().geometry)) {
            push({std::move(child), half, shared, 0});
          }
          break;
        }
      }
    }
    Ball open;
    for (; !queue_.empty(); queue_.pop()) open = open + queue_.top().fraction;
    const Ball base_low(classes.umbra.lower), base_high(classes.umbra.upper);
    bounds.fraction.lower = std::clamp((base_low + deep_).lower(), 0.0, 1.0);
    bounds.fraction.upper = std::clamp((base_high + deep_ + open).upper(), 0.0, 1.0);
    return bounds;
  }

 private:
  struct Cell {
    UmbraCell triangle;
    Ball fraction;  // of the part's area
    std::shared_ptr<const std::vector<CasterSide>> casters;
    std::uint64_t number = 0;  // in the order of making: ties do not depend on the queue
  };
  struct Smaller {
    bool operator()(const Cell& a, const Cell& b) const {
      return a.fraction.middle != b.fraction.middle ? a.fraction.middle < b.fraction.middle
                                                    : a.number > b.number;
    }
  };

  void push(Cell cell) {
    cell.number = made_++;
    undecided_ += cell.fraction.middle;
    queue_.push(std::move(cell));
  }
  void add(const Point& a, const Point& b, const Point& c) {
    const mpq_class area = twice_area(chart_, a, b, c);
    if (sgn(area) == 0) return;
    const Geometry& geometry = view_.scene().geometry;
    UmbraCell cell;
    cell.weight = 1;
    std::array<Point, 3> on_grid{a, b, c};
    for (Point& point : on_grid) {
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] = (point[k] - geometry.origin[k]) / geometry.step;
        mpz_lcm(cell.weight.get_mpz_t(), cell.weight.get_mpz_t(), point[k].get_den_mpz_t());
      }
    }
    for (std::size_t i = 0; i < on_grid.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        cell.points[i][k] = cell.weight / on_grid[i][k].get_den() * on_grid[i][k].get_num();
      }
    }
    auto casters = std::make_shared<const std::vector<CasterSide>>(cells_.casters_of(cell));
    push({std::move(cell), enclose(mpq_class(area / area_)), std::move(casters), 0});
  }

  const LightView& view_;
  const Part& part_;
  UmbraCells cells_;
  Chart chart_;
  mpq_class area_;  // twice the part's, in the chart
  Ball deep_;
  double undecided_ = 0;
  std::uint64_t made_ = 0;
  std::priority_queue<Cell, std::vector<Cell>, Smaller> queue_;
};

}  // namespace

Expected<std::vector<DeepUmbraBounds>> deep_umbra_bounds(const PreparedScene& scene,
                                                         const LightResult& classified,
                                                         const DeepUmbraOptions& options) {
  bool fits = classified.light < scene.lights.size() && scene.lights[classified.light].has_area() &&
              classified.area_fractions.size() == classified.parts.size();
  for (const PartResult& part : classified.parts) {
    fits &= part.part < scene.parts.size();
    fits &= part.first_fragment + std::size_t{part.fragment_count} <= classified.fragments.size();
    fits &= part.reason != ShadowReason::kNone || part.fragment_count > 0;
  }
  for (const Fragment& fragment : classified.fragments) {
    fits &= fragment.count >= 3 &&
            fragment.first + std::size_t{fragment.count} <= classified.exact_points.size();
  }
  if (!fits) {
    return fail(ErrorCode::kUsage, "the deep umbra needs the fragments of an area light",
                "a result of an exact kernel, by a method that makes fragments");
  }
  const LightView view(scene, classified.light);
  const EdgeLines lines(scene.geometry);
  std::vector<DeepUmbraBounds> result(classified.parts.size());
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t i) {
    const PartResult& part = classified.parts[i];
    if (part.reason != ShadowReason::kNone) {
      result[i] = {part.part, part.side, {1, 1}, 0};
      return;
    }
    result[i] =
        Subdivision(view, lines, part, classified).run(part, classified.area_fractions[i], options);
  });
  if (options.interrupted != nullptr && *options.interrupted) {
    return fail(ErrorCode::kInterrupted, "interrupted");
  }
  return result;
}

}  // namespace gnomon
