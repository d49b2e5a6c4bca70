// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of a whole scene: sides of polygons, sizes, magnitudes and texts of numbers.
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "fuzz/kinds/predicate_tables.h"

namespace gnomon::fuzz {

namespace {

bool has_mixed_sizes(const SceneView& view) {
  mpz_class least = -1, most = 0;
  for (const Face& face : view.faces) {
    const mpz_class size = extent_of(face.loop);
    if (least < 0 || size < least) least = size;
    if (size > most) most = size;
  }
  return (least << 16) < most;
}

bool is_one_sided(const SceneView& view) {
  return std::ranges::none_of(view.scene.polygons, [&](const Polygon& polygon) {
    return view.scene.is_two_sided(polygon);
  });
}

bool is_two_sided(const SceneView& view) {
  return std::ranges::all_of(view.scene.polygons, [&](const Polygon& polygon) {
    return view.scene.is_two_sided(polygon);
  });
}

/// Corners of polygons, then the positions of lights that have one.
enum class Points : std::uint8_t { kOfPolygons, kOfPolygonsAndLights };

std::vector<const Position*> positions(const Scene& scene, Points which) {
  std::vector<const Position*> all;
  for (const Polygon& polygon : scene.polygons) {
    for (const VertexId v : polygon.loop) all.push_back(&scene.vertices[v]);
  }
  if (which == Points::kOfPolygons) return all;
  for (const Light& light : scene.lights) {
    if (light.is_point()) all.push_back(&light.position);
    for (const Position& corner : light.loop) all.push_back(&corner);
  }
  return all;
}

bool differ_by_one_ulp(const Position& a, const Position& b) {
  int ulps = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = a[k].nearest(), y = b[k].nearest();
    if (x == y) continue;
    if (std::nextafter(x, y) != y) return false;
    ++ulps;
  }
  return ulps == 1;
}

bool has_nextafter(const SceneView& view) {
  if (view.scene.numbers == NumberMeaning::kDecimal) return false;
  const auto points = positions(view.scene, Points::kOfPolygonsAndLights);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (differ_by_one_ulp(*points[i], *points[k])) return true;
    }
  }
  return false;
}

/// Binary exponents of the smallest and the largest magnitude that are not 0.
struct Magnitudes {
  long least, most;
};

std::optional<Magnitudes> magnitudes(const Scene& scene, Points which) {
  std::optional<Magnitudes> range;
  for (const Position* position : positions(scene, which)) {
    for (const Number& number : *position) {
      if (number.is_zero()) continue;
      const mpq_class value = number.exact();
      const long exponent = static_cast<long>(mpz_sizeinbase(value.get_num_mpz_t(), 2)) -
                            static_cast<long>(mpz_sizeinbase(value.get_den_mpz_t(), 2));
      if (!range) range = {exponent, exponent};
      range->least = std::min(range->least, exponent);
      range->most = std::max(range->most, exponent);
    }
  }
  return range;
}

bool has_mixed_magnitudes(const SceneView& view) {
  const auto range = magnitudes(view.scene, Points::kOfPolygonsAndLights);
  return range && range->most - range->least > 64;
}

bool is_scaled_up(const SceneView& view) {
  const auto range = magnitudes(view.scene, Points::kOfPolygons);
  return range && range->most >= 300;
}

bool is_scaled_down(const SceneView& view) {
  const auto range = magnitudes(view.scene, Points::kOfPolygons);
  return range && range->most <= -300;
}

bool has_large_offset(const SceneView& view) {
  return !view.corners.empty() && std::ranges::all_of(view.corners, [&](const Integers& p) {
    return largest(p) > view.extent << 18;
  });
}

bool has_decimals(const SceneView& view) {
  if (view.scene.numbers != NumberMeaning::kDecimal) return false;
  return std::ranges::any_of(view.scene.vertices, [](const Position& p) {
    return !(p[0].is_double() && p[1].is_double() && p[2].is_double());
  });
}

}  // namespace

std::span<const KindPredicate> whole_scene_predicates() {
  static constexpr KindPredicate kPredicates[] = {
      {Kind::kSoupMixedSizes, has_mixed_sizes},
      {Kind::kOneSided, is_one_sided},
      {Kind::kTwoSided, is_two_sided},
      {Kind::kNextafter, has_nextafter},
      {Kind::kMixedMagnitudes, has_mixed_magnitudes},
      {Kind::kScaledUp, is_scaled_up},
      {Kind::kScaledDown, is_scaled_down},
      {Kind::kLargeOffset, has_large_offset},
      {Kind::kDecimals, has_decimals},
  };
  return kPredicates;
}

}  // namespace gnomon::fuzz
