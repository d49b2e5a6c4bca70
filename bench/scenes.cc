// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

#include "gnomon/scene/generate.h"
#include "scene/base/random.h"

namespace gnomon::bench {
namespace {

[[noreturn]] void stop(const std::string& name, const Error& error) {
  fmt::print(stderr, "gnomon_bench: {}: {}\n", name, to_string(error));
  std::exit(2);
}

using Int3 = std::array<std::int64_t, 3>;

Position position_of(const Int3& p) {
  return {Number(static_cast<double>(p[0])), Number(static_cast<double>(p[1])),
          Number(static_cast<double>(p[2]))};
}

void add_polygon(Scene& scene, const std::vector<Int3>& corners) {
  Polygon polygon;
  polygon.id = std::to_string(scene.polygons.size());
  for (const Int3& corner : corners) {
    polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
    scene.vertices.push_back(position_of(corner));
  }
  scene.polygons.push_back(std::move(polygon));
}

void add_lamp(Scene& scene, const Int3& position) {
  Light lamp;
  lamp.id = "lamp";
  lamp.position = position_of(position);
  scene.lights.push_back(std::move(lamp));
}

/// A horizontal square round the z axis, seen from above.
std::vector<Int3> square(std::int64_t reach, std::int64_t z) {
  return {{-reach, -reach, z}, {reach, -reach, z}, {reach, reach, z}, {-reach, reach, z}};
}

/// The number times 3/10 as a decimal. Requires: a whole number.
Number scaled(const Number& number, NumberMeaning meaning) {
  const mpz_class mantissa = mpq_class(number.exact() * 3).get_num();
  const Number decimal = Number::from_decimal(mantissa, -1);
  return meaning == NumberMeaning::kDecimal ? decimal : Number(decimal.nearest());
}

}  // namespace

Scene generated(const SceneRecipe& recipe, std::uint64_t seed) {
  Expected<Scene> scene = generate(recipe.generator, recipe.parameters, seed);
  if (!scene) stop(recipe.generator, scene.error());
  if (recipe.coordinates == Coordinates::kGrid) return std::move(*scene);
  scene->numbers = recipe.coordinates == Coordinates::kDecimals ? NumberMeaning::kDecimal
                                                                : NumberMeaning::kDouble;
  for (Position& position : scene->vertices) {
    for (Number& number : position) number = scaled(number, scene->numbers);
  }
  for (Light& light : scene->lights) {
    for (Number& number : light.position) number = scaled(number, scene->numbers);
    for (Position& corner : light.loop) {
      for (Number& number : corner) number = scaled(number, scene->numbers);
    }
  }
  return std::move(*scene);
}

PreparedScene prepared_or_stop(const Scene& scene) {
  Expected<PreparedScene> result = prepare(scene);
  if (!result) stop(scene.name, result.error());
  return std::move(*result);
}

PreparedScene make_scene(const SceneRecipe& recipe, std::uint64_t seed) {
  return prepared_or_stop(generated(recipe, seed));
}

PreparedScene long_sticks(std::int64_t n, std::uint64_t seed) {
  constexpr std::int64_t kExtent = 1 << 18;
  const auto spacing =
      static_cast<std::int64_t>(static_cast<double>(kExtent) / std::cbrt(static_cast<double>(n)));
  const std::int64_t half = 4 * spacing, width = spacing / 8;
  Random random(seed);
  const auto vector = [&](std::int64_t reach) {
    return Int3{random.between(-reach, reach), random.between(-reach, reach),
                random.between(-reach, reach)};
  };
  Scene scene;
  scene.name = "long-sticks";
  scene.two_sided = true;
  for (std::int64_t i = 0; i < n;) {
    const Int3 centre = vector(kExtent / 2), along = vector(half), across = vector(width);
    const Int3 normal{along[1] * across[2] - along[2] * across[1],
                      along[2] * across[0] - along[0] * across[2],
                      along[0] * across[1] - along[1] * across[0]};
    if (normal == Int3{}) continue;
    std::vector<Int3> corners(4);
    for (std::size_t k = 0; k < 3; ++k) {
      corners[0][k] = centre[k] - along[k];
      corners[1][k] = centre[k] + along[k];
      corners[2][k] = centre[k] + along[k] + across[k];
      corners[3][k] = centre[k] - along[k] + across[k];
    }
    add_polygon(scene, corners);
    ++i;
  }
  add_lamp(scene, {kExtent / 4 + 1, kExtent / 8 + 3, 2 * kExtent + 5});
  return prepared_or_stop(scene);
}

PreparedScene wheel_of_needles(std::int64_t n) {
  constexpr std::int64_t kHeight = 1 << 22, kSpacing = 64;
  const std::int64_t stretch = (std::int64_t{1} << 20) / n;
  Scene scene;
  scene.name = "wheel-of-needles";
  scene.two_sided = true;
  add_polygon(scene, square(std::int64_t{1} << 21, -1));
  // 8 n points on the border of a square, evenly spaced; needle i takes the stretch of three
  // eighths from point 8 i, and overlaps the next ones.
  const auto rim = [&](std::int64_t k, std::int64_t z) {
    const std::int64_t side = 2 * n, wrapped = k % (4 * side), quarter = wrapped / side,
                       t = wrapped % side - n;
    const Int3 point = quarter == 0   ? Int3{n, t, 0}
                       : quarter == 1 ? Int3{-t, n, 0}
                       : quarter == 2 ? Int3{-n, -t, 0}
                                      : Int3{t, -n, 0};
    return Int3{point[0] * stretch, point[1] * stretch, z};
  };
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t z = kSpacing * (i * 7919 % n);
    add_polygon(scene, {{0, 0, z}, rim(8 * i, z), rim(8 * i + 21, z)});
  }
  add_lamp(scene, {0, 0, kHeight});
  return prepared_or_stop(scene);
}

PreparedScene stack_of_sheets(std::int64_t n, std::uint64_t seed) {
  constexpr std::int64_t kHeight = 1 << 24, kReach = 1 << 20, kSpacing = 1 << 10, kJitter = 8;
  Random random(seed);
  Scene scene;
  scene.name = "stack-of-sheets";
  scene.two_sided = true;
  add_polygon(scene, square(2 * kReach, -1));
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t z = i * kSpacing;
    // Seen from the lamp, all sheets are equally large.
    std::vector<Int3> corners = square(kReach * (kHeight - z) / kHeight, z);
    for (Int3& corner : corners) {
      for (std::size_t k = 0; k < 2; ++k) corner[k] += random.between(-kJitter, kJitter);
    }
    add_polygon(scene, corners);
  }
  add_lamp(scene, {1, 3, kHeight});
  return prepared_or_stop(scene);
}

}  // namespace gnomon::bench
