// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/certify_corpus.h"

#include <algorithm>
#include <filesystem>

#include "cli/common/check_options.h"
#include "cli/common/exit_status.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "fuzz/corpus/corpus.h"
#include "fuzz/corpus/corpus_judge.h"
#include "scene/base/output_file.h"
#include "scene/base/text_file.h"

namespace gnomon::cli {

namespace {

Expected<std::vector<fuzz::Subject>> chosen_subjects(const CorpusCommandOptions& options) {
  std::vector<fuzz::Subject> subjects;
  for (const std::string& name : options.kernels) {
    // Mistakes are subjects of the fuzzer only: here such a name is no kernel's.
    if (name.find('~') != std::string::npos) {
      return tl::unexpected(parse_kernel_choice(name).error());
    }
    const auto subject = fuzz::parse_subject(name);
    if (!subject) return tl::unexpected(subject.error());
    if (std::ranges::find(subjects, *subject) == subjects.end()) subjects.push_back(*subject);
  }
  for (const std::string& command : options.commands) {
    subjects.emplace_back().command = command;
  }
  if (subjects.empty()) return fuzz::default_corpus_subjects();
  return subjects;
}

/// Writes every scene of the corpus anew, where that changes it.
int record_corpus(const CorpusCommandOptions& options) {
  const auto files = fuzz::scene_files(options.corpus);
  if (!files) return report_error(files.error());
  std::size_t changed = 0;
  for (const std::filesystem::path& file : *files) {
    if (interrupted()) return kInterruptedStatus;
    const auto text = fuzz::record_fixture(file);
    if (!text) return report_error(text.error());
    const auto before = read_file(file);
    if (before && *before == *text) continue;
    if (auto done = write_file(file, *text); !done) return report_error(done.error());
    ++changed;
  }
  const auto done = write_output(
      {}, std::to_string(files->size()) + " scenes, " + std::to_string(changed) + " changed\n");
  return done ? kDone : report_error(done.error());
}

/// What is recorded and not scored is skipped.
std::vector<report::JUnitCase> junit_cases_of(const fuzz::CorpusReport& report) {
  using report::JUnitOutcome;
  std::vector<report::JUnitCase> cases;
  for (std::size_t i = 0; i < report.judgements.size(); ++i) {
    const fuzz::Fixture& fixture = (*report.fixtures)[i];
    if (!report.oracle_findings[i].empty()) {
      cases.push_back(
          {"corpus.oracle", fixture.name, JUnitOutcome::kFailed, report.oracle_findings[i], {}});
    }
    for (std::size_t s = 0; s < report.subjects.size(); ++s) {
      const fuzz::Judgement& judgement = report.judgements[i][s];
      const bool scored =
          report.subjects[s].exact() || fixture.expectation != fuzz::Expectation::kInform;
      JUnitOutcome outcome = JUnitOutcome::kPassed;
      if (judgement.outcome == fuzz::Outcome::kNotAsked) {
        outcome = JUnitOutcome::kSkipped;
      } else if (judgement.outcome != fuzz::Outcome::kPass) {
        outcome = scored ? JUnitOutcome::kFailed : JUnitOutcome::kSkipped;
      }
      cases.push_back({"corpus." + report.names[s], fixture.name, outcome, judgement.why, {}});
    }
  }
  return cases;
}

Expected<void> report_corpus(const CorpusCommandOptions& options,
                             const fuzz::CorpusReport& judged) {
  Report report;
  report.command = "certify";
  report.scene = options.corpus;
  report.cases = junit_cases_of(judged);
  const auto json = [&](report::TextSink& sink) { fuzz::write_corpus_json(sink, judged); };
  report.files = {
      {"table.txt",
       [&](report::TextSink& sink) { sink.write(fuzz::corpus_text(judged, options.by_scene)); }},
      {"corpus.json", json},
      {"corpus.csv", [&](report::TextSink& sink) { sink.write(fuzz::corpus_csv(judged)); }}};
  report.documents = {{"corpus", json}};
  return write_report(options.report, report);
}

}  // namespace

int run_certify_corpus(const CorpusCommandOptions& options) {
  const ThreadLimit threads(options.jobs);
  if (options.record) return record_corpus(options);
  const auto fixtures = fuzz::read_corpus(options.corpus);
  if (!fixtures) return report_error(fixtures.error());
  const auto subjects = chosen_subjects(options);
  if (!subjects) return report_error(subjects.error());

  ProgressBar progress("corpus");
  fuzz::CorpusOptions judging;
  judging.subjects = *subjects;
  judging.tolerance = options.tolerance;
  judging.seconds = options.seconds;
  judging.megabytes = options.megabytes;
  // In this process where the system does not tell which program this is.
  if (!options.in_process) judging.program = own_program().value_or("");
  judging.progress = progress.callback();
  judging.interrupted = &interrupted();
  const auto report = fuzz::judge_corpus(*fixtures, judging);
  progress.clear();
  if (!report) return report_error(report.error());

  if (options.json != "-") {
    const std::string text = fuzz::corpus_text(*report, options.by_scene);
    if (auto done = write_output({}, text); !done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    fuzz::write_corpus_json(*output, *report);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  if (options.report.asked()) {
    if (auto done = report_corpus(options, *report); !done) return report_error(done.error());
  }
  if (report->disagree()) return kDisagree;
  return report->failures(false) > 0 ? kFailed : kDone;
}

}  // namespace gnomon::cli
