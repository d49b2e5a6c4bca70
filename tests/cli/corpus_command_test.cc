// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon certify --corpus, with kernels and with foreign programs that do well and badly.
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

namespace fs = std::filesystem;

const std::string kCorpus = GNOMON_REGRESSIONS;
const std::string kGnomon = GNOMON_PROGRAM;

RunResult certify(const std::string& corpus, std::vector<std::string> more) {
  more.insert(more.begin(), {"certify", "--corpus", corpus});
  return run_gnomon(more);
}

/// How often a subject of a --json report has an outcome.
int count_of(const std::string& json, const char* outcome, unsigned subject = 0) {
  rapidjson::Document document;
  document.Parse(json.c_str());
  EXPECT_FALSE(document.HasParseError()) << json;
  if (document.HasParseError()) return -1;
  return document["subjects"][subject][outcome].GetInt();
}

/// A small corpus of its own: a scene that all get right, one that double+thin gets wrong, and a
/// file that must be rejected.
class CorpusCommand : public testing::Test {
 protected:
  CorpusCommand() {
    for (const std::string name :
         {"coplanar/y_overlapping_tiles.json", "light-in-plane/i_light_in_plane.json",
          "rejected/n_nan.json", "rejected/n_nan.json.expected.json"}) {
      fs::create_directories((directory_.path() / name).parent_path());
      fs::copy_file(kCorpus + "/" + name, directory_.path() / name);
    }
  }
  RunResult judge(const std::string& command, std::vector<std::string> more = {}) {
    // Without a limit of memory: built with sanitizers, gnomon itself needs terabytes of addresses.
    more.insert(more.end(), {"--candidate-command", command, "--megabytes", "0", "--json", "-"});
    return certify(directory_.path().string(), more);
  }

  TestDirectory directory_;
};

