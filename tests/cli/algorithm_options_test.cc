// SPDX-License-Identifier: GPL-3.0-or-later
// --algorithm and --jobs: what is refused, what the files say of it, and that no answer depends on
// either.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <map>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Each;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using Arguments = std::vector<std::string>;

class AlgorithmOptions : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(run_gnomon({"generate", "city", "--param", "n=100", "-o", city_}).status, 0);
  }

  /// gnomon COMMAND with a scene of a hundred polygons.
  RunResult run(const std::string& command, const Arguments& options) const {
    Arguments arguments{command, city_};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_gnomon(arguments);
  }
  std::string result(const Arguments& options) const {
    const RunResult done = run("shadows", options);
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.err, "");
    return done.out;
  }
  void expect_refused(const std::string& command, const Arguments& options,
                      const std::vector<std::string>& words) const {
    const RunResult done = run(command, options);
    EXPECT_EQ(done.status, 2) << done.err;
    EXPECT_EQ(done.out, "");
    EXPECT_THAT(done.err, AllOf(StartsWith("gnomon: "), EndsWith("\n")));
    EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
    for (const std::string& word : words) EXPECT_THAT(done.err, HasSubstr(word));
  }

  static rapidjson::Document parsed(const std::string& text) {
    rapidjson::Document document;
    document.Parse(text.c_str());
    EXPECT_FALSE(document.HasParseError()) << text.substr(0, 200);
    return document;
  }
  static std::string algorithm_of(const std::string& result) {
    return parsed(result)["algorithm"].GetString();
  }
  /// Exact lit fractions by polygon and side.
  static std::map<std::string, std::string> lit_fractions(const std::string& result) {
    const rapidjson::Document document = parsed(result);
    std::map<std::string, std::string> fractions;
    for (const auto& light : document["lights"].GetArray()) {
      for (const auto& polygon : light["polygons"].GetArray()) {
        const std::string name = std::string(light["id"].GetString()) + '/' +
                                 polygon["id"].GetString() + '/' + polygon["side"].GetString();
        fractions[name] = polygon["lit"]["fraction"].GetString();
      }
    }
    return fractions;
  }

  TestDirectory directory_;
  const std::string city_ = directory_.file("city.json");
};

TEST_F(AlgorithmOptions, WhatCannotBeIsRefusedInOneLine) {
  expect_refused("shadows", {"--algorithm", "magic"}, {"magic", "auto", "sectors", "svbsp"});
  expect_refused("shadows", {"--algorithm", "both"}, {"both", "sectors", "svbsp"});
  expect_refused("certify", {"--algorithm", "magic"}, {"magic", "svbsp", "both"});
  expect_refused("render", {"--algorithm", "magic"}, {"magic", "svbsp"});
  expect_refused("shadows", {"--algorithm", "sectors", "--combined"}, {"--combined", "svbsp"});
  expect_refused("shadows", {"--algorithm", "sectors", "--no-merge"}, {"--no-merge", "svbsp"});
  expect_refused("shadows", {"--algorithm", "sectors", "--no-prefix"}, {"--no-prefix", "svbsp"});
  // What tells no fragments is asked for none.
  for (const std::string option : {"--fragments", "--exact-loops", "--illuminate"}) {
    expect_refused("shadows", {"--algorithm", "contour", option}, {option, "contour", "sectors"});
  }
  expect_refused("shadows", {"--algorithm", "contour", "--combined"}, {"--combined", "svbsp"});
  expect_refused("shadows", {"--algorithm", "contour", "--no-merge"}, {"--no-merge", "svbsp"});
  expect_refused("certify", {"--algorithm", "contour", "--explain"}, {"--explain", "sectors"});
  expect_refused("certify", {"--algorithm", "contour", "--combined"}, {"--combined", "svbsp"});
  expect_refused("render", {"--algorithm", "contour"}, {"render", "contour", "sectors"});
  expect_refused("render", {"--algorithm", "contour", "--illuminate"}, {"render", "contour"});
  for (const std::string command : {"shadows", "certify", "render", "info"}) {
    expect_refused(command, {"--jobs=-1"}, {"--jobs", "-1"});
  }
  expect_refused("shadows", {"--jobs", "1025"}, {"--jobs", "1024"});
  expect_refused("shadows", {"--jobs", "99999999999999999999"}, {"--jobs"});
  expect_refused("shadows", {"--jobs", "two"}, {"--jobs", "two"});
  expect_refused("shadows", {"--jobs"}, {"--jobs"});
}

