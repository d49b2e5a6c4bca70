// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/certify_samples.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/common/commands.h"
#include "cli/common/exit_status.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "comparison/samples/sample_file.h"
#include "comparison/samples/sample_tally.h"
#include "comparison/samples/sample_verdict.h"
#include "gnomon/oracle/sample_judge.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/scene/digest.h"

namespace gnomon::cli {

namespace {

using comparison::SampleFile;
using comparison::SampleRow;
using comparison::SampleVerdict;

/// Samples that are read before they are judged, on all threads.
constexpr std::size_t kBlock = 8192;

double width_of(const SampleCommandOptions& options, double diagonal) {
  return options.strict ? 0 : options.width.value_or(1e-9 * diagonal);
}

/// A file of samples that is being judged.
class SampleRun {
 public:
  SampleRun(const SampleCommandOptions& options, const LoadedScene& loaded, std::string file)
      : options_(options),
        loaded_(loaded),
        file_(std::move(file)),
        diagonal_(oracle::scene_diagonal(loaded.prepared)),
        asked_(loaded.prepared.lights.size()),
        progress_("reading " + file_) {
    for (const std::uint32_t light : loaded.lights) asked_[light] = true;
  }

  /// Errors: those of reading; an interruption is none once samples were judged.
  Expected<SampleVerdict> run();

 private:
  Expected<void> look_through(SampleFile& file);
  Expected<void> judge(SampleFile& file);
  /// False at the end of the file. Errors: those of reading.
  Expected<bool> read_block(SampleFile& file);
  void judge_block(const oracle::SampleJudge& judge);
  double allowed(const comparison::WrittenNumber& number) const;
  void explain(const oracle::SampleJudge& judge);

  const SampleCommandOptions& options_;
  const LoadedScene& loaded_;
  std::string file_;
  double diagonal_;
  std::vector<bool> asked_;  // of lights
  ProgressBar progress_;
  comparison::WrittenDigits digits_;  // of shares of area lights
  SampleVerdict verdict_;
  std::optional<comparison::SampleTally> tally_;
  std::vector<SampleRow> rows_;
  std::vector<std::optional<oracle::JudgedSample>> judged_;
};

/// Once through the file before anything is judged: what is wrong with it is told at once, and only
/// all of its numbers tell how many digits were meant.
Expected<void> SampleRun::look_through(SampleFile& file) {
  SampleRow row;
  for (std::uint64_t count = 0;; ++count) {
    if (count % kBlock == 0) {
      if (interrupted()) return fail(ErrorCode::kInterrupted, "interrupted");
      progress_.show(file.done());
    }
    auto more = file.next(row);
    if (!more) return tl::unexpected(std::move(more.error()));
    if (!*more) {
      if (count > 0) return {};
      return file.wrong_at_end("a file without samples", "a row a sample");
    }
    if (!asked_[row.sample.light]) {
      ++verdict_.left_out;
      continue;
    }
    ++verdict_.samples;
    if (loaded_.prepared.lights[row.sample.light].has_area()) digits_.add(row.visible);
  }
}

double SampleRun::allowed(const comparison::WrittenNumber& number) const {
  if (options_.strict) return 0;
  if (options_.tolerance) return *options_.tolerance;
  const double doubles = digits_.are_doubles() ? comparison::kRoundingOfDoubles : 0;
  // Nothing but 0 and 1: none and all of the light. Among others they are as precise as those.
  constexpr std::int32_t kNineDecimals = 9;
  const std::int32_t most = digits_.most_decimals();
  if (!number.has_exponent && (number.value == 0 || number.value == 1)) {
    return 0.5 * std::pow(10.0, -(most == 0 ? kNineDecimals : most)) + doubles;
  }
  return digits_.rounding_of(number) + doubles;
}

Expected<bool> SampleRun::read_block(SampleFile& file) {
  rows_.clear();
  while (rows_.size() < kBlock) {
    SampleRow row;
    auto more = file.next(row);
    if (!more || !*more) return more;
    if (!asked_[row.sample.light]) continue;
    row.sample.allowed = allowed(row.visible);
    rows_.push_back(std::move(row));
  }
  return true;
}

void SampleRun::judge_block(const oracle::SampleJudge& judge) {
  judged_.assign(rows_.size(), std::nullopt);
  tbb::parallel_for(std::size_t{0}, rows_.size(), [&](std::size_t i) {
    if (!interrupted()) judged_[i] = judge.judge(rows_[i].sample);
  });
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (judged_[i]) tally_->add(rows_[i], *judged_[i]);
  }
}

Expected<void> SampleRun::judge(SampleFile& file) {
  // So that what is made for a light, of every part, does not fill the memory where there are
  // thousands of suns.
  constexpr std::size_t kMostMade = 5'000'000;
  const std::size_t parts = loaded_.prepared.parts.size();
  const bool forgets = parts * loaded_.lights.size() > kMostMade;
  oracle::SampleJudge judge(loaded_.prepared,
                            {.width = width_of(options_, diagonal_),
                             .clearance = options_.strict ? 0 : options_.clearance});
  tally_.emplace(loaded_.scene, diagonal_, options_.misses);
  progress_.set_label("judging " + file_);
  for (bool more = true; more && !interrupted();) {
    auto read = read_block(file);
    if (!read) return tl::unexpected(std::move(read.error()));
    more = *read;
    judge_block(judge);
    progress_.show(file.done());
    if (forgets) judge.forget_lights();
  }
  tally_->tell(verdict_);
  verdict_.interrupted = verdict_.judged() < verdict_.samples;
  explain(judge);
  return {};
}

void SampleRun::explain(const oracle::SampleJudge& judge) {
  tbb::parallel_for(std::size_t{0}, verdict_.misses.size(), [&](std::size_t i) {
    comparison::SampleMiss& miss = verdict_.misses[i];
    if (!interrupted()) miss.cause = judge.cause(miss.row.sample, miss.judged);
  });
}

Expected<SampleVerdict> SampleRun::run() {
  auto file = SampleFile::open(file_, loaded_.scene, loaded_.prepared);
  if (!file) return tl::unexpected(std::move(file.error()));
  verdict_.file = file_ == "-" ? "<stdin>" : file_;
  verdict_.geometry_digest = geometry_digest(loaded_.scene);
  verdict_.scene = loaded_.scene.name.empty() ? loaded_.scene.file : loaded_.scene.name;
  verdict_.polygons = loaded_.scene.polygons.size();
  verdict_.parts = loaded_.prepared.parts.size();
  verdict_.numbers = loaded_.scene.numbers;
  verdict_.width = width_of(options_, diagonal_);
  verdict_.clearance = options_.strict ? 0 : options_.clearance;
  verdict_.tolerance = options_.strict ? 0 : options_.tolerance;
  verdict_.passed_over = file->passed_over();
  verdict_.has_area_lights = std::ranges::any_of(loaded_.lights, [&](std::uint32_t light) {
    return loaded_.prepared.lights[light].has_area();
  });
  if (auto done = look_through(*file); !done) return tl::unexpected(std::move(done.error()));
  if (verdict_.samples == 0) {
    return fail(ErrorCode::kUsage, file_ + ": no sample of the lights that were asked for",
                "--light of one that it has");
  }
  verdict_.decimals = digits_.most_decimals();
  verdict_.doubles = digits_.are_doubles();
  if (auto done = file->rewind(); !done) return tl::unexpected(std::move(done.error()));
  if (auto done = judge(*file); !done) return tl::unexpected(std::move(done.error()));
  progress_.clear();
  return std::move(verdict_);
}

int status_of_samples(const std::vector<SampleVerdict>& verdicts) {
  if (std::ranges::any_of(verdicts, &SampleVerdict::interrupted)) return kInterruptedStatus;
  return std::ranges::any_of(verdicts, &SampleVerdict::failed) ? kFailed : kDone;
}

}  // namespace

