// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/failures.h"

#include "fuzz/check/check.h"
#include "report/text/table.h"

namespace gnomon::cli {

std::vector<fuzz::Subject> all_subjects() {
  std::vector<fuzz::Subject> subjects = fuzz::exact_subjects();
  for (const char* name : {"float", "float+thin", "double", "double+thin", "double+identity",
                           "double+identity+thin", "longdouble", "epick"}) {
    subjects.push_back(*fuzz::parse_subject(name));
  }
  return subjects;
}

bool is_ours(const fuzz::Failure& failure) {
  switch (failure.property) {
    case fuzz::Property::kAgreement:
    case fuzz::Property::kMetamorphic:
    case fuzz::Property::kPreparation:
    case fuzz::Property::kSelf:
      return true;
    default: {
      // Steps before and after the subjects have names that no subject has.
      const auto subject = fuzz::parse_subject(failure.subject);
      return !subject || subject->exact();
    }
  }
}

ExitStatus status_of_failures(std::span<const fuzz::Failure> failures) {
  ExitStatus status = kDone;
  for (const fuzz::Failure& failure : failures) {
    if (is_ours(failure)) return kDisagree;
    status = kFailed;
  }
  return status;
}

std::string case_text(const std::string& name, const fuzz::CaseReport& report) {
  constexpr std::size_t kWidth = report::TextTable::kWidth;
  std::string text = report::wrapped(name + ": " + std::to_string(report.polygons) +
                                         (report.polygons == 1 ? " polygon, " : " polygons, ") +
                                         std::to_string(report.lights) +
                                         (report.lights == 1 ? " light" : " lights"),
                                     kWidth, 0, 2);
  for (const fuzz::Failure& failure : report.failures) {
    text += report::wrapped(failure.signature() + ": " + failure.text, kWidth, 0, 2);
  }
  if (report.failures.empty()) {
    std::string subjects;
    for (const std::string& subject : report.subjects) {
      subjects += (subjects.empty() ? "" : ", ") + subject;
    }
    text += report::wrapped("every property holds: " + subjects, kWidth, 0, 2);
  }
  return text;
}

}  // namespace gnomon::cli
