// SPDX-License-Identifier: GPL-3.0-or-later
// A finding: one failure on its smallest scene, as a folder that says all there is to say
// (docs/findings.md): scene.json, original.json, verdict.json, candidate.svg, exact.svg, README.md,
// fixture.json.
//
// Guarantees: a folder is there as a whole or not at all; its bytes depend on the finding alone,
// for subjects that answer the same every time; the same failure on the same scene has the same
// folder.
#ifndef GNOMON_FUZZ_FINDINGS_FINDING_H
#define GNOMON_FUZZ_FINDINGS_FINDING_H

#include <cstdint>
#include <filesystem>
#include <string>

#include "fuzz/check/check.h"
#include "fuzz/check/property.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

struct Finding {
  Scene scene;     // shrunken
  Scene original;  // as it was found
  Failure failure;
  /// Under which it was found. Only what failure needs is kept of subjects and properties
  /// (narrowed(), still_fails.h), so that check_scene(scene, check) shows it again.
  CheckOptions check;
  double seconds = 10;             // what one check was given
  std::uint64_t megabytes = 2048;  // the same
  bool locally_minimal = false;

  // Of a campaign; empty and 0 for a scene that somebody brought.
  std::string generator, recipe;
  std::uint64_t campaign_seed = 0, case_index = 0, case_seed = 0;
};

/// PROPERTY-CLASS-SUBJECT-DIGEST, of letters that every file system takes; the digest is of the
/// signature and the shrunken scene.
std::string finding_name(const Finding& finding);

/// Writes it below `folder`, which is made if need be, and returns where it is; one that is there
/// already is left as it is. The subject runs once more to be shown, but not in this process if it
/// crashed or took too much. Errors: kFile; those of scene_to_text().
Expected<std::filesystem::path> write_finding(const std::filesystem::path& folder,
                                              const Finding& finding);

/// Reads what write_finding() wrote, or that of a newer version within format 1. Errors: kFile,
/// kSyntax, kFormat, those of read_scene() and parse_subject().
Expected<Finding> read_finding(const std::filesystem::path& path);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_FINDINGS_FINDING_H