void SampleOptionRules::add(CLI::App& command, std::vector<std::string>& files,
                            std::size_t& misses) {
  const std::vector<std::string> common = {"--help",      "--help-all", "SCENE",     "--candidate",
                                           "--tolerance", "--width",    "--strict",  "--clearance",
                                           "--json",      "--jobs",     "--numbers", "--two-sided",
                                           "--skip-bad",  "--lod",      "--subset",  "--light",
                                           "--lights",    "--point",    "--sun",     "--area"};
  for (const CLI::Option* other : command.get_options()) {
    const bool is_common = std::ranges::any_of(
        common, [&](const std::string& name) { return other->check_name(name); });
    if (!is_common) excluded_.push_back(other);
  }
  repeatable(command.add_option("--samples", files,
                                "Judge points of any program with what was seen there: CSV\n"
                                "light,x,y,z,visible[,polygon]; - is standard input (repeatable)"))
      ->type_name("FILE");
  misses_ = command.add_option("--misses", misses, "Wrong samples that are described one by one")
                ->type_name("N")
                ->default_str("10");
}

Expected<void> SampleOptionRules::check(std::size_t samples, std::size_t candidates) const {
  if (samples > 0 && samples < candidates) {
    return fail(ErrorCode::kUsage, "samples and other candidates are not judged together",
                "candidates of one kind");
  }
  if (samples == 0) {
    if (misses_->count() == 0) return {};
    return fail(ErrorCode::kUsage, misses_->get_name() + " is of samples alone", "--samples FILE");
  }
  for (const CLI::Option* option : excluded_) {
    if (option->count() == 0) continue;
    return fail(ErrorCode::kUsage, option->get_name() + " does not go with samples");
  }
  return {};
}

int run_certify_samples(const SampleCommandOptions& options) {
  if (std::ranges::count(options.files, "-") + (options.scene.scene == "-" ? 1 : 0) > 1) {
    return report_usage("standard input is to be read twice", "a file for one of them");
  }
  const ThreadLimit threads(options.scene.jobs);
  auto loaded = load_scene(options.scene, true);
  if (!loaded) return report_error(loaded.error());
  warn_of_intent(*loaded);
  std::vector<SampleVerdict> verdicts;
  for (const std::string& file : options.files) {
    if (!verdicts.empty() && verdicts.back().interrupted) break;
    auto verdict = SampleRun(options, *loaded, file).run();
    if (!verdict) return report_error(verdict.error());
    verdicts.push_back(*std::move(verdict));
  }
  if (options.json != "-") {
    std::string text;
    for (const SampleVerdict& verdict : verdicts) {
      text += (text.empty() ? "" : "\n") +
              comparison::sample_verdict_text(verdict, loaded->scene, loaded->prepared);
    }
    if (auto done = write_output({}, text); !done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    comparison::write_sample_verdicts_json(*output, verdicts, loaded->scene, loaded->prepared);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  return status_of_samples(verdicts);
}

}  // namespace gnomon::cli