TEST_F(AlgorithmOptions, TheResultSaysWhichAlgorithmRan) {
  EXPECT_EQ(algorithm_of(result({})), "contour");
  EXPECT_EQ(algorithm_of(result({"--algorithm", "auto"})), "contour");
  // Where more than nearest shares is asked for, or a kernel rounds, it is sectors.
  EXPECT_EQ(algorithm_of(result({"--fragments"})), "sectors");
  EXPECT_EQ(algorithm_of(result({"--exact-fractions"})), "sectors");
  EXPECT_EQ(algorithm_of(result({"--kernel", "double"})), "sectors");
  EXPECT_EQ(algorithm_of(result({"--algorithm", "sectors"})), "sectors");
  EXPECT_EQ(algorithm_of(result({"--algorithm", "svbsp"})), "svbsp");
  // Where only svbsp can do it, auto is that.
  EXPECT_EQ(algorithm_of(result({"--combined"})), "svbsp");
  EXPECT_EQ(algorithm_of(result({"--no-merge"})), "svbsp");
  EXPECT_EQ(algorithm_of(result({"--no-prefix"})), "svbsp");
}

TEST_F(AlgorithmOptions, BothAlgorithmsGiveTheSameExactFractions) {
  const auto sectors = lit_fractions(result({"--exact-fractions", "--algorithm", "sectors"}));
  const auto svbsp = lit_fractions(result({"--exact-fractions", "--algorithm", "svbsp"}));
  EXPECT_GT(sectors.size(), 100u);
  EXPECT_TRUE(std::ranges::any_of(
      sectors, [](const auto& entry) { return entry.second.find('/') != std::string::npos; }));
  EXPECT_EQ(sectors, svbsp);
}

/// A method without fragments writes what the others do but for them, and is judged by it.
TEST_F(AlgorithmOptions, ContourTellsSharesAndClassesAlone) {
  const auto sectors = lit_fractions(result({"--exact-fractions", "--algorithm", "sectors"}));
  EXPECT_EQ(lit_fractions(result({"--exact-fractions", "--algorithm", "contour"})), sectors);
  EXPECT_EQ(algorithm_of(result({"--algorithm", "contour"})), "contour");
  for (const std::string kernel : {"plane", "rational"}) {
    const RunResult done = run("certify", {"--algorithm", "contour", "--kernel", kernel});
    EXPECT_EQ(done.status, 0) << done.out;
    EXPECT_THAT(done.out, HasSubstr("Identical to the exact answer: " + kernel));
  }
  const RunResult rounded = run("certify", {"--algorithm", "contour", "--kernel", "float"});
  EXPECT_THAT(rounded.out, HasSubstr("by contour"));
  // Its file has no fragments that could be judged one by one.
  const std::string answer = directory_.file("answer.json");
  ASSERT_EQ(run("shadows", {"--algorithm", "contour", "-o", answer}).status, 0);
  expect_refused("verify", {answer}, {"fragments"});
  expect_refused("render", {answer}, {"fragments"});
  // A picture of all methods shows those that have fragments.
  const RunResult all = run("render", {"--algorithm", "all"});
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_THAT(all.out, AllOf(HasSubstr("sectors: "), Not(HasSubstr("contour: "))));
  const RunResult report = run("certify", {"--algorithm", "contour", "--kernel", "float",
                                           "--report", directory_.file("report")});
  EXPECT_THAT(report.err, "");
}

TEST_F(AlgorithmOptions, NoByteDependsOnTheNumberOfThreads) {
  // Large enough for some tasks.
  ASSERT_EQ(run_gnomon({"generate", "city", "--param", "n=1500", "-o", city_}).status, 0);
  for (const std::string kernel : {"plane", "double"}) {
    const Arguments options{"--kernel", kernel, "--fragments"};
    const std::string all = result(options);
    for (const std::string jobs : {"0", "1", "2", "7"}) {
      Arguments some = options;
      some.insert(some.end(), {"--jobs", jobs});
      EXPECT_TRUE(result(some) == all) << kernel << " on " << jobs << " threads";
    }
  }
}

TEST_F(AlgorithmOptions, CertifyJudgesEachAlgorithm) {
  const std::string json = directory_.file("verdict.json");
  const RunResult done = run("certify", {"--kernel", "plane", "--kernel", "double", "--algorithm",
                                         "both", "--json", json});
  EXPECT_EQ(done.status, 0) << done.out;
  EXPECT_THAT(done.out, AllOf(HasSubstr("by sectors:\n"), HasSubstr("by svbsp:\n")));
  EXPECT_THAT(done.out, HasSubstr("Identical to the exact answer: plane/sectors, plane/svbsp."));
  const rapidjson::Document certificate = parsed(read_text(json));
  std::vector<std::string> runs;
  for (const auto& judged : certificate["runs"].GetArray()) {
    runs.push_back(std::string(judged["kernel"].GetString()) + ' ' +
                   judged["algorithm"].GetString());
  }
  EXPECT_THAT(
      runs, testing::ElementsAre("plane sectors", "double sectors", "plane svbsp", "double svbsp"));
}

