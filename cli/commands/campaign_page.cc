// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/campaign_page.h"

#include <memory>
#include <span>

#include "cli/commands/case_scene.h"
#include "fuzz/campaign/campaign_report.h"
#include "fuzz/findings/finding.h"
#include "fuzz/generate/generator.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

/// So many findings are shown as scenes.
constexpr std::size_t kMostScenes = 30;

void add_scene(Report& report, const std::string& name, const Scene& scene,
               const fuzz::Failure& failure) {
  const auto shown = std::make_shared<CaseScene>(scene, std::span(&failure, 1));
  if (!shown->is_shown()) return;
  report.documents.push_back(
      {"view-" + name, [shown](report::TextSink& sink) { shown->write_view(sink); }});
  if (!shown->has_result()) return;
  report.documents.push_back(
      {"result-" + name, [shown](report::TextSink& sink) { shown->write_result(sink); }});
}

/// By the place of a finding in the list: one case may fail in several ways.
void add_scenes(Report& report, const fuzz::CampaignOutcome& outcome) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < outcome.findings.size(); ++i) {
    const fuzz::CampaignFinding& found = outcome.findings[i];
    // What took down a process that made it cannot be made here.
    if (found.failure.subject == "generator") continue;
    if (++count > kMostScenes) break;
    const std::string name = std::to_string(i);
    if (const auto generator = fuzz::Generator::parse(found.generator)) {
      add_scene(report, name, generator->make(found.seed).scene, found.failure);
    }
    if (found.folder.empty()) continue;
    if (const auto shrunken = fuzz::read_finding(found.folder)) {
      add_scene(report, name + "-shrunken", shrunken->scene, found.failure);
    }
  }
  if (count > kMostScenes) {
    report.notes.push_back("Of " + report::grouped(outcome.findings.size()) +
                           " findings the first " + std::to_string(kMostScenes) +
                           " are shown as scenes.");
  }
}

report::JUnitCase junit_case_of(const fuzz::CampaignFinding& finding, bool counts) {
  using report::JUnitOutcome;
  return {"fuzz." + finding.signature, "case " + std::to_string(finding.case_index),
          counts ? JUnitOutcome::kFailed : JUnitOutcome::kSkipped,
          (counts ? "" : "it does not count: ") + finding.failure.text,
          fuzz::replay_command(finding)};
}

}  // namespace

Expected<void> write_campaign_page(const ReportOptions& options, const std::string& plan,
                                   const fuzz::CampaignOutcome& outcome, bool times,
                                   const std::function<bool(const fuzz::Failure&)>& counts) {
  Report report;
  report.command = "fuzz";
  report.cases.push_back({"fuzz", report::grouped(outcome.totals.cases) + " scenes", {}, {}, {}});
  for (const fuzz::CampaignFinding& finding : outcome.findings) {
    report.cases.push_back(junit_case_of(finding, counts(finding.failure)));
  }
  for (const std::string& kind : outcome.missing_kinds) {
    report.cases.push_back(
        {"fuzz.kinds", kind, report::JUnitOutcome::kFailed, "no scene was of this kind", {}});
  }
  const auto json = [&](report::TextSink& sink) {
    fuzz::write_campaign_json(sink, plan, outcome, times);
  };
  report.files = {
      {"table.txt", [&](report::TextSink& sink) { sink.write(fuzz::campaign_report(outcome)); }},
      {"campaign.json", json},
      {"findings.csv", [&](report::TextSink& sink) { sink.write(fuzz::campaign_csv(outcome)); }}};
  report.documents = {{"campaign", json}};
  if (outcome.interrupted) {
    report.notes.emplace_back("The campaign was interrupted: it has what was done.");
  }
  if (!options.directory.empty()) add_scenes(report, outcome);
  return write_report(options, report);
}

}  // namespace gnomon::cli
