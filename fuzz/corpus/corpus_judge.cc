// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/corpus_judge.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

#include "fuzz/corpus/claimed_shares.h"
#include "fuzz/corpus/corpus_process.h"
#include "fuzz/mistakes/compute.h"
#include "fuzz/process/command.h"
#include "gnomon/oracle/exact_answer.h"
#include "gnomon/oracle/read_candidate.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "report/sides/candidate_from_result.h"

namespace gnomon::fuzz {

namespace {

// Scenes of a corpus are small: what makes so many fragments has lost its way.
constexpr std::uint64_t kMostFragments = 200'000;

constexpr std::array<std::string_view, 6> kOutcomeNames = {"pass",  "differ",  "rejected",
                                                           "crash", "timeout", "not asked"};

/// One scene with its exact answer, judged by as many subjects as there are.
class SceneJudge {
 public:
  SceneJudge(const Scene& scene, const PreparedScene& prepared, double tolerance)
      : scene_(scene),
        prepared_(prepared),
        answer_(scene, prepared),
        diagonal_(oracle::scene_diagonal(prepared)),
        tolerance_(tolerance) {}

  const oracle::ExactAnswer& answer() const { return answer_; }

  /// `recorded` may be null.
  Judgement judge(const Subject& subject, const std::vector<RecordedLight>* recorded) const {
    try {
      ShadowOptions options = shadow_options(subject);
      options.max_fragments = kMostFragments;
      const Expected<ShadowResult> result = compute_shadows(prepared_, options, subject.mistake);
      if (!result) {
        const bool limit = result.error().code == ErrorCode::kLimit;
        return {limit ? Outcome::kTimeout : Outcome::kRejected, to_string(result.error())};
      }
      const oracle::Candidate candidate = report::candidate_from_result(
          scene_, prepared_, *result, name_of(subject), subject.kernel.exact());
      Judgement judgement = compare(candidate, subject);
      if (judgement.outcome != Outcome::kPass || recorded == nullptr || !subject.exact()) {
        return judgement;
      }
      const auto found = recorded_of(scene_, prepared_, *result);
      const std::string differs = found ? difference(*recorded, *found) : to_string(found.error());
      if (differs.empty()) return {};
      return {Outcome::kDiffer, "not the recorded fractions: " + differs};
    } catch (const std::bad_alloc&) {
      return {Outcome::kTimeout, "out of memory"};
    } catch (const std::exception& error) {
      return {Outcome::kCrash, error.what()};
    }
  }

  Judgement judge_text(const Subject& subject, const std::string& result,
                       const std::vector<RecordedLight>& recorded) const {
    const auto unreadable = [](const Error& error) {
      return Judgement{Outcome::kDiffer, "its result cannot be read: " + to_string(error)};
    };
    const auto shares_alone = has_shares_alone(result);
    if (!shares_alone) return unreadable(shares_alone.error());
    if (*shares_alone) {
      const auto differs =
          compare_shares(result, scene_, prepared_, recorded, tolerance_of(subject, tolerance_));
      if (!differs) return unreadable(differs.error());
      return differs->empty() ? Judgement{} : Judgement{Outcome::kDiffer, *differs};
    }
    const auto candidate = oracle::parse_candidate(result, "its output", scene_);
    if (!candidate) return unreadable(candidate.error());
    return compare(*candidate, subject);
  }

 private:
  Judgement compare(const oracle::Candidate& candidate, const Subject& subject) const {
    const double tolerance = tolerance_of(subject, tolerance_);
    oracle::CertifyOptions options;
    options.strict = subject.exact();
    options.tolerance = tolerance;
    options.width = tolerance * diagonal_;
    options.threads = 1;
    options.most_regions = 4;
    const auto report = oracle::certify(answer_, candidate, options);
    if (!report) return {Outcome::kDiffer, to_string(report.error())};
    const bool right =
        subject.exact() ? report->confirms_exact() : report->verdict != oracle::Verdict::kFailed;
    return right ? Judgement{} : Judgement{Outcome::kDiffer, report->reason};
  }

