// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "gnomon/scene/generate.h"
#include "gnomon/scene/random.h"

namespace gnomon::bench {
namespace {

[[noreturn]] void stop(const std::string& name, const Error& error) {
  fmt::print(stderr, "gnomon_bench: {}: {}\n", name, to_string(error));
  std::exit(2);
}

PreparedScene prepared(const std::string& name, const Scene& scene) {
  Expected<PreparedScene> result = prepare(scene);
  if (!result) stop(name, result.error());
  return std::move(*result);
}

}  // namespace

PreparedScene make_scene(const std::string& generator, const Parameters& parameters,
                         std::uint64_t seed) {
  const Expected<Scene> scene = generate(generator, parameters, seed);
  if (!scene) stop(generator, scene.error());
  return prepared(generator, *scene);
}

PreparedScene long_sticks(std::int64_t n, std::uint64_t seed) {
  constexpr std::int64_t kExtent = 1 << 18;
  const auto spacing =
      static_cast<std::int64_t>(static_cast<double>(kExtent) / std::cbrt(static_cast<double>(n)));
  const std::int64_t half = 4 * spacing, width = spacing / 8;
  Random random(seed);
  using Int3 = std::array<std::int64_t, 3>;
  const auto vector = [&](std::int64_t reach) {
    return Int3{random.between(-reach, reach), random.between(-reach, reach),
                random.between(-reach, reach)};
  };
  Scene scene;
  scene.name = "long-sticks";
  const auto vertex = [&](const Int3& p) {
    scene.vertices.push_back({Number(static_cast<double>(p[0])), Number(static_cast<double>(p[1])),
                              Number(static_cast<double>(p[2]))});
    return static_cast<VertexId>(scene.vertices.size() - 1);
  };
  for (std::int64_t i = 0; i < n;) {
    const Int3 centre = vector(kExtent / 2), along = vector(half), across = vector(width);
    const Int3 normal{along[1] * across[2] - along[2] * across[1],
                      along[2] * across[0] - along[0] * across[2],
                      along[0] * across[1] - along[1] * across[0]};
    if (normal == Int3{}) continue;
    Polygon polygon;
    polygon.id = std::to_string(i++);
    Int3 corner[4];
    for (std::size_t k = 0; k < 3; ++k) {
      corner[0][k] = centre[k] - along[k];
      corner[1][k] = centre[k] + along[k];
      corner[2][k] = centre[k] + along[k] + across[k];
      corner[3][k] = centre[k] - along[k] + across[k];
    }
    for (const Int3& p : corner) polygon.loop.push_back(vertex(p));
    scene.polygons.push_back(std::move(polygon));
  }
  return prepared(scene.name, scene);
}

}  // namespace gnomon::bench
