// SPDX-License-Identifier: GPL-3.0-or-later
// All properties (property.h) of one scene, in this process: every subject runs, the oracle judges
// it in its three ways, exact kernels are compared bit for bit, and one metamorphic relation,
// chosen by the seed, is tried. See isolated.h for subjects that may crash or hang.
#ifndef GNOMON_FUZZ_CHECK_CHECK_H
#define GNOMON_FUZZ_CHECK_CHECK_H

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "fuzz/check/property.h"
#include "fuzz/check/subject.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct CheckOptions {
  std::vector<Subject> subjects;
  std::vector<Property> properties;  // to be checked; empty: all. Crashes always count
  /// No claims, no files written and read back, a relation on every other scene only; of the exact
  /// subjects the oracle judges the first alone: the others must have the same fractions.
  bool brief = false;
  double tolerance = 1e-9;  // of rounded and foreign results: fraction of each polygon
  /// Of foreign results that tell shares alone; none: half a unit of the last digit written.
  std::optional<double> share_tolerance;
  std::optional<double> width;  // scene units; default 1e-9 of the scene's diagonal
  bool strict = false;          // tolerance and width 0
  std::uint64_t seed = 1;       // of the metamorphic relation
  std::uint64_t max_fragments = 200'000;
  double command_seconds = 10;  // for each run of a foreign program
  std::uint64_t command_megabytes = 2048;
  /// Told before each step: "preparation", "oracle", "subject double", ... For whoever watches a
  /// process that may not come back.
  std::function<void(std::string_view stage)> stage;
};

/// Never throws for what a subject does; a scene that cannot be prepared is a kRefusal of subject
/// "prepare".
CaseReport check_scene(const Scene& scene, const CheckOptions& options);

/// What `gnomon fuzz` checks where no subject is named: the exact kernels by all algorithms.
std::vector<Subject> exact_subjects();

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_CHECK_H
