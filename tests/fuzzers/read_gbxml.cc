// SPDX-License-Identifier: GPL-3.0-or-later
// A gbXML file.
#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon::fuzzers;
  check_scene_file(text_of(data, size), "input.gbxml.xml", gnomon::SceneFormat::kGbXml);
  return 0;
}
