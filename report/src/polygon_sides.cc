// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/report/polygon_sides.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "gnomon/kernel/nearest_double.h"
#include "gnomon/oracle/enclosure.h"

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

PartSide part_side(const PartResult& result, Side side) {
  PartSide part;
  part.result = &result;
  if (result.reason != ShadowReason::kNone) {
    part.reason = result.reason;
  } else if (result.side != side) {
    part.reason = ShadowReason::kFacesAway;
  }
  if (part.reason == ShadowReason::kNone) {
    part.lit = result.lit;
    part.shadow = result.shadow;
  } else {
    part.shadow = {1, 1};
  }
  return part;
}

/// Sum of weight * share over sum of weights, where the weights are exact.
void sum_exactly(const PreparedScene& scene, std::uint32_t first, bool exact,
                 ClassifiedSide& side) {
  // Areas in one plane are proportional to any non-zero component of the area vector.
  const std::array<mpz_class, 3> normal = doubled_area_vector(scene, scene.parts[first]);
  std::size_t axis = 0;
  while (normal[axis] == 0) ++axis;
  std::vector<mpz_class> weights;
  mpz_class total = 0;
  for (std::size_t i = 0; i < side.parts.size(); ++i) {
    weights.push_back(abs(doubled_area_vector(scene, scene.parts[first + i])[axis]));
    total += weights.back();
  }
  Enclosure lit{0, 0}, shadow{0, 0};
  mpq_class exact_lit = 0, exact_shadow = 0;
  for (std::size_t i = 0; i < side.parts.size(); ++i) {
    mpq_class weight(weights[i], total);
    weight.canonicalize();
    const Enclosure bounds = oracle::enclose(weight);
    lit = lit + bounds * to_enclosure(side.parts[i].lit);
    shadow = shadow + bounds * to_enclosure(side.parts[i].shadow);
    if (exact) {
      exact_lit += weight * exact_lit_share(side.parts[i]);
      exact_shadow += weight * exact_shadow_share(side.parts[i]);
    }
  }
  side.lit = to_interval(lit);
  side.shadow = to_interval(shadow);
  if (exact) {
    side.exact_lit = std::move(exact_lit);
    side.exact_shadow = std::move(exact_shadow);
  }
}

void sum_by_enclosure(const PreparedScene& scene, std::uint32_t first, ClassifiedSide& side) {
  Enclosure total{0, 0}, lit{0, 0}, shadow{0, 0};
  for (std::size_t i = 0; i < side.parts.size(); ++i) {
    const Enclosure area = to_enclosure(part_area(scene, scene.parts[first + i]));
    total = total + area;
    lit = lit + area * to_enclosure(side.parts[i].lit);
    shadow = shadow + area * to_enclosure(side.parts[i].shadow);
  }
  if (total.lower <= 0) return;
  side.lit = to_interval(lit / total);
  side.shadow = to_interval(shadow / total);
  side.lit.upper = std::min(side.lit.upper, 1.0);
  side.shadow.upper = std::min(side.shadow.upper, 1.0);
}

}  // namespace

mpq_class exact_lit_share(const PartSide& part) {
  return part.reason == ShadowReason::kNone ? part.result->exact_lit : mpq_class(0);
}

mpq_class exact_shadow_share(const PartSide& part) {
  return part.reason == ShadowReason::kNone ? part.result->exact_shadow : mpq_class(1);
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
    std::size_t facing = 0;
    for (std::uint32_t light : lights) {
      const Sign sign = sign_at_light(scene, part, scene.lights[light].point);
      if (sign == Sign::kPositive || (sign == Sign::kNegative && part.two_sided)) ++facing;
    }
    if (facing > 0) sum += static_cast<double>(facing) * part_area(scene, part).middle();
  }
  return sum;
}

std::vector<ClassifiedSide> polygon_sides(const PreparedScene& scene, const LightResult& light,
                                          std::uint32_t polygon, bool exact) {
  const std::uint32_t first = scene.first_part[polygon], last = scene.first_part[polygon + 1];
  std::vector<ClassifiedSide> sides;
  if (first == last) return sides;
  for (const Side side : {Side::kFront, Side::kBack}) {
    for (std::uint32_t part = first; part < last; ++part) {
      const PartResult& result = light.parts[part];
      if (result.reason != ShadowReason::kNone || result.side != side) continue;
      sides.push_back({});
      sides.back().side = side;
      break;
    }
  }
  if (sides.empty()) sides.push_back({});

  bool coplanar = true;
  for (std::uint32_t part = first; part < last; ++part) {
    coplanar = coplanar && scene.parts[part].plane == scene.parts[first].plane;
  }
  const mpq_class area = precise_area(scene, polygon);

  for (ClassifiedSide& side : sides) {
    side.polygon = polygon;
    side.coplanar = coplanar;
    side.area = area;
    for (std::uint32_t part = first; part < last; ++part) {
      side.parts.push_back(part_side(light.parts[part], side.side));
    }
    side.reason = side.parts.front().reason;
    for (const PartSide& part : side.parts) {
      if (part.reason != side.reason) side.reason = ShadowReason::kNone;
    }
    if (side.parts.size() == 1) {
      const PartSide& part = side.parts.front();
      side.lit = part.lit;
      side.shadow = part.shadow;
      if (exact) {
        side.exact_lit = exact_lit_share(part);
        side.exact_shadow = exact_shadow_share(part);
      }
    } else if (side.reason != ShadowReason::kNone) {
      side.shadow = {1, 1};
      if (exact) side.exact_lit = 0, side.exact_shadow = 1;
    } else if (coplanar) {
      sum_exactly(scene, first, exact, side);
    } else {
      sum_by_enclosure(scene, first, side);
    }
  }
  return sides;
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
      faces = faces || light.parts[part].reason == ShadowReason::kNone;
      in_plane = in_plane && light.parts[part].reason == ShadowReason::kLightInPlane;
    }
    ++(faces ? share.facing : in_plane ? share.in_plane : share.away);
  }
  return share;
}

}  // namespace gnomon::report
