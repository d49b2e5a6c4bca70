// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels and foreign programs judged by the corpus: every subject on every fixture, one outcome
// each. Exact kernels must give the recorded fractions bit for bit, and so must the oracle; rounded
// kernels and foreign programs are compared by the oracle within a tolerance.
#ifndef GNOMON_FUZZ_CORPUS_CORPUS_JUDGE_H
#define GNOMON_FUZZ_CORPUS_CORPUS_JUDGE_H

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/check/judged_scene.h"
#include "fuzz/check/subject.h"
#include "fuzz/corpus/corpus.h"
#include "gnomon/kernel/error.h"
#include "report/text/text_sink.h"

namespace gnomon::fuzz {

enum class Outcome : std::uint8_t {
  kPass,      // the answer is right; of an n_ file: it was rejected, and as recorded
  kDiffer,    // another answer; of an n_ file: an answer, or our reader rejects it otherwise
  kRejected,  // no answer to a scene that has one
  kCrash,     // a signal, an exception, or a program that cannot be run
  kTimeout,   // a limit of time, memory, output or fragments
  kNotAsked,  // n_ files that are not JSON, of foreign programs
};
std::string_view name_of(Outcome outcome);

struct Judgement {
  Outcome outcome = Outcome::kPass;
  std::string why;  // unless it passes: one sentence
};

struct CorpusOptions {
  std::vector<Subject> subjects;
  /// Of rounded kernels and foreign programs: a share of each polygon, and a width as a share of
  /// the scene's diagonal. The kernel `float` has at least kFloatTolerance.
  double tolerance = 1e-9;
  double seconds = 10;  // of each run of a foreign program, or of a kernel in its process
  std::uint64_t megabytes = 2048;
  /// The gnomon command itself, which judges the kernels on each scene in a process of its own, so
  /// that a crash, a hang and too much memory are outcomes too; empty: they run in this process.
  std::string program;
  std::function<void(double)> progress;            // 0..1
  const std::atomic<bool>* interrupted = nullptr;  // checked between fixtures
};

/// Seven digits of coordinates, and as many lost as a double loses in 1e-9.
inline constexpr double kFloatTolerance = 1e-5;
/// What a subject is judged with.
double tolerance_of(const Subject& subject, double asked);

struct CorpusReport {
  const std::vector<Fixture>* fixtures = nullptr;
  std::vector<Subject> subjects;
  std::vector<std::string> names;  // of the subjects
  double tolerance = 0;
  std::vector<std::vector<Judgement>> judgements;  // by fixture, then subject
  std::vector<std::string> oracle_findings;        // by fixture; empty where the oracle agrees

  /// y_ and n_ fixtures, and i_ fixtures of exact kernels, that did not pass.
  std::uint64_t failures(bool exact_subjects) const;
  /// The oracle or an exact kernel does not say what is recorded: a bug of ours, or a broken file.
  bool disagree() const;
};

/// Works on all threads of the caller's task arena; the result does not depend on their number.
/// Errors: kInterrupted.
Expected<CorpusReport> judge_corpus(const std::vector<Fixture>& fixtures,
                                    const CorpusOptions& options);

/// All kernels with all policies by the default algorithms, the exact ones by all.
std::vector<Subject> default_corpus_subjects();
/// The rounded ones of them by the default algorithms, and again by svbsp and merged: those that
/// the lists of `wrong` are about.
std::vector<Subject> recorded_subjects();

/// Names of the given subjects that fail on a fixture's scene; what `wrong` of an i_ scene records.
std::vector<std::string> wrong_subjects(const JudgedScene& scene,
                                        const std::vector<Subject>& subjects);

/// A y_ or i_ file as it should be: its scene and its words, with fractions and `wrong` (of
/// recorded_subjects()) computed anew. How a fixture is made from a scene that has only "shows" and
/// "kind". Errors: those of reading it and of fixture_text(); kFormat for a y_ scene that some
/// subject gets wrong.
Expected<std::string> record_fixture(const std::filesystem::path& file);

/// The matrix: a row a kind, or a scene if `by_scene`, a column a subject, at most 100 columns
/// wide while there are not too many subjects; below it totals, and what failed and must not.
std::string corpus_text(const CorpusReport& report, bool by_scene);
/// A line a file and subject.
std::string corpus_csv(const CorpusReport& report);
/// The same for programs: stable.
void write_corpus_json(report::TextSink& sink, const CorpusReport& report);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CORPUS_CORPUS_JUDGE_H