TEST(CorpusOfTheTree, MistakesAreNoKernelsHere) {
  const std::string scene = kCorpus + "/zoo/y_on_swapped.json";
  for (const auto& command : {std::vector<std::string>{"certify", "--corpus", kCorpus},
                              {"certify", scene},
                              {"shadows", scene}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--kernel", "plane~on-swapped"});
    const RunResult run = run_gnomon(arguments);
    EXPECT_EQ(run.status, 2) << command[0];
    EXPECT_NE(run.err.find("plane~on-swapped: no such kernel"), std::string::npos) << run.err;
  }
}

TEST(CorpusOfTheTree, IsPassedByOurKernels) {
  const RunResult run =
      certify(kCorpus, {"--kernel", "plane", "--kernel", "double/svbsp", "--in-process"});
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_NE(run.out.find("coplanar"), std::string::npos);
  EXPECT_NE(run.out.find("double/svbsp"), std::string::npos);
  // In processes of their own, one after the other, and in this one: the same.
  const RunResult json = certify(kCorpus, {"--kernel", "plane", "--json", "-", "-j", "1"});
  EXPECT_GE(count_of(json.out, "pass"), 200);
  EXPECT_EQ(count_of(json.out, "failures"), 0);
  EXPECT_EQ(json.out, certify(kCorpus, {"--kernel", "plane", "--json", "-", "--in-process"}).out);
}

TEST(CorpusOfTheTree, IsWhatRecordWrites) {
  const TestDirectory directory;
  fs::copy(kCorpus, directory.path(), fs::copy_options::recursive);
  const RunResult run = certify(directory.path().string(), {"--record"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find(" 0 changed"), std::string::npos) << run.out;
}

TEST(CorpusOfTheTree, IsPassedByAProgramInAnotherLanguage) {
  // Exact arithmetic that shares no line with ours.
  if (std::system("python3 -c ''") != 0) GTEST_SKIP() << "no python3";
  const std::string program = std::string("python3 ") + GNOMON_EXAMPLES + "/shadows.py";
  for (const std::string group : {"coplanar", "needles", "rejected"}) {
    const RunResult run = certify(
        kCorpus + "/" + group, {"--candidate-command", program, "--json", "-", "--seconds", "60"});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(count_of(run.out, "differ"), 0) << group;
    EXPECT_EQ(count_of(run.out, "rejected"), 0) << group;
    EXPECT_GE(count_of(run.out, "pass"), 4) << group;
  }
}

TEST_F(CorpusCommand, JudgesAProgramByItsFragments) {
  const RunResult run = judge(kGnomon + " shadows --kernel double --fragments");
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  EXPECT_EQ(count_of(run.out, "pass"), 3);
  const RunResult thin = judge(kGnomon + " shadows --kernel double --thickness 0 --fragments");
  EXPECT_EQ(thin.status, 0) << thin.out << thin.err;  // what it gets wrong is not scored
  EXPECT_EQ(count_of(thin.out, "differ"), 1);
  const RunResult text = certify(
      directory_.path().string(),
      {"--candidate-command", kGnomon + " shadows --kernel double --thickness 0 --fragments",
       "--megabytes", "0", "--by-scene"});
  EXPECT_NE(text.out.find("light-in-plane/i_light_in_plane  d"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("truly shadow"), std::string::npos) << text.out;
}

TEST_F(CorpusCommand, JudgesAProgramByItsFractionsAlone) {
  for (const std::string options : {"--exact-fractions", "--kernel double"}) {
    const RunResult run = judge(kGnomon + " shadows " + options);
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_EQ(count_of(run.out, "pass"), 3) << run.out;
  }
  // All of everything lit.
  const RunResult wrong =
      judge(kGnomon + " shadows --exact-fractions \"$1\" | sed 's/\"9.16\"/\"1\"/' && :");
  EXPECT_EQ(wrong.status, 1) << wrong.out << wrong.err;
  EXPECT_NE(wrong.out.find("lit 1 instead of 0.5625"), std::string::npos) << wrong.out;
}

TEST_F(CorpusCommand, CrashesHangsRefusalsAndNonsenseAreTold) {
  const RunResult crash = judge("kill -SEGV $$");
  EXPECT_EQ(crash.status, 1);
  EXPECT_EQ(count_of(crash.out, "crash"), 3);
  const RunResult absent = judge("/no/such/program");
  EXPECT_EQ(count_of(absent.out, "crash"), 3);  // not a program that rejects the n_ file
  const RunResult hang = judge("sleep 60;", {"--seconds", "0.2"});
  EXPECT_EQ(hang.status, 1);
  EXPECT_EQ(count_of(hang.out, "timeout"), 3);
  const RunResult refusal = judge("false");
  EXPECT_EQ(refusal.status, 1);
  EXPECT_EQ(count_of(refusal.out, "rejected"), 2);
  EXPECT_EQ(count_of(refusal.out, "pass"), 1);
  const RunResult nonsense = judge("echo");
  EXPECT_EQ(nonsense.status, 1);
  EXPECT_EQ(count_of(nonsense.out, "differ"), 3);
}

TEST_F(CorpusCommand, ARecordThatIsWrongIsABugOfOurs) {
  const fs::path file = directory_.path() / "coplanar/y_overlapping_tiles.json";
  const std::string text = read_text(file);
  std::string changed = text;
  changed.replace(changed.find("\"9/16\", \"shadow\": \"7/16\""), 24,
                  "\"1/2\", \"shadow\": \"1/2\"");
  write_text(file, changed);
  const RunResult run = certify(directory_.path().string(), {"--kernel", "plane"});
  EXPECT_EQ(run.status, 4) << run.out;
  EXPECT_NE(run.out.find("not the recorded fractions"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("oracle: light 'sun', polygon 'floor'"), std::string::npos) << run.out;
  EXPECT_EQ(certify(directory_.path().string(), {"--record"}).status, 0);
  EXPECT_EQ(read_text(file), text);
}

TEST_F(CorpusCommand, BadUsageIsTold) {
  EXPECT_EQ(run_gnomon({"certify"}).status, 2);
  EXPECT_EQ(certify(kCorpus, {"--strict"}).status, 2);
  EXPECT_EQ(certify(kCorpus, {"--kernel", "quadruple"}).status, 2);
  EXPECT_EQ(certify(directory_.file("absent"), {}).status, 2);
  const RunResult alone = run_gnomon({"certify", "x.json", "--candidate-command", "true"});
  EXPECT_EQ(alone.status, 2);
  EXPECT_NE(alone.err.find("needs --corpus"), std::string::npos) << alone.err;
}

}  // namespace
}  // namespace gnomon::test
