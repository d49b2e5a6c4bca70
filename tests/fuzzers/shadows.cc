// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes by code (gnomon/fuzz/scene_code.h) under point and directional lights: the exact kernels
// by all algorithms agree with each other and with the oracle, and their results' claims hold.
#include <algorithm>

#include "algorithm_check.h"
#include "fuzz/generate/scene_code.h"
#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  Scene scene = fuzz::scene_from_code({data, size}, {.vertices = 40, .polygons = 8, .lights = 1});
  std::erase_if(scene.lights, [](const Light& light) { return light.has_area(); });
  fuzzers::check_code(scene);
  fuzzers::check_algorithms(scene, {"plane", "plane/svbsp", "plane/receiver", "rational"},
                            {"double", "double+thin", "double/svbsp", "float+identity/svbsp"},
                            size > 2 ? data[2] : 1);
  return 0;
}
