// SPDX-License-Identifier: GPL-3.0-or-later
// A glTF file, JSON or binary, beside which there are no others.
#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon::fuzzers;
  check_scene_file(text_of(data, size), "input.gltf", gnomon::SceneFormat::kGltf);
  return 0;
}
