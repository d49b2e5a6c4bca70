// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes by code (gnomon/fuzz/scene_code.h) under area lights: receiver by receiver and with merged
// trees the classes are the same, and the oracle's.
#include <algorithm>

#include "algorithm_check.h"
#include "fuzz/generate/scene_code.h"
#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  Scene scene = fuzz::scene_from_code({data, size}, {.vertices = 40, .polygons = 5, .lights = 1});
  std::erase_if(scene.lights, [](const Light& light) { return !light.has_area(); });
  fuzzers::check_code(scene);
  fuzzers::check_algorithms(scene, {"plane", "plane/sectors/merged", "rational"},
                            {"double", "double+thin/sectors/merged", "float"},
                            size > 2 ? data[2] : 1);
  return 0;
}
