// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon fuzz and gnomon replay as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

TEST(Fuzz, ExactKernelsHoldEveryPropertyAndKindsAreTold) {
  const RunResult run = run_gnomon({"fuzz", "--generator", "soup-lattice", "--count", "30"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("30 scenes"));
  EXPECT_THAT(run.out, HasSubstr("soup-lattice"));
  EXPECT_THAT(run.out, HasSubstr("every property held"));
}

TEST(Fuzz, ARoundedKernelFailsTheRunOnlyIfAsked) {
  const TestDirectory directory;
  const std::vector<std::string> command = {
      "fuzz",    "--kernel", "float+thin", "--property",          "oracle", "--generator", "mix",
      "--count", "12",       "--db",       directory.file("a.db")};
  const RunResult run = run_gnomon(command);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("oracle:misclassified:float+thin"));
  EXPECT_THAT(run.err, HasSubstr("found oracle:misclassified:float+thin:"));
  // The same campaign: nothing is left to do, and the answer is the same.
  std::vector<std::string> again = command;
  again.insert(again.end(), {"--fail-on", "misclassified"});
  const RunResult second = run_gnomon(again);
  EXPECT_EQ(second.status, 1);
  EXPECT_EQ(second.out, run.out);
}

TEST(Fuzz, ACaseIsReplayed) {
  const TestDirectory directory;
  const RunResult run =
      run_gnomon({"fuzz", "--kernel", "float+thin", "--property", "oracle", "--generator",
                  "family-needles", "--count", "8", "--keep", "1", "--db", directory.file("a.db")});
  ASSERT_EQ(run.status, 0) << run.err;
  const RunResult which = run_gnomon({"replay", directory.file("a.db")});
  EXPECT_EQ(which.status, 2);
  ASSERT_THAT(which.err, HasSubstr("--case with one of: "));
  const std::string list = which.err.substr(which.err.find("one of: ") + 8);
  const RunResult replayed = run_gnomon({"replay", directory.file("a.db"), "--case",
                                         list.substr(0, list.find_first_of(",\n")), "--kernel",
                                         "float+thin", "-o", directory.file("case.json")});
  EXPECT_EQ(replayed.status, 1) << replayed.err;
  EXPECT_THAT(replayed.out, HasSubstr("oracle:"));
  EXPECT_TRUE(std::filesystem::exists(directory.file("case.json")));
  // Exact kernels are right on it.
  EXPECT_EQ(run_gnomon({"replay", directory.file("case.json"), "--kernel", "plane"}).status, 0);
}

TEST(Fuzz, AForeignProgramIsJudgedToo) {
  const RunResult run = run_gnomon({"fuzz", "--candidate-command", "exit 7 #", "--generator",
                                    "soup-lattice", "--count", "2", "--fail-on", "no-refusal"});
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_THAT(run.out, HasSubstr("no-refusal:status 7:command:exit 7 #"));
}

TEST(Fuzz, MistakesAreNamed) {
  const TestDirectory directory;
  write_text(directory.file("text.db"), "not a database, and long enough to be seen as none\n");
  const auto message = [](const std::vector<std::string>& arguments) {
    const RunResult run = run_gnomon(arguments);
    EXPECT_EQ(run.status, 2) << run.out;
    return run.err;
  };
  EXPECT_THAT(message({"fuzz", "--generator", "nope"}), HasSubstr("soup-lattice"));
  EXPECT_THAT(message({"fuzz", "--kernel", "quad"}), HasSubstr("no such kernel"));
  EXPECT_THAT(message({"fuzz", "--property", "luck"}), HasSubstr("exact-agreement"));
  EXPECT_THAT(message({"fuzz", "--time", "soon"}), HasSubstr("90s"));
  EXPECT_THAT(message({"fuzz", "--shard", "2/2"}), HasSubstr("0 <= K < N"));
  EXPECT_THAT(message({"fuzz", "--merge", "a.db"}), HasSubstr("--db"));
  EXPECT_THAT(message({"fuzz", "--count", "1", "--db", directory.file("text.db")}),
              HasSubstr("text.db: file is not a database"));
  EXPECT_THAT(message({"replay"}), HasSubstr("nothing to replay"));
}

TEST(Fuzz, CtrlCKeepsWhatIsDone) {
  const TestDirectory directory;
  RunOptions options;
  options.signal = 2;
  options.signal_after = 1.5;
  const RunResult run = run_gnomon(
      {"fuzz", "--generator", "soup-lattice", "--count", "1000000", "--db", directory.file("a.db")},
      options);
  EXPECT_EQ(run.status, 130) << run.err;
  EXPECT_THAT(run.out, HasSubstr("the same command goes on from here"));
}

TEST(Fuzz, EveryMistakeOfTheZooIsFound) {
  const RunResult run = run_gnomon({"fuzz", "--zoo", "--count", "1"});
  EXPECT_EQ(run.status, 0) << run.out;
  EXPECT_THAT(run.out, HasSubstr("plane/svbsp~coplanar-in-sequence"));
}

}  // namespace
}  // namespace gnomon::test
