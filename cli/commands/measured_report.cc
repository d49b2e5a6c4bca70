// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/measured_report.h"

#include <algorithm>
#include <utility>

#include "comparison/extremes.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

report::JUnitCase junit_case_of(const comparison::Row& row, const std::string& command) {
  using report::JUnitOutcome;
  const comparison::RunRequest& request = row.request;
  report::JUnitCase one;
  one.group = command + '.' + request.scene;
  if (request.size) one.group += '.' + std::to_string(*request.size);
  one.name = request.kernel + '/' + request.system;
  if (request.lights == comparison::LightsAsked::kArea) one.name += ", area lights";
  if (request.thickness) one.name += ", thickness " + report::shortest(*request.thickness);
  if (!request.change.empty()) one.name += ", " + request.change;
  const std::string failure = comparison::failure_of(row);
  if (failure.empty()) return one;
  // Where it counts, it is a contradiction, which is a case of its own.
  one.outcome = JUnitOutcome::kSkipped;
  one.message = "it does not count: " + failure;
  one.text = row.measurement.why.empty() ? row.command : row.measurement.why + "; " + row.command;
  return one;
}

/// The scenes in words, for a title.
std::string scene_names(const std::vector<const comparison::Row*>& rows) {
  std::vector<std::string> names;
  for (const comparison::Row* row : rows) {
    // Of a file its name is enough here.
    const std::string& scene = row->request.scene;
    std::string name = scene.substr(scene.rfind('/') + 1);
    if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
  }
  constexpr std::size_t kMost = 3;
  if (names.size() > kMost) return std::to_string(names.size()) + " scenes";
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

Expected<void> write_measured_report(const ReportOptions& options, const MeasuredRows& measured) {
  Report report;
  report.command = measured.command;
  report.scene = measured.title.empty() ? scene_names(measured.rows) : measured.title;
  for (const comparison::Row* row : measured.rows) {
    report.cases.push_back(junit_case_of(*row, measured.command));
  }
  for (const std::string& contradiction : measured.contradictions) {
    report.cases.push_back({measured.command,
                            "contradiction",
                            report::JUnitOutcome::kFailed,
                            "a bug of ours: " + contradiction,
                            {}});
  }
  report.files = {{"table.txt", [&](report::TextSink& sink) { sink.write(measured.text()); }},
                  {"rows.json", measured.json},
                  {"rows.csv", [&](report::TextSink& sink) { sink.write(measured.csv()); }}};
  if (measured.plot) report.files.push_back({"plot.svg", measured.plot});
  report.documents = {{measured.document, measured.json}};
  if (measured.interrupted) {
    report.notes.emplace_back("The run was interrupted: what was not reached is missing.");
  }
  return write_report(options, report);
}

}  // namespace gnomon::cli
