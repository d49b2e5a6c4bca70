// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels in processes of their own that do not come back. The program that judges them is a script
// here: it does what a broken kernel would make of it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fuzz/corpus/corpus_judge.h"
#include "tests/support/test_directory.h"

namespace gnomon::fuzz {
namespace {

namespace fs = std::filesystem;

class CorpusProcess : public testing::Test {
 protected:
  CorpusProcess() {
    auto read = read_corpus(std::string(GNOMON_REGRESSIONS) + "/flags");
    if (read) fixtures_ = {read->front()};
    for (const char* name : {"double", "epick", "plane"}) {
      options_.subjects.push_back(*parse_subject(name));
    }
  }

  /// Judged by a script with this body.
  CorpusReport judge(const std::string& body) {
    const fs::path script = folder_ / "judge";
    std::ofstream(script) << "#!/bin/sh\n" << body << '\n';
    fs::permissions(script, fs::perms::owner_all);
    options_.program = script.string();
    auto report = judge_corpus(fixtures_, options_);
    EXPECT_TRUE(report);
    return report.value_or(CorpusReport{});
  }

  const test::TestDirectory directory_;
  const fs::path folder_ = directory_.path();
  std::vector<Fixture> fixtures_;
  CorpusOptions options_;
};

const std::string kReport = R"({"files": [{"outcomes": {"double": "pass", "epick": "differ", )"
                            R"("plane": "pass"}, "reasons": {"epick": "so"}, "oracle": "no"}]})";

TEST_F(CorpusProcess, OutcomesAreThoseOfItsReport) {
  const CorpusReport report = judge("echo '" + kReport + "'; exit 4");
  const std::vector<Judgement>& own = report.judgements[0];
  EXPECT_EQ(own[0].outcome, Outcome::kPass);
  EXPECT_EQ(own[1].outcome, Outcome::kDiffer);
  EXPECT_EQ(own[1].why, "so");
  EXPECT_EQ(report.oracle_findings[0], "no");
  EXPECT_TRUE(report.disagree());
}

TEST_F(CorpusProcess, OnlyTheKernelThatCrashesIsLost) {
  const CorpusReport report = judge(
      "case \"$*\" in *epick*) kill -SEGV $$;; esac\n"
      "echo '" +
      kReport + "'");
  const std::vector<Judgement>& own = report.judgements[0];
  EXPECT_EQ(own[0].outcome, Outcome::kPass);
  EXPECT_EQ(own[1].outcome, Outcome::kCrash);
  EXPECT_NE(own[1].why.find("signal 11"), std::string::npos) << own[1].why;
  EXPECT_EQ(own[2].outcome, Outcome::kPass);
}

TEST_F(CorpusProcess, HangsAndNonsenseAreOutcomes) {
  options_.seconds = 0.1;
  const CorpusReport hang = judge("sleep 60");
  for (const Judgement& own : hang.judgements[0]) EXPECT_EQ(own.outcome, Outcome::kTimeout);
  options_.seconds = 10;
  for (const std::string body : {"echo {", "echo '{\"files\": []}'", "exit 2"}) {
    const CorpusReport report = judge(body);
    for (const Judgement& own : report.judgements[0]) {
      EXPECT_EQ(own.outcome, Outcome::kCrash) << body;
    }
  }
}

TEST_F(CorpusProcess, ForeignProgramsNeedNone) {
  options_.subjects = {*parse_subject("command:false")};
  const CorpusReport report = judge("exit 1");
  EXPECT_EQ(report.judgements[0][0].outcome, Outcome::kRejected);
  EXPECT_EQ(report.oracle_findings[0], "");
}

}  // namespace
}  // namespace gnomon::fuzz
