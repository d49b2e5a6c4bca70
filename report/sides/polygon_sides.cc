// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/sides/polygon_sides.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "gnomon/oracle/enclosure.h"
#include "kernel/signs/nearest_double.h"

namespace gnomon::report {

namespace {

using oracle::Enclosure;

Enclosure to_enclosure(const Interval& interval) { return {interval.lower, interval.upper}; }
Interval to_interval(const Enclosure& enclosure) { return {enclosure.lower, enclosure.upper}; }

mpz_class squared_length(const std::array<mpz_class, 3>& vector) {
  return vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2];
}

/// Twice the area vector of a loop whose vertices have integer coordinates, in `Integer`.
template <class Integer, class At>
std::array<Integer, 3> doubled_loop_area(std::span<const VertexId> loop, const At& at) {
  std::array<Integer, 3> origin{}, a{}, b{}, sum{};
  for (int k = 0; k < 3; ++k) origin[k] = at(loop[0], k);
  for (int k = 0; k < 3; ++k) a[k] = at(loop[1], k) - origin[k];
  for (std::size_t i = 2; i < loop.size(); ++i) {
    for (int k = 0; k < 3; ++k) b[k] = at(loop[i], k) - origin[k];
    for (int k = 0; k < 3; ++k) {
      const int u = (k + 1) % 3, v = (k + 2) % 3;
      sum[k] += a[u] * b[v] - a[v] * b[u];
    }
    std::swap(a, b);
  }
  return sum;
}

/// The root of a sum of squares to 160 bits beyond the integer part: the error is far below a
/// double's. Exact in a plane of constant x, y or z.
mpq_class precise_part_area(const PreparedScene& scene, const Part& part) {
  constexpr unsigned kShift = 160;
  const std::array<mpz_class, 3> doubled = doubled_area_vector(scene, part);
  mpq_class area;
  if (std::ranges::count(doubled, 0) == 2) {
    area = abs(doubled[0] + doubled[1] + doubled[2]);
    area >>= 1;
  } else {
    mpz_class root = squared_length(doubled) << (2 * kShift);
    mpz_sqrt(root.get_mpz_t(), root.get_mpz_t());
    area = root;
    area >>= kShift + 1;
  }
  if (scene.geometry.step == 1) return area;
  return area * scene.geometry.step * scene.geometry.step;
}

/// The entries of one part: one for each side that sees an area light, else one.
std::span<const PartResult> results_of(const LightResult& light, std::uint32_t part) {
  const auto first = std::ranges::lower_bound(light.parts, part, {}, &PartResult::part);
  const auto last = std::ranges::upper_bound(light.parts, part, {}, &PartResult::part);
  return {first, last};
}

PartSide part_side(const LightResult& light, bool area_light, std::uint32_t part, Side side) {
  PartSide one;
  one.area_light = area_light;
  const std::span<const PartResult> results = results_of(light, part);
  one.result = &results.front();
  for (const PartResult& result : results) {
    if (result.reason == ShadowReason::kNone && result.side == side) one.result = &result;
  }
  if (one.result->reason != ShadowReason::kNone) {
    one.reason = one.result->reason;
    // That is the front's. If no light is in front, and not all of it is in the plane, some is
    // behind; a back that does not see it then lies behind the light.
    if (area_light && side != one.result->side && one.reason == ShadowReason::kFacesAway) {
      one.reason = ShadowReason::kBehindLight;
    }
  } else if (one.result->side != side) {
    // Of an area light too: a part that the other side sees it from is partly in front of it.
    one.reason = ShadowReason::kFacesAway;
  }
  if (one.reason != ShadowReason::kNone) {
    (area_light ? one.umbra : one.shadow) = {1, 1};
    return one;
  }
  one.lit = one.result->lit;
  if (!area_light) {
    one.shadow = one.result->shadow;
    return one;
  }
  one.area_fractions =
      &light.area_fractions[static_cast<std::size_t>(one.result - light.parts.data())];
  one.penumbra = one.area_fractions->penumbra;
  one.umbra = one.area_fractions->umbra;
  return one;
}

Interval Shares::*share_member(LightState state) {
  switch (state) {
    case LightState::kLit:
      return &Shares::lit;
    case LightState::kShadow:
      return &Shares::shadow;
    case LightState::kPenumbra:
      return &Shares::penumbra;
    case LightState::kUmbra:
      return &Shares::umbra;
  }
  return &Shares::lit;
}

std::optional<mpq_class> ClassifiedSide::*exact_member(LightState state) {
  switch (state) {
    case LightState::kLit:
      return &ClassifiedSide::exact_lit;
    case LightState::kShadow:
      return &ClassifiedSide::exact_shadow;
    case LightState::kPenumbra:
      return &ClassifiedSide::exact_penumbra;
    case LightState::kUmbra:
      return &ClassifiedSide::exact_umbra;
  }
  return &ClassifiedSide::exact_lit;
}

/// Sum of weight * share over sum of weights, where the weights are exact.
void sum_exactly(const PreparedScene& scene, std::uint32_t first, bool exact,
                 ClassifiedSide& side) {
  // Areas in one plane are proportional to any non-zero component of the area vector.
  const std::array<mpz_class, 3> normal = doubled_area_vector(scene, scene.parts[first]);
  std::size_t axis = 0;
  while (normal[axis] == 0) ++axis;
  std::vector<mpz_class> areas;
  mpz_class total = 0;
  for (std::size_t i = 0; i < side.parts.size(); ++i) {
    areas.push_back(abs(doubled_area_vector(scene, scene.parts[first + i])[axis]));
    total += areas.back();
  }
  std::vector<mpq_class> weights;
  for (const mpz_class& area : areas) {
    weights.emplace_back(area, total);
    weights.back().canonicalize();
  }
  for (const LightState state : light_states(side.area_light)) {
    Enclosure sum{0, 0};
    mpq_class exact_sum = 0;
    for (std::size_t i = 0; i < side.parts.size(); ++i) {
      sum = sum + oracle::enclose(weights[i]) * to_enclosure(share_of(side.parts[i], state));
      if (exact) exact_sum += weights[i] * exact_share(side.parts[i], state);
    }
    side.*share_member(state) = to_interval(sum);
    if (exact) side.*exact_member(state) = std::move(exact_sum);
  }
}

void sum_by_enclosure(const PreparedScene& scene, std::uint32_t first, ClassifiedSide& side) {
  std::vector<Enclosure> areas;
  Enclosure total{0, 0};
  for (std::size_t i = 0; i < side.parts.size(); ++i) {
    areas.push_back(to_enclosure(part_area(scene, scene.parts[first + i])));
    total = total + areas.back();
  }
  if (total.lower <= 0) return;
  for (const LightState state : light_states(side.area_light)) {
    Enclosure sum{0, 0};
    for (std::size_t i = 0; i < side.parts.size(); ++i) {
      sum = sum + areas[i] * to_enclosure(share_of(side.parts[i], state));
    }
    Interval& share = side.*share_member(state);
    share = to_interval(sum / total);
    share.upper = std::min(share.upper, 1.0);
  }
}

/// Sign of the plane of `loop`, as it is oriented, at a grid point.
Sign sign_at(const std::array<mpz_class, 3>& normal, const std::array<mpz_class, 3>& origin,
             const std::array<mpz_class, 3>& point) {
  mpz_class value = 0;
  for (int k = 0; k < 3; ++k) value += normal[k] * (point[k] - origin[k]);
  return sign_of(value);
}

std::array<mpz_class, 3> grid_point(const PreparedScene& scene, VertexId vertex) {
  const GridPositions& grid = scene.geometry.grid;
  return {grid.at(vertex, 0), grid.at(vertex, 1), grid.at(vertex, 2)};
}

/// Of three corners that are not in one line, which the corners of a prepared light are not.
std::array<mpz_class, 3> light_normal(const PreparedLight& light) {
  std::array<mpz_class, 3> normal;
  const auto& loop = light.area_loop;
  for (int k = 0; k < 3; ++k) {
    const int u = (k + 1) % 3, v = (k + 2) % 3;
    normal[k] = (loop[1][u] - loop[0][u]) * (loop[2][v] - loop[0][v]) -
                (loop[1][v] - loop[0][v]) * (loop[2][u] - loop[0][u]);
  }
  return normal;
}

}  // namespace

