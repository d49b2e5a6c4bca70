// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon fuzz: campaigns of scenes made by rule, on any kernel or foreign program.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

#include "cli/commands/campaign_findings.h"
#include "cli/commands/campaign_page.h"
#include "cli/common/check_options.h"
#include "cli/common/commands.h"
#include "cli/common/failures.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "fuzz/campaign/campaign.h"
#include "fuzz/campaign/campaign_report.h"
#include "fuzz/generate/generator.h"
#include "fuzz/zoo/zoo.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

using report::grouped;

constexpr std::uint64_t kStandardCount = 1000;

struct FuzzOptions {
  CheckCommandOptions check;
  std::vector<std::string> generators;
  std::uint64_t seed = 1, keep = 3;
  std::optional<std::uint64_t> count;
  std::string time, database, shard, json;
  std::vector<std::string> merge, fail_on;
  unsigned jobs = 0;
  bool every_kernel = false, zoo = false, times = false;
  std::string findings;
  ReportOptions report;
};

/// Hours, minutes and seconds.
std::string clock_text(double seconds) {
  const auto whole = static_cast<std::uint64_t>(seconds);
  char text[32];
  std::snprintf(text, sizeof text, "%lu:%02lu:%02lu", static_cast<unsigned long>(whole / 3600),
                static_cast<unsigned long>(whole / 60 % 60),
                static_cast<unsigned long>(whole % 60));
  return text;
}

std::string progress_text(const fuzz::CampaignProgress& progress) {
  std::string line = "fuzz " + grouped(progress.done);
  if (progress.wanted > 0) line += " of " + grouped(progress.wanted);
  line += " scenes, " + grouped(static_cast<std::uint64_t>(progress.cases_per_second)) + "/s";
  if (progress.wanted > progress.done && progress.cases_per_second > 0) {
    const double left = static_cast<double>(progress.wanted - progress.done);
    line += ", " + clock_text(left / progress.cases_per_second) + " left";
  }
  return line + ", " + grouped(progress.failing) + " failing, " + grouped(progress.signatures) +
         (progress.signatures == 1 ? " kind of failure" : " kinds of failure");
}

/// "K/N", shard K of N, from 0.
Expected<fuzz::Shard> parse_shard(const std::string& text) {
  fuzz::Shard shard;
  if (text.empty()) return shard;
  int used = 0;
  unsigned long index = 0, count = 0;
  if (std::sscanf(text.c_str(), "%lu/%lu%n", &index, &count, &used) != 2 ||
      static_cast<std::size_t>(used) != text.size() || count == 0 || index >= count) {
    return fail(ErrorCode::kUsage, "--shard " + text, "K/N with 0 <= K < N, such as 0/4");
  }
  shard.index = index;
  shard.count = count;
  return shard;
}

bool asked_to_fail(const fuzz::Failure& failure, const std::vector<std::string>& fail_on) {
  return std::ranges::any_of(fail_on, [&](const std::string& what) {
    return what == "any" || what == failure.subject || what == fuzz::id_of(failure.property) ||
           what == failure.disagreement || what == failure.cause ||
           what == failure.short_signature() || what == failure.signature();
  });
}

int status_of_campaign(const fuzz::CampaignOutcome& outcome, const FuzzOptions& options) {
  if (outcome.interrupted) return kInterruptedStatus;
  bool ours = false, asked = !outcome.missing_kinds.empty();
  for (const fuzz::CampaignFinding& finding : outcome.findings) {
    ours = ours || is_ours(finding.failure);
    asked = asked || asked_to_fail(finding.failure, options.fail_on);
  }
  return ours ? kDisagree : asked ? kFailed : kDone;
}

/// A failure that the exit status tells of.
bool counts(const fuzz::Failure& failure, const FuzzOptions& options) {
  return is_ours(failure) || asked_to_fail(failure, options.fail_on);
}

int finish(const FuzzOptions& options, const std::string& plan,
           const fuzz::CampaignOutcome& outcome) {
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    fuzz::write_campaign_json(*output, plan, outcome, options.times);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  if (options.json != "-") {
    std::string text = fuzz::campaign_report(outcome);
    if (outcome.interrupted) {
      text += options.database.empty() ? "interrupted; without --db what was done is lost\n"
                                       : "interrupted; the same command goes on from here\n";
    }
    const auto written = write_output({}, text);
    if (!written) return report_error(written.error());
  }
  if (options.report.asked()) {
    const auto done =
        write_campaign_page(options.report, plan, outcome, options.times,
                            [&](const fuzz::Failure& failure) { return counts(failure, options); });
    if (!done) return report_error(done.error());
  }
  return status_of_campaign(outcome, options);
}

int run_merge(const FuzzOptions& options) {
  if (options.database.empty()) return report_usage("--merge without --db", "--db FILE");
  const auto outcome = fuzz::merge_campaigns(options.database, options.merge);
  if (!outcome) return report_error(outcome.error());
  const auto plan = fuzz::campaign_text(options.database);
  if (!plan) return report_error(plan.error());
  return finish(options, *plan, *outcome);
}

