// SPDX-License-Identifier: GPL-3.0-or-later
// The oracle's third way: checks a result's own claims, one by one, in rational numbers in space.
// Knows no true region and shares nothing with the algorithms or with point_regions.h:
//   - fragments lie in the polygon's plane and inside the polygon, do not overlap, and their areas
//   add up;
//   - a shadow fragment's caster shadows all of it, or its reason holds;
//   - no caster shadows any area of a lit fragment;
//   - under an area light, a penumbra fragment's caster hides part of the light from all of it, an
//   umbra fragment's caster all of the light (or it is behind the light), and no caster any part
//   of the light from a lit fragment; if umbra is claimed per caster, none hides all of it from any
//   area of a penumbra fragment;
//   - claimed fractions are those of the fragments.
// What names no witness (fragments of several lights at once, and what no fragment covers) must
// have its class by what all casters together do to it. Loops painted over each other are cut down
// to what is seen of each. Holes are cut out; loops of any shape are what they wind around. A
// result that passes is right: its fragments tile every polygon and each has its proof.
//
// Exactness: exact on exact loops. Rounded loops are judged as in a comparison (verdict.h): what
// rounding of their vertices explains is excused, all other error may be `tolerance` of the
// polygon's area and `width` wide, and vertices as far off the plane.
#ifndef GNOMON_ORACLE_WITNESS_CHECK_H
#define GNOMON_ORACLE_WITNESS_CHECK_H

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::oracle {

struct WitnessFinding {
  std::string light, polygon;
  std::string text;                       // one sentence
  std::optional<std::uint64_t> fragment;  // index in the polygon's list
  Block block = Block::kLights;           // that the claim stands in
};

struct WitnessReport {
  std::vector<WitnessFinding> findings;  // at most `most`
  std::uint64_t violations = 0;          // all of them
  std::uint64_t polygons = 0, fragments = 0, exact_fragments = 0, witnesses = 0;
  std::uint64_t rounded = 0;  // pieces of error that rounding excuses, beyond what is plainly so
  bool interrupted = false;
};

struct WitnessOptions {
  double tolerance = 1e-9;      // fraction of the polygon's area, for rounded loops
  std::optional<double> width;  // scene units; default 1e-9 of the scene's diagonal
  bool strict = false;          // all loops are judged as if they claimed to be exact
  bool subset = false;          // lights and polygons may be missing
  // Exact claims are first proved by signs of integers. False: all of it in rational numbers, which
  // says the same.
  bool by_integers = true;
  std::size_t most = 100;
  std::function<void(double)> progress;
  const std::atomic<bool>* interrupted = nullptr;
};

/// Pieces of a light are checked as lights, and must tile it.
WitnessReport check_witnesses(const Scene& scene, const PreparedScene& prepared,
                              const Claims& candidate, const WitnessOptions& options = {});

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_WITNESS_CHECK_H