std::span<const LightState> light_states(bool area_light) {
  static constexpr std::array kPoint{LightState::kLit, LightState::kShadow};
  static constexpr std::array kArea{LightState::kLit, LightState::kPenumbra, LightState::kUmbra};
  return area_light ? std::span<const LightState>(kArea) : std::span<const LightState>(kPoint);
}

const Interval& share_of(const Shares& shares, LightState state) {
  return shares.*share_member(state);
}

const std::optional<mpq_class>& exact_share_of(const ClassifiedSide& side, LightState state) {
  return side.*exact_member(state);
}

mpq_class exact_share(const PartSide& part, LightState state) {
  if (part.reason != ShadowReason::kNone) return share_of(part, state).lower == 1 ? 1 : 0;
  switch (state) {
    case LightState::kLit:
      return part.result->exact_lit;
    case LightState::kShadow:
      return part.result->exact_shadow;
    case LightState::kPenumbra:
      return part.area_light ? part.area_fractions->exact_penumbra : mpq_class(0);
    case LightState::kUmbra:
      return part.area_light ? part.area_fractions->exact_umbra : mpq_class(0);
  }
  return 0;
}

std::array<mpz_class, 3> doubled_area_vector(const PreparedScene& scene, const Part& part) {
  const auto loop = scene.loop(part);
  const GridPositions& grid = scene.geometry.grid;
  // Each triangle of b-bit coordinates adds less than 2^(2b + 1).
  if (2 * grid.bits() + 1 + std::bit_width(loop.size()) <= 63) {
    const auto sum = doubled_loop_area<std::int64_t>(
        loop, [&](VertexId vertex, int axis) { return grid.narrow(vertex, axis); });
    return {static_cast<long>(sum[0]), static_cast<long>(sum[1]), static_cast<long>(sum[2])};
  }
  return doubled_loop_area<mpz_class>(
      loop, [&](VertexId vertex, int axis) { return grid.at(vertex, axis); });
}