  const Scene& scene_;
  const PreparedScene& prepared_;
  oracle::ExactAnswer answer_;
  double diagonal_, tolerance_;
};

/// A foreign program on a file, as far as that can be judged without its output.
Judgement run_foreign(const Subject& subject, const std::filesystem::path& file,
                      const CorpusOptions& options, std::string& out) {
  CommandOptions limits;
  limits.arguments = {file.string()};
  limits.seconds = options.seconds;
  limits.megabytes = options.megabytes;
  limits.interrupted = options.interrupted;
  auto result = run_command(subject.command, limits);
  if (!result) return {Outcome::kCrash, to_string(result.error())};
  out = std::move(result->out);
  switch (result->end) {
    case CommandEnd::kExited:
      if (result->status == 0) return {};
      return {Outcome::kRejected, how_it_ended(*result)};
    case CommandEnd::kTimeout:
    case CommandEnd::kTooLong:
      return {Outcome::kTimeout, how_it_ended(*result)};
    case CommandEnd::kSignal:
    case CommandEnd::kNotFound:
      break;
  }
  return {Outcome::kCrash, how_it_ended(*result)};
}

/// What our reader and prepare() say of an n_ file.
Judgement judge_rejection(const Fixture& fixture) {
  std::optional<Error> error;
  const auto read = read_scene(fixture.file);
  if (!read) {
    error = read.error();
  } else if (const auto prepared = prepare(read->scene); !prepared) {
    error = prepared.error();
  }
  if (!error) return {Outcome::kDiffer, "it was not rejected"};
  const Error& wanted = fixture.error;
  const auto place = [](const Error& one) {
    return fmt::format("{} at {}:{} {}", error_code_name(one.code), one.where.line,
                       one.where.column, one.where.pointer);
  };
  if (place(*error) == place(wanted)) return {};
  return {Outcome::kDiffer, fmt::format("rejected as {} instead of {}: {}", place(*error),
                                        place(wanted), error->what)};
}

class CorpusJudge {
 public:
  CorpusJudge(const std::vector<Fixture>& fixtures, const CorpusOptions& options)
      : options_(options) {
    report_.fixtures = &fixtures;
    report_.subjects = options.subjects;
    report_.tolerance = options.tolerance;
    for (const Subject& subject : options.subjects) report_.names.push_back(name_of(subject));
    report_.judgements.assign(fixtures.size(), std::vector<Judgement>(options.subjects.size()));
    report_.oracle_findings.resize(fixtures.size());
  }

  Expected<CorpusReport> run() {
    const std::size_t count = report_.fixtures->size();
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      if (stopped()) return;
      judge(i);
      const std::lock_guard lock(mutex_);
      ++done_;
      if (options_.progress) {
        options_.progress(static_cast<double>(done_) / static_cast<double>(count));
      }
    });
    if (stopped()) return fail(ErrorCode::kInterrupted, "interrupted");
    return std::move(report_);
  }

 private:
  bool stopped() const { return options_.interrupted != nullptr && *options_.interrupted; }

  void judge(std::size_t i) {
    const Fixture& fixture = (*report_.fixtures)[i];
    if (fixture.expectation == Expectation::kReject) {
      judge_rejected(fixture, report_.judgements[i]);
    } else {
      judge_scene(fixture, i);
    }
  }

  void judge_rejected(const Fixture& fixture, std::vector<Judgement>& judgements) {
    const Judgement ours = judge_rejection(fixture);
    for (std::size_t s = 0; s < judgements.size(); ++s) {
      const Subject& subject = report_.subjects[s];
      if (!subject.foreign()) {
        judgements[s] = ours;
        continue;
      }
      if (fixture.file.extension() != ".json") {
        judgements[s] = {Outcome::kNotAsked, "not JSON"};
        continue;
      }
      std::string out;
      judgements[s] = run_foreign(subject, fixture.file, options_, out);
      if (judgements[s].outcome == Outcome::kRejected) {
        judgements[s] = {};
      } else if (judgements[s].outcome == Outcome::kPass &&
                 fixture.error.code != ErrorCode::kLimit) {  // others may have no such limit
        judgements[s] = {Outcome::kDiffer, "it was not rejected"};
      }
    }
  }

  void judge_scene(const Fixture& fixture, std::size_t i) {
    std::vector<Judgement>& judgements = report_.judgements[i];
    const auto is_foreign = [](const Subject& subject) { return subject.foreign(); };
    const bool apart =
        !options_.program.empty() && !std::ranges::all_of(report_.subjects, is_foreign);
    if (apart) judge_apart(fixture, i);
    if (apart && std::ranges::none_of(report_.subjects, is_foreign)) return;
    const auto prepared = prepare(fixture.scene);
    if (!prepared) {
      report_.oracle_findings[i] = "it cannot be prepared: " + to_string(prepared.error());
      judgements.assign(judgements.size(), {Outcome::kRejected, to_string(prepared.error())});
      return;
    }
    const SceneJudge judge(fixture.scene, *prepared, options_.tolerance);
    if (!apart) {
      report_.oracle_findings[i] = difference_from_oracle(judge.answer(), fixture.fractions);
    }
    for (std::size_t s = 0; s < judgements.size(); ++s) {
      if (stopped()) return;
      const Subject& subject = report_.subjects[s];
      if (!subject.foreign()) {
        if (!apart) judgements[s] = judge.judge(subject, &fixture.fractions);
        continue;
      }
      std::string out;
      judgements[s] = run_foreign(subject, fixture.file, options_, out);
      if (judgements[s].outcome == Outcome::kPass) {
        judgements[s] = judge.judge_text(subject, out, fixture.fractions);
      }
    }
  }

