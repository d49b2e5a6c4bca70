// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/failures.h"

#include <algorithm>

#include "fuzz/check/check.h"
#include "fuzz/check/failure_json.h"
#include "report/json/json_writer.h"
#include "report/text/csv_field.h"
#include "report/text/number_text.h"
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

void write_case_json(report::TextSink& sink, const std::string& name,
                     const fuzz::CaseReport& report) {
  report::JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-case");
  json.member("version", 1);
  json.member("name", name);
  json.member("polygons", report.polygons);
  json.member("lights", report.lights);
  json.key("subjects");
  json.begin_array();
  for (const std::string& subject : report.subjects) json.value(subject);
  json.end_array();
  json.key("failures");
  json.begin_array();
  for (const fuzz::Failure& failure : report.failures) {
    json.begin_object();
    fuzz::write_failure_members(json, failure);
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.finish();
}

std::string case_csv(const fuzz::CaseReport& report) {
  std::string text;
  report::append_csv_line(text, {"property", "class", "subject", "light", "polygon", "width",
                                 "share", "cause", "text"});
  for (const fuzz::Failure& failure : report.failures) {
    report::append_csv_line(
        text, {std::string(fuzz::id_of(failure.property)), failure.disagreement, failure.subject,
               failure.light, failure.polygon, report::shortest(failure.width),
               report::shortest(failure.share), failure.cause, failure.text});
  }
  return text;
}

std::vector<report::JUnitCase> junit_cases_of(const std::string& group,
                                              const fuzz::CaseReport& report) {
  std::vector<report::JUnitCase> cases;
  for (const fuzz::Failure& failure : report.failures) {
    cases.push_back({group, failure.signature(), report::JUnitOutcome::kFailed, failure.text, {}});
  }
  for (const std::string& subject : report.subjects) {
    if (std::ranges::find(report.failures, subject, &fuzz::Failure::subject) ==
        report.failures.end()) {
      cases.push_back({group, subject, report::JUnitOutcome::kPassed, {}, {}});
    }
  }
  return cases;
}

}  // namespace gnomon::cli
