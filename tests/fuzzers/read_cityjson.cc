// SPDX-License-Identifier: GPL-3.0-or-later
// A CityJSON file.
#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon::fuzzers;
  check_scene_file(text_of(data, size), "input.city.json", gnomon::SceneFormat::kCityJson);
  return 0;
}
