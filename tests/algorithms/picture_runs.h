// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of methods in the picture begin with: options by name, samples, and a scene of every
// generator.
#ifndef GNOMON_TESTS_ALGORITHMS_PICTURE_RUNS_H
#define GNOMON_TESTS_ALGORITHMS_PICTURE_RUNS_H

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "fuzz/generate/generator.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/pixels.h"
#include "gnomon/kernel/kernel_list.h"
#include "gnomon/scene/scene.h"

namespace gnomon::test {

inline PixelOptions options_of(const std::string& method, KernelId kernel = KernelId::kPlane) {
  const auto selection = parse_method(method, Domain::kImageSpace);
  EXPECT_TRUE(selection) << method;
  PixelOptions options;
  options.kernel.id = kernel;
  options.method = selection->id;
  options.options = selection->values;
  options.jobs = 1;
  return options;
}

inline Pixels pixels_of(const PreparedView& view, const PixelOptions& options) {
  auto pixels = compute_pixels(view.scene, view.frame, options);
  EXPECT_TRUE(pixels) << to_string(pixels.error());
  return pixels ? *std::move(pixels) : Pixels();
}

/// Of every generator a scene with point and directional lights.
inline std::vector<Scene> scenes_of_all_generators() {
  std::vector<Scene> result;
  for (const std::string& name : fuzz::generator_names()) {
    if (name.starts_with("area")) continue;
    Scene scene = fuzz::Generator::parse(name).value().make(3).scene;
    std::erase_if(scene.lights, [](const Light& light) { return light.has_area(); });
    if (!scene.lights.empty()) result.push_back(std::move(scene));
  }
  return result;
}

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_ALGORITHMS_PICTURE_RUNS_H