  /// The kernels in a process of their own.
  void judge_apart(const Fixture& fixture, std::size_t i) {
    std::vector<std::string> names;
    std::vector<std::size_t> places;
    for (std::size_t s = 0; s < report_.subjects.size(); ++s) {
      if (report_.subjects[s].foreign()) continue;
      names.push_back(report_.names[s]);
      places.push_back(s);
    }
    ProcessVerdict verdict = judge_in_process(fixture, names, options_);
    report_.oracle_findings[i] = std::move(verdict.oracle);
    for (std::size_t k = 0; k < places.size(); ++k) {
      report_.judgements[i][places[k]] = std::move(verdict.judgements[k]);
    }
  }

  const CorpusOptions& options_;
  CorpusReport report_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

std::vector<Subject> subjects_by_name(const std::vector<std::string>& names) {
  std::vector<Subject> subjects;
  subjects.reserve(names.size());
  for (const std::string& name : names) subjects.push_back(*parse_subject(name));
  return subjects;
}

std::vector<std::string> rounded_names() {
  std::vector<std::string> names;
  for (const std::string kernel : {"float", "double", "longdouble"}) {
    for (const std::string policy : {"", "+thin", "+identity", "+identity+thin"}) {
      names.push_back(kernel + policy);
    }
  }
  names.emplace_back("epick");
  names.emplace_back("epick+identity");
  return names;
}

}  // namespace

std::string_view name_of(Outcome outcome) {
  return kOutcomeNames[static_cast<std::size_t>(outcome)];
}

double tolerance_of(const Subject& subject, double asked) {
  const bool is_float = !subject.foreign() && subject.kernel.kernel == KernelId::kFloat;
  return is_float ? std::max(asked, kFloatTolerance) : asked;
}

Expected<CorpusReport> judge_corpus(const std::vector<Fixture>& fixtures,
                                    const CorpusOptions& options) {
  return CorpusJudge(fixtures, options).run();
}

std::vector<Subject> default_corpus_subjects() {
  std::vector<std::string> names = rounded_names();
  for (const char* name : {"epeck", "rational", "plane", "plane/svbsp/merged", "plane/receiver"}) {
    names.emplace_back(name);
  }
  return subjects_by_name(names);
}

std::vector<Subject> recorded_subjects() {
  std::vector<std::string> names = rounded_names();
  const std::size_t count = names.size();
  for (std::size_t i = 0; i < count; ++i) names.push_back(names[i] + "/svbsp/merged");
  return subjects_by_name(names);
}

std::vector<std::string> wrong_subjects(const Scene& scene, const std::vector<Subject>& subjects) {
  std::vector<std::string> wrong;
  const auto prepared = prepare(scene);
  if (!prepared) return wrong;
  const SceneJudge judge(scene, *prepared, CorpusOptions{}.tolerance);
  for (const Subject& subject : subjects) {
    if (judge.judge(subject, nullptr).outcome != Outcome::kPass) wrong.push_back(name_of(subject));
  }
  std::ranges::sort(wrong);
  return wrong;
}

Expected<std::string> record_fixture(const std::filesystem::path& file) {
  const auto read = read_scene(file);
  if (!read) return tl::unexpected(read.error());
  auto note = read_note_of(read->scene);
  if (!note) return tl::unexpected(note.error());
  note->inform = file.filename().string().starts_with("i_");
  note->wrong = wrong_subjects(read->scene, recorded_subjects());
  if (!note->inform && !note->wrong.empty()) {
    std::string names;
    for (const std::string& name : note->wrong) names += ' ' + name;
    return fail(ErrorCode::kFormat, "a y_ scene that some get wrong:" + names, "an i_ scene",
                ErrorPlace{file.string(), 0, 0, {}});
  }
  return fixture_text(read->scene, *note);
}

std::uint64_t CorpusReport::failures(bool exact_subjects) const {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < judgements.size(); ++i) {
    for (std::size_t s = 0; s < subjects.size(); ++s) {
      if (subjects[s].exact() != exact_subjects) continue;
      const bool scored = exact_subjects || (*fixtures)[i].expectation != Expectation::kInform;
      const Outcome outcome = judgements[i][s].outcome;
      if (scored && outcome != Outcome::kPass && outcome != Outcome::kNotAsked) ++count;
    }
  }
  return count;
}

bool CorpusReport::disagree() const {
  return failures(true) > 0 || std::ranges::any_of(oracle_findings, [](const std::string& finding) {
           return !finding.empty();
         });
}

}  // namespace gnomon::fuzz