Sign sign_at_light(const PreparedScene& scene, const Part& part, const LightPoint& light) {
  const std::array<mpz_class, 3> normal = doubled_area_vector(scene, part);
  const VertexId vertex = scene.loop(part)[0];
  mpz_class value = 0;
  for (int k = 0; k < 3; ++k) {
    const mpz_class from = light.directional ? mpz_class(0) : scene.geometry.grid.at(vertex, k);
    value += normal[k] * (light.grid[k] - from);
  }
  return sign_of(value);
}

bool sees_area_light(const PreparedScene& scene, const Part& part, Side side,
                     const PreparedLight& light) {
  if (side == Side::kBack && !part.two_sided) return false;
  const std::array<mpz_class, 3> plane = doubled_area_vector(scene, part),
                                 origin = grid_point(scene, scene.loop(part)[0]),
                                 emitting = light_normal(light);
  const Sign wanted = side == Side::kFront ? Sign::kPositive : Sign::kNegative;
  return std::ranges::any_of(
             light.area_loop,
             [&](const auto& corner) { return sign_at(plane, origin, corner) == wanted; }) &&
         std::ranges::any_of(scene.loop(part), [&](VertexId vertex) {
           return sign_at(emitting, light.area_loop[0], grid_point(scene, vertex)) ==
                  Sign::kPositive;
         });
}

bool cuts_area_light(const PreparedScene& scene, const Part& part, const PreparedLight& light) {
  const std::array<mpz_class, 3> plane = doubled_area_vector(scene, part),
                                 origin = grid_point(scene, scene.loop(part)[0]);
  bool front = false, back = false;
  for (const std::array<mpz_class, 3>& corner : light.area_loop) {
    const Sign sign = sign_at(plane, origin, corner);
    front = front || sign == Sign::kPositive;
    back = back || sign == Sign::kNegative;
  }
  return front && back;
}

bool reaches_behind(const PreparedScene& scene, const Part& part, const PreparedLight& light) {
  const std::array<mpz_class, 3> emitting = light_normal(light);
  bool front = false, back = false;
  for (const VertexId vertex : scene.loop(part)) {
    const Sign sign = sign_at(emitting, light.area_loop[0], grid_point(scene, vertex));
    front = front || sign == Sign::kPositive;
    back = back || sign == Sign::kNegative;
  }
  return front && back;
}

Interval part_area(const PreparedScene& scene, const Part& part) {
  mpq_class squared(squared_length(doubled_area_vector(scene, part)));
  const mpq_class step_squared = scene.geometry.step * scene.geometry.step;
  squared *= step_squared * step_squared;
  squared /= 4;
  return to_interval(oracle::enclose_square_root(squared));
}

double nearest_area(const PreparedScene& scene, const Part& part) {
  return nearest_double(precise_part_area(scene, part));
}

mpq_class precise_area(const PreparedScene& scene, std::uint32_t polygon) {
  mpq_class sum = 0;
  for (std::uint32_t part = scene.first_part[polygon]; part < scene.first_part[polygon + 1];
       ++part) {
    sum += precise_part_area(scene, scene.parts[part]);
  }
  return sum;
}

double facing_area(const PreparedScene& scene, const std::vector<std::uint32_t>& lights) {
  double sum = 0;
  for (const Part& part : scene.parts) {
    std::size_t sides = 0;
    for (const std::uint32_t index : lights) {
      const PreparedLight& light = scene.lights[index];
      if (light.type == LightType::kArea) {
        for (const Side side : {Side::kFront, Side::kBack}) {
          sides += sees_area_light(scene, part, side, light) ? 1 : 0;
        }
        continue;
      }
      const Sign sign = sign_at_light(scene, part, light.point);
      if (sign == Sign::kPositive || (sign == Sign::kNegative && part.two_sided)) ++sides;
    }
    if (sides > 0) sum += static_cast<double>(sides) * part_area(scene, part).middle();
  }
  return sum;
}

