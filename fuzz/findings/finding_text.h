// SPDX-License-Identifier: GPL-3.0-or-later
// The words and the JSON of a finding.
#ifndef GNOMON_FUZZ_FINDINGS_FINDING_TEXT_H
#define GNOMON_FUZZ_FINDINGS_FINDING_TEXT_H

#include <string>

#include "fuzz/findings/finding.h"
#include "fuzz/findings/finding_evidence.h"

namespace gnomon::fuzz {

/// verdict.json: all that read_finding() needs beside the scenes, and the numbers for people.
std::string verdict_text(const Finding& finding, const Evidence& evidence);
/// Reads a finding without its scenes. Errors: kSyntax, kFormat, those of parse_subject().
Expected<Finding> parse_verdict(const std::string& text, const std::string& file);

/// README.md; `name` is the folder's.
std::string readme_text(const Finding& finding, const Evidence& evidence, const std::string& name);

/// The verdict in short, for the "extra" of scene.json.
std::string short_verdict(const Failure& failure);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_FINDINGS_FINDING_TEXT_H