/// Every mistake of the zoo hunted with several seeds. One that is not found is a hole in the
/// oracle.
int run_zoo(const FuzzOptions& options) {
  constexpr std::uint64_t kHunts = 5, kMostScenes = 3000;
  const ThreadLimit threads(1);
  ProgressLine line;
  std::vector<fuzz::ZooTally> tallies;
  bool all_found = true;
  for (const fuzz::ZooEntry& entry : fuzz::zoo()) {
    if (interrupted()) break;
    line.say("hunting " + entry.mutant() + " in " + std::string(entry.generator));
    const auto tally = fuzz::hunt_often(entry, options.count.value_or(kHunts), kMostScenes);
    if (!tally) return report_error(tally.error());
    all_found = all_found && tally->found == tally->hunts;
    tallies.push_back(*tally);
  }
  const auto written = write_output({}, fuzz::zoo_table(tallies));
  if (!written) return report_error(written.error());
  return interrupted() ? kInterruptedStatus : all_found ? kDone : kDisagree;
}

int run_fuzz(const FuzzOptions& options) {
  if (options.zoo) return run_zoo(options);
  if (!options.merge.empty()) return run_merge(options);
  auto worker = worker_options(options.check, fuzz::exact_subjects());
  if (!worker) return report_error(worker.error());
  worker->generators = options.generators;
  if (worker->generators.empty()) worker->generators = {"mix", "area-mix"};
  const bool standard = options.check.kernels.empty() && options.check.commands.empty();
  worker->in_turn = standard && !options.every_kernel;
  const auto shard = parse_shard(options.shard);
  if (!shard) return report_error(shard.error());
  auto program = own_program();
  if (!program) return report_error(program.error());

  fuzz::CampaignPlan plan;
  plan.seed = options.seed;
  plan.worker = std::move(*worker);
  ProgressLine line;
  fuzz::CampaignRun run;
  run.program = std::move(*program);
  run.database = options.database;
  run.count = options.count;
  if (!options.time.empty()) run.seconds = duration_seconds(options.time);
  if (!run.count && !run.seconds) run.count = kStandardCount;
  run.jobs = options.jobs != 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
  run.shard = *shard;
  run.keep = options.keep;
  run.progress = [&](const fuzz::CampaignProgress& progress) {
    line.show(progress_text(progress));
  };
  run.found = [&](const fuzz::CampaignFinding& finding) {
    line.say("found " + finding.signature + " in case " + std::to_string(finding.case_index) +
             " (" + finding.recipe + "): " + finding.failure.text);
  };
  run.interrupted = &interrupted();
  auto outcome = fuzz::run_campaign(plan, run);
  line.clear();
  if (!outcome) return report_error(outcome.error());
  if (!options.findings.empty() && !outcome->interrupted) {
    FindingsOptions findings;
    findings.folder = options.findings;
    findings.program = run.program;
    findings.database = options.database;
    findings.say = [&](const std::string& text) { line.say(text); };
    findings.progress = [&](const std::string& text) { line.show(text); };
    const auto written = write_campaign_findings(plan, *outcome, findings);
    line.clear();
    if (!written && written.error().code != ErrorCode::kInterrupted) {
      return report_error(written.error());
    }
    outcome->interrupted = !written;
  }
  return finish(options, plan.text(), *outcome);
}

}  // namespace

void add_fuzz_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<FuzzOptions>();
  CLI::App& command = *app.add_subcommand(
      "fuzz", "Campaigns: many small hard scenes on any kernel or foreign program");
  command.footer(
      "Without --kernel: plane on every scene, and one more exact kernel or algorithm in turn.\n"
      "Examples:\n"
      "  gnomon fuzz --count 1000000 --db night.db       exact kernels against the oracle\n"
      "  gnomon fuzz --kernel double+identity --time 5m --fail-on oracle\n"
      "  gnomon fuzz --candidate-command './solver --json' --generator mix");
  repeatable(command.add_option("--generator", options->generators,
                                "Where scenes come from (repeatable): BASE[+MOVE...], such as mix, "
                                "area-mix,\nsoup-lattice+duplicate or file:room.obj+any"))
      ->type_name("G");
  command.add_option("--seed", options->seed, "Of the campaign: equal seeds make equal scenes")
      ->type_name("S")
      ->capture_default_str();
  command
      .add_option("--count", options->count,
                  "Scenes of the whole campaign, those done before included; 1000 if no --time")
      ->type_name("N");
  command.add_option("--time", options->time, "Stop after that long: 90, 90s, 5m, 2h")
      ->check(duration())
      ->type_name("T");
  command
      .add_option("--db", options->database,
                  "Remember the campaign here, and go on with the one that is here")
      ->type_name("FILE");
  command.add_option("--shard", options->shard, "Only this share of the scenes, such as 0/4")
      ->type_name("K/N");
  repeatable(command.add_option("--merge", options->merge,
                                "Add this shard's database to --db, and run nothing (repeatable)"))
      ->type_name("FILE");
  repeatable(command.add_option("--fail-on", options->fail_on,
                                "Exit with 1 if this fails (repeatable): a subject, a property, a "
                                "class, or any"))
      ->type_name("K");
  command.add_option("--keep", options->keep, "Findings kept of each kind of failure")
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--findings", options->findings,
                  "Shrink what is kept, and write each as a folder below DIR")
      ->type_name("DIR");
  command.add_flag("--every-kernel", options->every_kernel,
                   "Without --kernel: all exact kernels and algorithms on every scene");
  command.add_flag(
      "--zoo", options->zoo,
      "Hunt every mistake of the bug zoo instead, --count times (5), and print how many "
      "scenes it took");
  add_check_options(command, options->check);
  add_jobs_option(command, options->jobs);
  command.add_option("--json", options->json, "Write the campaign's figures; - is standard output")
      ->type_name("FILE");
  command.add_flag("--times", options->times, "Times in --json");
  add_report_options(command, options->report);
  command.callback([options, &action] { action = [options] { return run_fuzz(*options); }; });
}

}  // namespace gnomon::cli
