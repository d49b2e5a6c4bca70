// SPDX-License-Identifier: GPL-3.0-or-later
// An STL file, ascii or binary.
#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon::fuzzers;
  check_scene_file(text_of(data, size), "input.stl", gnomon::SceneFormat::kStl);
  return 0;
}
