// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/scene_change.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "report/sides/polygon_sides.h"

namespace gnomon::comparison {

namespace {

constexpr int kScale = 20;

/// n * 2^exponent, in the base of n.
Number times_power_of_two(const Number& n, int exponent) {
  if (n.is_zero()) return n;
  if (!n.is_decimal()) return Number::from_dyadic(n.mantissa(), n.exponent() + exponent);
  // 2^-k is 5^k 10^-k.
  mpz_class factor;
  const auto size = static_cast<unsigned long>(std::abs(exponent));
  mpz_ui_pow_ui(factor.get_mpz_t(), exponent < 0 ? 5 : 2, size);
  return Number::from_decimal(n.mantissa() * factor, n.exponent() + std::min(exponent, 0));
}

Number negated(const Number& n) {
  return n.is_decimal() ? Number::from_decimal(-n.mantissa(), n.exponent())
                        : Number::from_dyadic(-n.mantissa(), n.exponent());
}

template <class Map>
Scene mapped(const Scene& scene, const Map& map) {
  Scene result = scene;
  for (Position& vertex : result.vertices) map(vertex);
  for (Light& light : result.lights) {
    map(light.position);
    for (Position& corner : light.loop) map(corner);
  }
  return result;
}

template <int exponent>
Scene scaled(const Scene& scene) {
  return mapped(scene, [](Position& position) {
    for (Number& n : position) n = times_power_of_two(n, exponent);
  });
}

/// Coordinate k becomes the one that is `turn` places further on, which keeps orientations.
template <int turn>
Scene with_axes_turned(const Scene& scene) {
  return mapped(scene, [](Position& position) {
    std::rotate(position.begin(), position.begin() + turn, position.end());
  });
}

template <class Change>
void change_loops(Scene& scene, const Change& change) {
  for (Polygon& polygon : scene.polygons) {
    change(polygon.loop);
    for (std::vector<VertexId>& hole : polygon.holes) change(hole);
  }
  for (Light& light : scene.lights) change(light.loop);
}

// Loops are reversed so that fronts stay fronts.
Scene mirrored(const Scene& scene) {
  Scene result = mapped(scene, [](Position& position) { position[0] = negated(position[0]); });
  change_loops(result, [](auto& loop) { std::ranges::reverse(loop); });
  return result;
}

Scene with_loops_turned(const Scene& scene) {
  Scene result = scene;
  change_loops(result, [](auto& loop) {
    if (!loop.empty()) std::rotate(loop.begin(), loop.begin() + 1, loop.end());
  });
  return result;
}

Scene with_polygons_reversed(const Scene& scene) {
  Scene result = scene;
  std::ranges::reverse(result.polygons);
  return result;
}

Scene with_vertices_reversed(const Scene& scene) {
  Scene result = scene;
  std::ranges::reverse(result.vertices);
  const auto last = static_cast<VertexId>(result.vertices.size() - 1);
  for (Polygon& polygon : result.polygons) {
    for (VertexId& vertex : polygon.loop) vertex = last - vertex;
    for (std::vector<VertexId>& hole : polygon.holes) {
      for (VertexId& vertex : hole) vertex = last - vertex;
    }
  }
  return result;
}

constexpr std::array<SceneChange, 8> kChanges = {{
    {"times 2^20", "every length 2^20 times as long", scaled<kScale>},
    {"times 2^-20", "every length 2^-20 times as long", scaled<-kScale>},
    {"axes yzx", "x, y, z become y, z, x", with_axes_turned<1>},
    {"axes zxy", "x, y, z become z, x, y", with_axes_turned<2>},
    {"mirror", "x becomes -x, and loops are reversed", mirrored},
    {"loops turned", "every loop begins with its second corner", with_loops_turned},
    {"polygons reversed", "polygons in reverse order", with_polygons_reversed},
    {"vertices reversed", "vertices numbered in reverse order", with_vertices_reversed},
}};

}  // namespace

std::span<const SceneChange> scene_changes() { return kChanges; }

const SceneChange* change_by_name(std::string_view name) {
  const auto* const found = std::ranges::find(kChanges, name, &SceneChange::name);
  return found == kChanges.end() ? nullptr : found;
}

SideShares shares_of(const Scene& scene, const PreparedScene& prepared, const ShadowResult& result,
                     bool exact) {
  SideShares shares;
  for (const LightResult& light : result.lights) {
    const std::string& id = scene.lights[prepared.lights[light.light].light].id;
    for (const report::ClassifiedSide& side : report::classified_sides(prepared, light, exact)) {
      shares[{id, scene.polygons[side.polygon].id, side.side}] =
          exact && side.exact_lit ? side.exact_lit->get_d() : side.lit.middle();
    }
  }
  return shares;
}

Difference difference_of(const SideShares& before, const SideShares& after) {
  Difference difference;
  const auto compare = [&](const SideShares::key_type& place, double a, double b) {
    if (a == b) return;
    ++difference.sides;
    const double by = std::fabs(a - b);
    if (!(by > difference.worst_share)) return;
    difference.worst_share = by;
    const auto& [light, polygon, side] = place;
    difference.worst =
        "light " + light + ", polygon " + polygon + " (" + std::string(name_of(side)) + ')';
  };
  for (const auto& [place, share] : before) {
    const auto found = after.find(place);
    compare(place, share, found == after.end() ? 0 : found->second);
  }
  for (const auto& [place, share] : after) {
    if (!before.contains(place)) compare(place, 0, share);
  }
  return difference;
}

}  // namespace gnomon::comparison
