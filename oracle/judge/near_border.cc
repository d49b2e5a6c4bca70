// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/near_border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "oracle/geometry/chart.h"
#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

namespace {

constexpr double kNoBorder = std::numeric_limits<double>::infinity();
/// Steps are a little shorter than the width that they must not leave.
constexpr double kShorter = 0.999;

using GridVector = std::array<double, 3>;

GridVector value_of(const BoundedVector& vector) {
  return {vector[0].value, vector[1].value, vector[2].value};
}
GridVector difference(const GridVector& a, const GridVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double product(const GridVector& a, const GridVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
GridVector normal_to(const GridVector& a, const GridVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// One line that bounds a shadow: how far the point is from it (scene units, positive inside), and
/// the direction inwards.
struct ShadowLine {
  double distance = 0;
  std::array<double, 2> inwards{};
};

class ShadowLines {
 public:
  ShadowLines(const PointSight& sight, const PlaneSteps& steps, const RationalPoint& point)
      : sight_(sight),
        steps_(steps),
        point_(value_of(on_grid(sight.scene().geometry, point))),
        light_(value_of(sight.place())),
        directional_(sight.directional()) {}

  /// Of one caster; empty if nothing of the plane is in its shadow.
  std::vector<ShadowLine> of(std::uint32_t caster) const {
    std::vector<ShadowLine> lines;
    const PointSight::SeenPart& part = sight_.seen(caster);
    std::vector<GridVector> loop;
    for (const BoundedVector& vertex : part.loop) loop.push_back(value_of(vertex));
    const double facing = sight_.facing(caster) == Side::kFront ? 1 : -1;
    const auto add = [&](const GridVector& normal, const GridVector& base, double sign) {
      const std::array<double, 2> gradient = steps_.along_axes(normal);
      const double length = std::hypot(gradient[0], gradient[1]);
      const double value = sign * product(normal, difference(point_, base));
      if (!(length > 0)) return value > 0;
      lines.push_back({value / length * steps_.step(),
                       {sign * gradient[0] / length, sign * gradient[1] / length}});
      return true;
    };
    bool some = add(value_of(part.normal), loop[0], -facing);
    for (std::size_t i = 0; i < loop.size() && some; ++i) {
      const GridVector &a = loop[i], &b = loop[(i + 1) % loop.size()];
      // Of the pyramid from the light over an edge: the same orientation for all edges, and as good
      // from a light that is far away.
      const GridVector edge = difference(b, a);
      const GridVector normal =
          directional_ ? normal_to(light_, edge) : normal_to(edge, difference(a, light_));
      some = add(normal, a, facing);
    }
    if (!some) lines.clear();
    return lines;
  }

 private:
  const PointSight& sight_;
  const PlaneSteps& steps_;
  GridVector point_, light_;
  bool directional_;
};

}  // namespace

PlaneSteps::PlaneSteps(const PreparedScene& scene, std::uint32_t part)
    : step_(scene.geometry.step.get_d()) {
  const std::vector<Integers3> loop = grid_loop(scene, part);
  const Integers3 first = minus(loop[1], loop[0]);
  const Integers3 second = cross(support_of(scene, part).normal, first);
  for (std::size_t i = 0; i < 2; ++i) {
    const Integers3& axis = i == 0 ? first : second;
    GridVector near{};
    for (std::size_t k = 0; k < 3; ++k) {
      axes_[i][k] = axis[k] * scene.geometry.step;
      near[k] = axis[k].get_d();
    }
    const double length = std::hypot(near[0], near[1], near[2]);
    for (std::size_t k = 0; k < 3; ++k) unit_[i][k] = near[k] / length;
    lengths_[i] = length * step_;
  }
}

RationalPoint PlaneSteps::from(const RationalPoint& point, double x, double y) const {
  const std::array<double, 2> weights{x / lengths_[0], y / lengths_[1]};
  RationalPoint result = point;
  if (!std::isfinite(weights[0]) || !std::isfinite(weights[1])) return result;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] += mpq_class(weights[0]) * axes_[0][k] + mpq_class(weights[1]) * axes_[1][k];
  }
  return result;
}

std::array<double, 2> PlaneSteps::along_axes(const std::array<double, 3>& vector) const {
  return {product(vector, unit_[0]), product(vector, unit_[1])};
}

std::vector<RationalPoint> points_around(const PlaneSteps& steps, const RationalPoint& point,
                                         double width) {
  constexpr int kDirections = 8;
  std::vector<RationalPoint> points;
  for (const double distance : {kShorter * width, width / 2}) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      points.push_back(steps.from(point, distance * std::cos(angle), distance * std::sin(angle)));
    }
  }
  return points;
}

BorderDistance distance_from_border(const PointSight& sight, std::uint32_t part,
                                    const RationalPoint& point, bool is_lit, double width,
                                    const std::function<bool(const RationalPoint&)>& is_other) {
  const PreparedScene& scene = sight.scene();
  const PlaneSteps steps(scene, part);
  const ShadowLines shadows(sight, steps, point);
  BorderDistance result{is_lit ? kNoBorder : 0, std::nullopt, false};
  std::vector<ShadowLine> near;  // lines worth crossing
  const auto look_at = [&](std::uint32_t caster) {
    if (!sight.casts(caster) || scene.parts[caster].plane == scene.parts[part].plane) return;
    const std::vector<ShadowLine> lines = shadows.of(caster);
    if (lines.empty()) return;
    const auto least = std::ranges::min_element(lines, {}, &ShadowLine::distance);
    const double distance = std::max(0.0, is_lit ? -least->distance : least->distance);
    if (!result.caster || (is_lit ? distance < result.at_least : distance > result.at_least)) {
      result.at_least = distance;
      result.caster = caster;
    }
    for (const ShadowLine& line : lines) {
      if (std::fabs(line.distance) <= width) near.push_back(line);
    }
  };
  if (is_lit) {
    for (std::uint32_t caster = 0; caster < scene.parts.size(); ++caster) look_at(caster);
  } else {
    std::ranges::for_each(sight.casters_before(point), look_at);
  }
  if (!(width > 0) || result.at_least > width) return result;
  // Just beyond each line, and all around.
  constexpr std::size_t kMostLines = 32;
  std::ranges::sort(near, {}, [](const ShadowLine& line) { return std::fabs(line.distance); });
  near.resize(std::min(near.size(), kMostLines));
  for (const ShadowLine& line : near) {
    const double apart = std::fabs(line.distance);
    const double sign = is_lit ? 1 : -1;
    for (const double share : {0.01, 0.5}) {
      const double length = sign * kShorter * (apart + share * (width - apart));
      if (is_other(steps.from(point, length * line.inwards[0], length * line.inwards[1]))) {
        result.within = true;
        return result;
      }
    }
  }
  const std::vector<RationalPoint> around = points_around(steps, point, width);
  result.within = std::ranges::any_of(around, is_other);
  return result;
}

}  // namespace gnomon::oracle