TEST_F(AlgorithmOptions, AllRunsEveryMethodThatTakesTheLights) {
  const RunResult done = run("certify", {"--kernel", "plane", "--algorithm", "all"});
  EXPECT_EQ(done.status, 0) << done.err;
  for (const char* method : {"sectors", "contour", "svbsp", "receiver"}) {
    EXPECT_THAT(done.out, HasSubstr(method));
  }
  EXPECT_THAT(done.out, Not(HasSubstr("failed")));
}

TEST_F(AlgorithmOptions, RenderShowsTheFragmentsOfBoth) {
  const RunResult both = run("render", {"--algorithm", "both", "--fragments"});
  EXPECT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.out, AllOf(HasSubstr("sectors: "), HasSubstr("svbsp: ")));
  const RunResult one = run("render", {"--algorithm", "svbsp"});
  EXPECT_THAT(one.out, Not(HasSubstr("svbsp: ")));
  const std::string answer = directory_.file("answer.json");
  ASSERT_EQ(run("shadows", {"--fragments", "-o", answer}).status, 0);
  expect_refused("render", {answer, "--algorithm", "both"}, {"RESULT"});
  expect_refused("render", {"--candidate", answer, "--algorithm", "both"}, {"--candidate"});
}

TEST_F(AlgorithmOptions, MethodsThatAskKernelsAreExplained) {
  for (const std::string method : {"receiver", "two-pass"}) {
    const RunResult done = run("certify", {"--kernel", "float", "--algorithm", method, "--explain",
                                           "--flips", "1", "--json", "-"});
    EXPECT_THAT(done.status, AnyOf(0, 1)) << method;
    EXPECT_EQ(done.err, "") << method;
    EXPECT_THAT(done.out, AllOf(HasSubstr("\"first_difference\": \""),
                                HasSubstr("\"decisions\": {"), HasSubstr("\"asked\": {")))
        << method;
  }
}

TEST_F(AlgorithmOptions, FlipsAreACountOfWhatIsExplained) {
  expect_refused("certify", {"--flips", "3"}, {"--flips", "--explain"});
  expect_refused("certify", {"--explain", "--flips", "-1"}, {"--flips", "-1"});
  expect_refused("certify", {"--explain", "--flips", "many"}, {"--flips", "many"});
}

TEST_F(AlgorithmOptions, StatisticsNameThePhases) {
  const RunResult contour = run("shadows", {"--stats"});
  EXPECT_THAT(contour.err, AllOf(HasSubstr("algorithm contour"), HasSubstr("intervals"),
                                 HasSubstr("by the filter 9"), HasSubstr("preparation")));
  EXPECT_EQ(contour.out, result({}));
  const RunResult sectors = run("shadows", {"--stats", "--algorithm", "sectors"});
  EXPECT_EQ(sectors.status, 0);
  EXPECT_THAT(sectors.err,
              AllOf(HasSubstr("algorithm sectors"), HasSubstr("cells"), HasSubstr("by the filter"),
                    HasSubstr("preparation"), HasSubstr("output"), HasSubstr("peak memory")));
  EXPECT_THAT(sectors.err, Not(HasSubstr("scene BSP")));
  const RunResult svbsp = run("shadows", {"--stats", "--algorithm", "svbsp"});
  EXPECT_THAT(svbsp.err, AllOf(HasSubstr("algorithm svbsp"), HasSubstr("tree nodes"),
                               HasSubstr("scene BSP: "), HasSubstr("of these scene BSP")));
  // Counting changes no answer.
  EXPECT_EQ(sectors.out, result({"--algorithm", "sectors"}));
}

TEST_F(AlgorithmOptions, AnInterruptStopsAllThreads) {
  const std::string scene = directory_.file("large.json");
  ASSERT_EQ(run_gnomon({"generate", "city", "--param", "n=20000", "-o", scene}).status, 0);
  const std::size_t before = directory_.count();
  for (const std::string jobs : {"1", "3"}) {
    RunOptions options;
    options.signal = SIGINT;
    options.signal_after = 1;
    const auto start = std::chrono::steady_clock::now();
    const RunResult done =
        run_gnomon({"shadows", scene, "--kernel", "rational", "--algorithm", "sectors", "--jobs",
                    jobs, "--fragments", "-o", directory_.file("result.json")},
                   options);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(done.status, 130) << done.err;
    EXPECT_LT(seconds.count(), 30) << jobs << " threads";
    EXPECT_EQ(directory_.count(), before);
  }
}

}  // namespace
}  // namespace gnomon::test
