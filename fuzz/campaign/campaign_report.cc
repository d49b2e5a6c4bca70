// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/campaign/campaign_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "fuzz/check/subject.h"
#include "report/json/json_writer.h"
#include "report/text/csv_field.h"
#include "report/text/number_text.h"
#include "report/text/shell_word.h"
#include "report/text/table.h"

namespace gnomon::fuzz {

namespace {

using report::Align;
using report::grouped;
using report::TextTable;
using report::wrapped;

struct NamedCount {
  std::string name;
  std::uint64_t n = 0;
};

/// The counts whose names begin so, without the beginning; by name.
std::vector<NamedCount> counts_of(const CampaignTotals& totals, std::string_view prefix) {
  std::vector<NamedCount> counts;
  for (const auto& [name, n] : totals.counts) {
    if (name.starts_with(prefix)) counts.push_back({name.substr(prefix.size()), n});
  }
  return counts;
}

std::string digest_text(const CampaignTotals& totals) {
  return fmt::format("{:016x}", totals.digest);
}

std::string listed(const std::vector<NamedCount>& counts) {
  std::string text;
  for (const auto& [name, n] : counts) text += (text.empty() ? "" : ", ") + name + ' ' + grouped(n);
  return text.empty() ? "none" : text;
}

/// Two columns of kinds beside each other.
std::string kinds_table(const std::vector<NamedCount>& kinds, std::uint64_t cases) {
  TextTable table({{"kind", Align::kLeft},
                   {"scenes", Align::kRight},
                   {"share", Align::kRight},
                   {"  kind", Align::kLeft},
                   {"scenes", Align::kRight},
                   {"share", Align::kRight}});
  const std::size_t rows = (kinds.size() + 1) / 2;
  const auto cells = [&](std::size_t i) -> std::vector<std::string> {
    if (i >= kinds.size()) return {"", "", ""};
    const double share = static_cast<double>(kinds[i].n) / static_cast<double>(cases);
    return {kinds[i].name, grouped(kinds[i].n), report::percent(share)};
  };
  for (std::size_t i = 0; i < rows; ++i) {
    std::vector<std::string> row = cells(i);
    for (std::string& cell : cells(i + rows)) row.push_back(std::move(cell));
    if (!row[3].empty()) row[3].insert(0, "  ");
    table.add_row(std::move(row));
  }
  return table.to_string();
}

}  // namespace

std::string campaign_report(const CampaignOutcome& outcome) {
  constexpr std::size_t kWidth = TextTable::kWidth;
  const CampaignTotals& totals = outcome.totals;
  const double cases = std::max(1.0, static_cast<double>(totals.cases));
  std::string text;
  text += wrapped(
      fmt::format("{} scenes ({} with point or directional lights, {} with area lights; on average "
                  "{:.1f} polygons), answers {}",
                  grouped(totals.cases), grouped(totals.count("cases with point lights")),
                  grouped(totals.count("cases with area lights")),
                  static_cast<double>(totals.count("polygons")) / cases, digest_text(totals)),
      kWidth, 0, 2);
  text += wrapped("generators: " + listed(counts_of(totals, "generator:")), kWidth, 0, 2);
  text += wrapped("checked: " + listed(counts_of(totals, "subject:")), kWidth, 0, 2);
  text += wrapped(
      "results whose claims were checked one by one: " + grouped(totals.count("claims checked")),
      kWidth, 0, 2);
  const std::vector<NamedCount> kinds = counts_of(totals, "kind:");
  if (!kinds.empty()) text += '\n' + kinds_table(kinds, std::max<std::uint64_t>(1, totals.cases));
  std::vector<NamedCount> failures = counts_of(totals, "failure:");
  text += '\n';
  if (failures.empty()) {
    text += "every property held\n";
  } else {
    std::ranges::stable_sort(failures, std::ranges::greater{}, &NamedCount::n);
    TextTable table({{"failure", Align::kLeft},
                     {"scenes", Align::kRight},
                     {"first", Align::kRight},
                     {"found in", Align::kLeft}});
    for (const auto& [signature, n] : failures) {
      const auto first =
          std::ranges::find(outcome.findings, signature, &CampaignFinding::signature);
      const bool kept = first != outcome.findings.end();
      table.add_row({signature, grouped(n), kept ? grouped(first->case_index) : "",
                     kept ? (first->folder.empty() ? first->recipe : first->folder) : ""});
    }
    text += table.to_string();
  }
  for (const std::string& kind : outcome.missing_kinds) {
    text += "missing: no scene was of the kind " + kind + "\n";
  }
  return text;
}

std::string campaign_csv(const CampaignOutcome& outcome) {
  std::string text;
  report::append_csv_line(text, {"signature", "scenes", "case", "seed", "generator", "recipe",
                                 "light", "polygon", "text", "folder", "replay"});
  for (const CampaignFinding& finding : outcome.findings) {
    report::append_csv_line(
        text,
        {finding.signature, std::to_string(outcome.totals.count("failure:" + finding.signature)),
         std::to_string(finding.case_index), std::to_string(finding.seed), finding.generator,
         finding.recipe, finding.failure.light, finding.failure.polygon, finding.failure.text,
         finding.folder, replay_command(finding)});
  }
  return text;
}

std::string replay_command(const CampaignFinding& finding) {
  if (!finding.folder.empty()) return "gnomon replay " + report::shell_word(finding.folder);
  std::string text = "gnomon replay --generator " + report::shell_word(finding.generator) +
                     " --seed " + std::to_string(finding.seed);
  const auto subject = parse_subject(finding.failure.subject);
  if (!subject) return text;
  return text + (subject->foreign() ? " --candidate-command " + report::shell_word(subject->command)
                                    : " --kernel " + report::shell_word(finding.failure.subject));
}

void write_campaign_json(report::TextSink& sink, const std::string& plan,
                         const CampaignOutcome& outcome, bool times) {
  using report::JsonLayout;
  report::JsonWriter json(sink);
  const CampaignTotals& totals = outcome.totals;
  json.begin_object();
  json.member("format", "gnomon-campaign");
  json.member("version", 1);
  json.member("plan", plan);
  json.member("cases", totals.cases);
  json.member("failing_cases", totals.failing_cases);
  json.member("answers", digest_text(totals));
  if (outcome.interrupted) json.member("interrupted", true);
  if (times) json.member("seconds", totals.seconds);
  json.key("counts");
  json.begin_object();
  for (const auto& [name, n] : totals.counts) json.member(name, n);
  json.end_object();
  json.key("missing_kinds");
  json.begin_array(JsonLayout::kInline);
  for (const std::string& kind : outcome.missing_kinds) json.value(kind);
  json.end_array();
  json.key("findings");
  json.begin_array();
  for (const CampaignFinding& finding : outcome.findings) {
    json.begin_object(JsonLayout::kInline);
    json.member("signature", finding.signature);
    json.member("case", finding.case_index);
    json.member("seed", std::to_string(finding.seed));  // beyond what a JSON number holds
    json.member("generator", finding.generator);
    json.member("recipe", finding.recipe);
    json.member("light", finding.failure.light);
    json.member("polygon", finding.failure.polygon);
    json.member("text", finding.failure.text);
    json.member("folder", finding.folder);
    json.member("replay", replay_command(finding));
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.finish();
}

}  // namespace gnomon::fuzz
