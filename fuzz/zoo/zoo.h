// SPDX-License-Identifier: GPL-3.0-or-later
// The bug zoo (docs/bug-zoo.md): for each mistake that the papers warn of, who makes it, who does
// not, where scenes come from that show it, and which of the oracle's ways notice.
//
// A scene shows a mistake if the mutant fails on it and the sound subject, the same kernel and
// algorithms without the mistake, does not: what rounding alone gets wrong does not count.
#ifndef GNOMON_FUZZ_ZOO_ZOO_H
#define GNOMON_FUZZ_ZOO_ZOO_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/mistakes/mistake.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct ZooEntry {
  std::string_view name;  // of the fixture tests/regressions/zoo/?_NAME.json and the picture
  Mistake mistake = Mistake::kNone;
  std::string_view sound;      // subject; the mutant is this and "~MISTAKE"
  std::string_view generator;  // of the scenes
  // The class of failure that the fixture shows: of the oracle's regions, or "t-vertex".
  std::string_view disagreement;

  std::string mutant() const;
};

/// In order of the mistakes; a mistake that area lights and others have in different ways, or that
/// several algorithms make, has several.
std::span<const ZooEntry> zoo();
const ZooEntry* zoo_entry(std::string_view name);

/// What the oracle says of one result, in each of its ways (docs/oracle.md).
struct OracleWays {
  bool regions = false;  // exact regions disagree
  bool points = false;   // so does the visibility of single points
  bool claims = false;   // what the result claims does not hold
  bool mesh = false;     // the mesh made of it has T-vertices
  bool samples = false;  // a picture from one of seven eyes has wrong samples
};

struct ZooVerdict {
  OracleWays mutant;         // points and claims are asked only where regions disagree
  bool sound_fails = false;  // by regions, claims or mesh: then the scene shows nothing
  std::string disagreement;  // of the mutant: "misclassified", "uncovered", ..., "t-vertex"
  std::string text;          // one sentence
  double jump = 0;           // of the shade at a T-vertex: the largest, in the light's intensity

  bool shows() const { return (mutant.regions || mutant.mesh || mutant.samples) && !sound_fails; }
};

/// Runs both on one scene. Errors: those of prepare(); kUsage for a scene without a light that the
/// mistake is about; kLimit.
Expected<ZooVerdict> judge_mutant(const ZooEntry& entry, const Scene& scene);

/// SVG: the exact answer and what the mutant makes of it, side by side; what is wrong is in a
/// signal colour. Of the first light on which it shows. Errors: as judge_mutant(); kUsage if the
/// scene does not show the mistake.
Expected<std::string> zoo_picture(const ZooEntry& entry, const Scene& scene);

/// What a hunt came to.
struct ZooRow {
  std::string_view name, mistake;
  std::string mutant;
  std::uint64_t seed = 0;
  std::uint64_t scenes = 0;  // made, the one that shows the mistake included
  bool found = false;
  Scene scene;  // that shows it
  ZooVerdict verdict;
};

/// Makes scenes until one shows the mistake. Equal arguments give equal rows.
/// Errors: kUsage (a generator that there is not).
Expected<ZooRow> hunt(const ZooEntry& entry, std::uint64_t seed, std::uint64_t most_scenes);

/// Hunts with seeds 1, 2, ...
struct ZooTally {
  const ZooEntry* entry = nullptr;
  std::uint64_t hunts = 0, found = 0;
  std::uint64_t median = 0, most = 0;  // scenes; of hunts that found nothing, those made in vain
  std::uint64_t regions = 0, points = 0, claims = 0, mesh = 0,
                samples = 0;  // hunts whose scene each way noticed
};
Expected<ZooTally> hunt_often(const ZooEntry& entry, std::uint64_t hunts,
                              std::uint64_t most_scenes);

/// One line a tally.
std::string zoo_table(std::span<const ZooTally> tallies);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_ZOO_ZOO_H
