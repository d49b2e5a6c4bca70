// SPDX-License-Identifier: GPL-3.0-or-later
// Verdicts as JUnit XML, which CI systems show.
//
// Guarantees: well-formed XML 1.0 whatever the texts hold (characters that XML has not become
// U+FFFD); no times, so that the same verdicts give the same bytes.
#ifndef GNOMON_REPORT_JUNIT_JUNIT_H
#define GNOMON_REPORT_JUNIT_JUNIT_H

#include <cstdint>
#include <span>
#include <string>

#include "report/text/text_sink.h"

namespace gnomon::report {

/// kFailed: a verdict that counts for the exit status; kError: there is no verdict, and that
/// counts; kSkipped: whatever it is, it counts for nothing.
enum class JUnitOutcome : std::uint8_t { kPassed, kFailed, kError, kSkipped };

struct JUnitCase {
  std::string group, name;  // "certify.courtyard", "double+identity"
  JUnitOutcome outcome = JUnitOutcome::kPassed;
  std::string message;  // of all but kPassed: one line
  std::string text;     // more of it
};

/// One suite called `name`.
void write_junit(TextSink& sink, const std::string& name, std::span<const JUnitCase> cases);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_JUNIT_JUNIT_H
