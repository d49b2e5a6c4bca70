// SPDX-License-Identifier: GPL-3.0-or-later
// Failures of properties, in words and as an exit status.
#ifndef GNOMON_CLI_COMMON_FAILURES_H
#define GNOMON_CLI_COMMON_FAILURES_H

#include <span>
#include <string>
#include <vector>

#include "cli/common/exit_status.h"
#include "fuzz/check/property.h"
#include "fuzz/check/subject.h"
#include "report/junit/junit.h"
#include "report/text/text_sink.h"

namespace gnomon::cli {

/// Every kernel, rounded ones with each policy.
std::vector<fuzz::Subject> all_subjects();

/// Is the failure a bug of ours, and not of a rounded kernel or of a foreign program?
bool is_ours(const fuzz::Failure& failure);

/// 0 if there is none, 4 if one is ours, else 1.
ExitStatus status_of_failures(std::span<const fuzz::Failure> failures);

/// One case: what was checked, and every failure with its sentence.
std::string case_text(const std::string& name, const fuzz::CaseReport& report);

/// The same for programs: "format": "gnomon-case".
void write_case_json(report::TextSink& sink, const std::string& name,
                     const fuzz::CaseReport& report);
/// And for spreadsheets, a line a failure.
std::string case_csv(const fuzz::CaseReport& report);

/// A failure of a rounded kernel fails its case as it fails the command.
std::vector<report::JUnitCase> junit_cases_of(const std::string& group,
                                              const fuzz::CaseReport& report);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_FAILURES_H
