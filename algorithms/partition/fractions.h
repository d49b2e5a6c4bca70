// SPDX-License-Identifier: LGPL-3.0-or-later
// Areas as fractions of a part: measured in a coordinate plane (a linear map, so that ratios of
// areas on one support plane stay what they are), enclosed in doubles, exact rationals where asked
// for or where the enclosure says too little.
#ifndef GNOMON_ALGORITHMS_PARTITION_FRACTIONS_H
#define GNOMON_ALGORITHMS_PARTITION_FRACTIONS_H

#include <gmpxx.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/geometry.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon {

/// The two coordinates that remain when the axis of the largest normal component is dropped.
struct Chart {
  int u = 0, v = 1;
};
Chart chart_of(const Geometry& geometry, PlaneId plane);

struct Fraction {
  Ball enclosure;
  mpq_class exact;
  bool has_exact = false;
};

/// Sums of fractions: enclosures in order, rationals in a balanced tree so that denominators grow
/// late. Exactness: exact() is the sum of what was added with an exact value.
class FractionSum {
 public:
  void add(Fraction fraction);
  /// Certified bounds within [0, 1]; a rounded kernel's sum as it came out, both ends equal.
  Interval interval(bool certified) const;
  mpq_class exact() const;

 private:
  Ball sum_;
  std::vector<mpq_class> partial_;  // partial_[k]: sum of 2^k terms, or 0
  std::vector<bool> filled_;
};

/// Twice the area of a loop in scene units, in a chart of its plane; exact.
template <MeasuredSpace Space>
mpq_class twice_exact_area(const Space& space, const Chart& chart,
                           const LoopView<typename Space::Vertex>& loop) {
  mpq_class sum = 0;
  const auto first = space.exact_position(loop.corner(0));
  auto previous = space.exact_position(loop.corner(1));
  for (std::uint32_t i = 2; i < loop.size(); ++i) {
    auto next = space.exact_position(loop.corner(i));
    sum += (previous[chart.u] - first[chart.u]) * (next[chart.v] - first[chart.v]) -
           (previous[chart.v] - first[chart.v]) * (next[chart.u] - first[chart.u]);
    previous = std::move(next);
  }
  return abs(sum);
}

/// Measures fragments against the area of their part. The part's loop must outlive it.
template <MeasuredSpace Space>
class PartMeasure {
 public:
  using Loop = LoopView<typename Space::Vertex>;
  /// An enclosure whose radius is not below this fraction of the part is replaced by exact
  /// arithmetic; most are far narrower.
  static constexpr double kWidest = 0x1p-30;

  PartMeasure(const Space& space, Chart chart, const Loop& part, bool always_exact)
      : space_(space),
        chart_(chart),
        part_(part),
        always_exact_(always_exact),
        area_(enclosed_area(part)) {}

  Fraction fraction(const Loop& loop) {
    Fraction result;
    result.enclosure = enclosed_area(loop) / area_;
    if constexpr (Space::kExact) {
      if (always_exact_ || !(result.enclosure.radius < kWidest)) {
        if (sgn(exact_area_) == 0) exact_area_ = twice_exact_area(space_, chart_, part_);
        result.exact = twice_exact_area(space_, chart_, loop) / exact_area_;
        result.has_exact = true;
        const double value = result.exact.get_d();  // truncated: within one unit in the last place
        result.enclosure = Ball(value, 2 * Ball::kUnit * std::fabs(value) + Ball::kTiny);
      }
    }
    return result;
  }

 private:
  /// A kernel that can tells where the corner is as seen from the part's first vertex.
  std::array<Ball, 3> point(const Corner<typename Space::Vertex>& corner) const {
    if constexpr (requires { space_.offset(VertexId{}, corner); }) {
      return space_.offset(part_.vertices[0].source, corner);
    } else {
      return space_.position(corner);
    }
  }
  /// Twice the signed area in the chart.
  Ball enclosed_area(const Loop& loop) const {
    Ball sum;
    const auto first = point(loop.corner(0));
    auto previous = point(loop.corner(1));
    for (std::uint32_t i = 2; i < loop.size(); ++i) {
      const auto next = point(loop.corner(i));
      sum = sum + (previous[chart_.u] - first[chart_.u]) * (next[chart_.v] - first[chart_.v]) -
            (previous[chart_.v] - first[chart_.v]) * (next[chart_.u] - first[chart_.u]);
      previous = next;
    }
    return sum;
  }
  const Space& space_;
  Chart chart_;
  Loop part_;
  bool always_exact_;
  Ball area_;
  mpq_class exact_area_;  // 0 until it is needed
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_FRACTIONS_H
