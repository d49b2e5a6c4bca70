// SPDX-License-Identifier: GPL-3.0-or-later
// What a finding shows beside its numbers: the subject's answer and the exact one as pictures, the
// place that is wrong, the first decision that went another way.
#ifndef GNOMON_FUZZ_FINDINGS_FINDING_EVIDENCE_H
#define GNOMON_FUZZ_FINDINGS_FINDING_EVIDENCE_H

#include <filesystem>
#include <optional>
#include <string>

#include "fuzz/findings/finding.h"
#include "gnomon/oracle/compare.h"

namespace gnomon::fuzz {

struct Evidence {
  Failure failure;  // as the shrunken scene shows it
  bool shown_again = false;
  std::string light;                       // that the pictures are of; empty: no pictures
  std::string candidate_svg, exact_svg;    // empty: none
  std::string no_candidate;                // why there is none
  std::optional<oracle::Witness> witness;  // the worst place
  std::string decision;                    // the first that differs, a sentence; empty: none
  std::string decision_note;               // what there is to say about it, or why there is none
  std::string foreign_result;              // what a foreign program wrote
  std::string fixture, no_fixture;         // the text, or why there is none
};

/// `scene_file` holds finding.scene, for foreign programs; `scene` is what is shown.
Evidence gather_evidence(const Finding& finding, const Scene& scene,
                         const std::filesystem::path& scene_file);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_FINDINGS_FINDING_EVIDENCE_H
