// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/corpus_judge.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <mutex>
#include <optional>
#include <utility>

#include "fuzz/corpus/claimed_shares.h"
#include "fuzz/corpus/corpus_process.h"
#include "fuzz/process/command.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/result/read_claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"

namespace gnomon::fuzz {

namespace {

// Scenes of a corpus are small: what makes so many fragments has lost its way.
constexpr std::uint64_t kMostFragments = 200'000;

constexpr std::array<std::string_view, 6> kOutcomeNames = {"pass",  "differ",  "rejected",
                                                           "crash", "timeout", "not asked"};

/// Subjects judged on one scene, with the corpus's outcomes.
class SceneJudge {
 public:
  SceneJudge(const JudgedScene& scene, double tolerance) : scene_(scene), tolerance_(tolerance) {}

  /// `recorded` may be null.
  Judgement judge(const Subject& subject, const std::vector<RecordedLight>* recorded) const {
    Judgement judgement;
    const auto thrown = thrown_by([&] { judgement = run(subject, recorded); });
    if (!thrown) return judgement;
    if (thrown->out_of_memory) return {Outcome::kTimeout, "out of memory"};
    return {Outcome::kCrash, thrown->what};
  }

  Judgement judge_text(const Subject& subject, const std::string& result,
                       const std::vector<RecordedLight>& recorded) const {
    const auto unreadable = [](const Error& error) {
      return Judgement{Outcome::kDiffer, "its result cannot be read: " + to_string(error)};
    };
    const auto shares_alone = has_shares_alone(result);
    if (!shares_alone) return unreadable(shares_alone.error());
    if (*shares_alone) {
      const auto differs = compare_shares(result, scene_.scene(), scene_.prepared(), recorded,
                                          tolerance_of(subject, tolerance_));
      if (!differs) return unreadable(differs.error());
      return differs->empty() ? Judgement{} : Judgement{Outcome::kDiffer, *differs};
    }
    const auto candidate = parse_claims(result, "its output", scene_.scene());
    if (!candidate) return unreadable(candidate.error());
    return judgement_of(subject, scene_.judge(*candidate, certify_options(subject)));
  }

 private:
  Judgement run(const Subject& subject, const std::vector<RecordedLight>* recorded) const {
    ShadowOptions options = shadow_options(subject);
    options.limits.fragments = kMostFragments;
    const Judged judged = scene_.classify_and_judge(options, name_of(subject),
                                                    certify_options(subject), subject.mistake);
    if (judged.refused) {
      const bool limit = judged.refused->code == ErrorCode::kLimit;
      return {limit ? Outcome::kTimeout : Outcome::kRejected, to_string(*judged.refused)};
    }
    if (judged.unjudged) return {Outcome::kDiffer, to_string(*judged.unjudged)};
    Judgement judgement = judgement_of(subject, *judged.report);
    if (judgement.outcome != Outcome::kPass || recorded == nullptr || !subject.exact()) {
      return judgement;
    }
    const auto found = recorded_of(scene_.scene(), scene_.prepared(), judged.classified->result,
                                   judged.classified->sides);
    const std::string differs = found ? difference(*recorded, *found) : to_string(found.error());
    if (differs.empty()) return {};
    return {Outcome::kDiffer, "not the recorded fractions: " + differs};
  }

  oracle::CertifyOptions certify_options(const Subject& subject) const {
    const double tolerance = tolerance_of(subject, tolerance_);
    oracle::CertifyOptions options;
    options.strict = subject.exact();
    options.tolerance = tolerance;
    options.width = tolerance * scene_.diagonal();
    options.most_regions = 4;
    return options;
  }

  static Judgement judgement_of(const Subject& subject, const Expected<oracle::Report>& report) {
    if (!report) return {Outcome::kDiffer, to_string(report.error())};
    const bool right =
        subject.exact() ? report->confirms_exact() : report->verdict != oracle::Verdict::kFailed;
    return right ? Judgement{} : Judgement{Outcome::kDiffer, report->reason};
  }

  const JudgedScene& scene_;
  double tolerance_;
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
    const JudgedScene judged(fixture.scene, *prepared);
    const SceneJudge judge(judged, options_.tolerance);
    if (!apart) {
      report_.oracle_findings[i] = difference_from_oracle(judged.answer(), fixture.fractions);
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

std::vector<std::string> wrong_subjects(const JudgedScene& scene,
                                        const std::vector<Subject>& subjects) {
  std::vector<std::string> wrong;
  const SceneJudge judge(scene, CorpusOptions{}.tolerance);
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
  const auto prepared = prepare(read->scene);
  if (!prepared) return tl::unexpected(prepared.error());
  const JudgedScene judged(read->scene, *prepared);
  note->wrong = wrong_subjects(judged, recorded_subjects());
  if (!note->inform && !note->wrong.empty()) {
    std::string names;
    for (const std::string& name : note->wrong) names += ' ' + name;
    return fail(ErrorCode::kFormat, "a y_ scene that some get wrong:" + names, "an i_ scene",
                ErrorPlace{file.string(), 0, 0, {}});
  }
  return fixture_text(judged, *note);
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
