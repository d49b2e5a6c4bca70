// SPDX-License-Identifier: GPL-3.0-or-later
// A PLY file, text or binary of either byte order. What can be read is written as text.
#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon::fuzzers;
  check_scene_file(text_of(data, size), "input.ply", gnomon::SceneFormat::kPlyAscii);
  return 0;
}
