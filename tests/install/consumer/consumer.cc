// SPDX-License-Identifier: GPL-3.0-or-later
// A floor, a smaller square above it, and a lamp above both: a quarter of the floor is in shadow.
#include <iostream>

#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace {

/// An axis-parallel square around the z axis, counter-clockwise seen from above.
void add_square(gnomon::Scene& scene, const char* id, double half_side, double height) {
  const auto first = static_cast<gnomon::VertexId>(scene.vertices.size());
  const double corners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const auto& corner : corners) {
    scene.vertices.push_back({gnomon::Number(half_side * corner[0]),
                              gnomon::Number(half_side * corner[1]), gnomon::Number(height)});
  }
  gnomon::Polygon polygon;
  polygon.id = id;
  polygon.loop = {first, first + 1, first + 2, first + 3};
  scene.polygons.push_back(polygon);
}

}  // namespace

int main() {
  gnomon::Scene scene;
  add_square(scene, "floor", 4, 0);
  add_square(scene, "plate", 1, 1);
  gnomon::Light lamp;
  lamp.id = "lamp";
  lamp.position = {gnomon::Number(0.0), gnomon::Number(0.0), gnomon::Number(2.0)};
  scene.lights.push_back(lamp);

  const auto prepared = gnomon::prepare(scene);
  if (!prepared) {
    std::cerr << gnomon::to_string(prepared.error()) << '\n';
    return 2;
  }
  gnomon::ShadowOptions options;
  options.output.exact_fractions = true;
  const auto result = gnomon::compute_shadows(*prepared, options);
  if (!result) {
    std::cerr << gnomon::to_string(result.error()) << '\n';
    return 2;
  }
  const std::uint32_t floor_part = prepared->first_part[0];
  std::cout << "lit fraction of the floor: " << result->lights[0].exact_fractions[floor_part].lit
            << '\n';
  return 0;
}