std::vector<ClassifiedSide> polygon_sides(const PreparedScene& scene, const LightResult& light,
                                          std::uint32_t polygon, bool exact) {
  const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
  const bool area_light = scene.lights[light.light].type == LightType::kArea;
  std::vector<ClassifiedSide> sides;
  if (first == last) return sides;
  for (const Side side : {Side::kFront, Side::kBack}) {
    const auto sees = [&](const PartResult& result) {
      return result.reason == ShadowReason::kNone && result.side == side;
    };
    for (std::uint32_t part = first; part < last; ++part) {
      if (!std::ranges::any_of(results_of(light, part), sees)) continue;
      sides.emplace_back().side = side;
      break;
    }
  }
  if (sides.empty()) sides.emplace_back();

  bool coplanar = true;
  for (std::uint32_t part = first; part < last; ++part) {
    coplanar = coplanar && scene.parts[part].plane == scene.parts[first].plane;
  }
  const mpq_class area = precise_area(scene, polygon);

  for (ClassifiedSide& side : sides) {
    side.polygon = polygon;
    side.area_light = area_light;
    side.coplanar = coplanar;
    side.area = area;
    for (std::uint32_t part = first; part < last; ++part) {
      side.parts.push_back(part_side(light, area_light, part, side.side));
    }
    side.reason = side.parts.front().reason;
    for (const PartSide& part : side.parts) {
      if (part.reason != side.reason) side.reason = ShadowReason::kNone;
    }
    if (side.parts.size() == 1 || side.reason != ShadowReason::kNone) {
      const PartSide& part = side.parts.front();
      for (const LightState state : light_states(area_light)) {
        side.*share_member(state) = share_of(part, state);
        if (exact) side.*exact_member(state) = exact_share(part, state);
      }
    } else if (coplanar) {
      sum_exactly(scene, first, exact, side);
    } else {
      sum_by_enclosure(scene, first, side);
    }
  }
  return sides;
}

Interval deep_umbra_share(const PreparedScene& scene, const LightResult& light,
                          const ClassifiedSide& side, std::span<const DeepUmbraBounds> bounds) {
  const std::uint32_t first = scene.first_part[side.polygon];
  Enclosure total{0, 0}, deep{0, 0};
  for (std::uint32_t i = 0; i < side.parts.size(); ++i) {
    const PartSide& part = side.parts[i];
    Interval fraction{1, 1};  // of what sees nothing of the light
    if (part.reason == ShadowReason::kNone) {
      fraction = bounds[static_cast<std::size_t>(part.result - light.parts.data())].fraction;
    }
    if (side.parts.size() == 1) return fraction;
    const Enclosure area = to_enclosure(part_area(scene, scene.parts[first + i]));
    total = total + area;
    deep = deep + area * to_enclosure(fraction);
  }
  if (total.lower <= 0) return {0, 1};
  const Interval share = to_interval(deep / total);
  return {std::max(share.lower, 0.0), std::min(share.upper, 1.0)};
}

std::string_view reason_name(ShadowReason reason) {
  switch (reason) {
    case ShadowReason::kNone:
      return "";
    case ShadowReason::kFacesAway:
      return "faces-away";
    case ShadowReason::kLightInPlane:
      return "light-in-plane";
    case ShadowReason::kBehindLight:
      return "behind-light";
  }
  return "";
}

std::string_view state_name(LightState state) {
  switch (state) {
    case LightState::kLit:
      return "lit";
    case LightState::kShadow:
      return "shadow";
    case LightState::kPenumbra:
      return "penumbra";
    case LightState::kUmbra:
      return "umbra";
  }
  return "";
}

std::string_view side_name(Side side) { return side == Side::kBack ? "back" : "front"; }

FacingShare facing_share(const PreparedScene& scene, const LightResult& light) {
  FacingShare share;
  for (std::size_t polygon = 0; polygon + 1 < scene.first_part.size(); ++polygon) {
    const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
    if (first == last) continue;
    bool faces = false, in_plane = true;
    for (std::uint32_t part = first; part < last; ++part) {
      for (const PartResult& result : results_of(light, part)) {
        faces = faces || result.reason == ShadowReason::kNone;
        in_plane = in_plane && result.reason == ShadowReason::kLightInPlane;
      }
    }
    ++(faces ? share.facing : in_plane ? share.in_plane : share.away);
  }
  return share;
}

}  // namespace gnomon::report
