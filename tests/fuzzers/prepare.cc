// SPDX-License-Identifier: GPL-3.0-or-later
// Preparation of scenes by code (gnomon/fuzz/scene_code.h), with larger loops and holes: what comes
// out is what the definitions say, by the oracle's own geometry, or the error says why not.
#include "gnomon/scene/prepare.h"

#include "algorithm_check.h"
#include "fuzz/generate/scene_code.h"
#include "gnomon/oracle/prepared_check.h"
#include "gnomon/scene/validate.h"
#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  const Scene scene = fuzz::scene_from_code({data, size}, {.lights = 1});
  fuzzers::require(validate_scene(scene).has_value(), "a code of an invalid scene");
  fuzzers::check_code(scene);
  const auto prepared = prepare(scene);
  if (!prepared) {
    fuzzers::check_error(prepared.error(), scene.file, {}, false);
    return 0;
  }
  for (const auto& finding : oracle::check_prepared(scene, *prepared, 1)) {
    fuzzers::broken("polygon " + finding.polygon + ": " + finding.text);
  }
  return 0;
}
