// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon replay: one case again, and only that one: a scene's file, a finding's folder, or the seed
// that a campaign printed.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "cli/commands/case_scene.h"
#include "cli/common/check_options.h"
#include "cli/common/commands.h"
#include "cli/common/failures.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/report_output.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/findings/finding.h"
#include "fuzz/generate/generator.h"
#include "fuzz/workers/isolated.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "report/text/table.h"

namespace gnomon::cli {

namespace {

struct ReplayOptions {
  CheckCommandOptions check;
  std::string what, generator, output;
  std::optional<std::uint64_t> case_index, case_seed;
  std::uint64_t relation_seed = 1;
  ReportOptions report;
};

/// A scene to check, and under which seed.
struct ReplayedCase {
  Scene scene;
  std::uint64_t seed = 1;
  std::string name;                         // for the first line
  std::optional<fuzz::CheckOptions> check;  // of a finding: what it failed under
};

/// The scene of a case that a database kept.
Expected<ReplayedCase> case_of_campaign(const ReplayOptions& options) {
  const auto campaign = fuzz::read_campaign(options.what);
  if (!campaign) return tl::unexpected(campaign.error());
  std::string kept;
  for (const fuzz::CampaignFinding& finding : campaign->findings) {
    if (options.case_index == finding.case_index) {
      const auto generator = fuzz::Generator::parse(finding.generator);
      if (!generator) return tl::unexpected(generator.error());
      fuzz::MadeScene made = generator->make(finding.seed);
      return ReplayedCase{std::move(made.scene), finding.seed, made.recipe, {}};
    }
    kept += (kept.empty() ? "" : ", ") + std::to_string(finding.case_index);
  }
  return fail(ErrorCode::kUsage,
              options.case_index
                  ? options.what + " keeps no case " + std::to_string(*options.case_index)
                  : options.what + " is a campaign: which of its cases?",
              "--case with one of: " + (kept.empty() ? "none (nothing failed)" : kept));
}

Expected<ReplayedCase> chosen_case(const ReplayOptions& options) {
  if (options.case_seed) {
    if (!options.what.empty()) {
      return fail(ErrorCode::kUsage, "--seed and " + options.what, "one of them");
    }
    const auto generator = fuzz::Generator::parse(options.generator);
    if (!generator) return tl::unexpected(generator.error());
    fuzz::MadeScene made = generator->make(*options.case_seed);
    return ReplayedCase{std::move(made.scene), *options.case_seed, made.recipe, {}};
  }
  if (options.what.empty()) {
    return fail(ErrorCode::kUsage, "nothing to replay",
                "a scene, a finding's folder, a campaign's database with --case, or --seed with "
                "--generator");
  }
  if (std::filesystem::is_directory(options.what)) {
    auto finding = fuzz::read_finding(options.what);
    if (!finding) return tl::unexpected(finding.error());
    const std::uint64_t seed = finding->check.seed;
    return ReplayedCase{std::move(finding->scene), seed, options.what, std::move(finding->check)};
  }
  if (fuzz::is_campaign(options.what)) return case_of_campaign(options);
  auto read = read_scene(options.what);
  if (!read) return tl::unexpected(read.error());
  for (const std::string& warning : read->warnings) warn(options.what + ": " + warning);
  return ReplayedCase{std::move(read->scene), options.relation_seed, options.what, {}};
}

Expected<void> report_case(const ReplayOptions& options, const ReplayedCase& replayed,
                           const fuzz::CaseReport& found) {
  Report report;
  report.command = "replay";
  report.scene = replayed.name;
  report.cases = junit_cases_of("replay." + replayed.name, found);
  const auto json = [&](report::TextSink& sink) { write_case_json(sink, replayed.name, found); };
  report.files = {
      {"table.txt", [&](report::TextSink& sink) { sink.write(case_text(replayed.name, found)); }},
      {"case.json", json},
      {"failures.csv", [&](report::TextSink& sink) { sink.write(case_csv(found)); }}};
  report.documents = {{"case", json}};
  const CaseScene scene(replayed.scene, found.failures);
  if (scene.is_shown()) {
    report.documents.push_back({"view", [&](report::TextSink& sink) { scene.write_view(sink); }});
  }
  if (scene.has_result()) {
    report.documents.push_back(
        {"result", [&](report::TextSink& sink) { scene.write_result(sink); }});
  }
  return write_report(options.report, report);
}

int run_replay(const ReplayOptions& options) {
  auto worker = worker_options(options.check, all_subjects());
  if (!worker) return report_error(worker.error());
  auto chosen = chosen_case(options);
  if (!chosen) return report_error(chosen.error());
  if (!options.output.empty()) {
    const auto written = write_scene(chosen->scene, options.output, SceneFormat::kJson);
    if (!written) return report_error(written.error());
  }
  auto program = own_program();
  if (!program) return report_error(program.error());
  if (chosen->check && options.check.kernels.empty() && options.check.commands.empty()) {
    // As it was found; only what was asked for is otherwise.
    fuzz::CheckOptions own = std::move(*chosen->check);
    if (!options.check.properties.empty()) own.properties = worker->check.properties;
    worker->check = std::move(own);
  }
  worker->check.seed = chosen->seed;
  fuzz::IsolatedChecker checker(std::move(*program), worker->check, worker->limits);
  const auto report = checker.check(chosen->scene, &interrupted());
  if (!report) return report_error(report.error());
  const auto written = write_output({}, case_text(chosen->name, *report));
  if (!written) return report_error(written.error());
  if (options.report.asked()) {
    if (auto done = report_case(options, *chosen, *report); !done) {
      return report_error(done.error());
    }
  }
  return status_of_failures(report->failures);
}

}  // namespace

void add_replay_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App& command =
      *app.add_subcommand("replay", "One case of a campaign again: what fails, on which kernels");
  command.footer(
      "Without --kernel: all kernels. Exit status 1 if a rounded kernel or a foreign program "
      "fails, "
      "4 if\nan exact kernel does.\n"
      "Examples:\n"
      "  gnomon replay night.db --case 4711\n"
      "  gnomon replay --generator mix --seed 1234567890 -o case.json\n"
      "  gnomon replay hard.json --kernel double+identity");
  command
      .add_option("CASE", options->what, "A scene, a finding's folder, or a campaign's database")
      ->type_name("PATH");
  command.add_option("--case", options->case_index, "Of a database: which case")->type_name("N");
  auto* seed =
      command.add_option("--seed", options->case_seed, "The seed of a case")->type_name("S");
  command.add_option("--generator", options->generator, "What makes its scene")
      ->needs(seed)
      ->type_name("G");
  seed->needs(command.get_option("--generator"));
  command
      .add_option("--relation-seed", options->relation_seed,
                  "Of a scene: which metamorphic relation is tried, and how")
      ->type_name("S")
      ->capture_default_str();
  command.add_option("-o,--output", options->output, "Also write the scene")->type_name("FILE");
  add_check_options(command, options->check);
  add_report_options(command, options->report);
  command.callback([options, &action] { action = [options] { return run_replay(*options); }; });
}

}  // namespace gnomon::cli
