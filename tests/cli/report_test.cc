// SPDX-License-Identifier: GPL-3.0-or-later
// --report and --junit of every command that has them: the files that there are, verdicts as JUnit
// that agree with the exit status, and what a program without the page says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class ReportOf : public testing::Test {
 protected:
  /// Runs the command with --report and --junit, and expects its files.
  RunResult report(std::vector<std::string> arguments, const std::vector<std::string>& files) {
    directory_name_ = directory_.file("report");
    junit_name_ = directory_.file("junit.xml");
    for (const std::string& word :
         {std::string("--report"), directory_name_, std::string("--junit"), junit_name_}) {
      arguments.push_back(word);
    }
    const RunResult result = run_gnomon(arguments);
    for (const std::string& file : files) {
      EXPECT_THAT(in_report(file), Not(IsEmpty())) << file << '\n' << result.err;
    }
    EXPECT_EQ(in_report("junit.xml"), junit());
    // Either there is a page, or it is said that there is none, and why.
    if (std::filesystem::exists(directory_name_ + "/index.html")) {
      EXPECT_THAT(in_report("index.html"), StartsWith("<!doctype html>"));
      EXPECT_THAT(in_report("index.html"), HasSubstr("gnomon-page"));
      EXPECT_THAT(result.err, Not(HasSubstr("index.html")));
    } else {
      EXPECT_THAT(result.err, HasSubstr("built without npm"));
    }
    return result;
  }
  std::string in_report(const std::string& file) {
    const std::string path = directory_name_ + '/' + file;
    return std::filesystem::exists(path) ? read_text(path) : "";
  }
  std::string junit() { return read_text(junit_name_); }
  std::string example(const std::string& name) { return GNOMON_EXAMPLES "/" + name; }

  TestDirectory directory_;
  std::string directory_name_, junit_name_;
};

TEST_F(ReportOf, CertifyFailsItsCasesAsItsStatus) {
  const RunResult failing = report({"certify", example("courtyard.json"), "--kernel", "float"},
                                   {"table.txt", "verdict.json", "verdicts.csv", "scene.svg"});
  EXPECT_EQ(failing.status, 1);
  EXPECT_THAT(junit(), HasSubstr("failures=\"1\""));
  EXPECT_THAT(junit(), HasSubstr("polygon ground (front)"));
  EXPECT_THAT(in_report("verdicts.csv"), HasSubstr("\nfloat,float,sectors,1e-12,1,failed,"));
  // Further regions of one side are told besides the widest.
  EXPECT_THAT(in_report("verdict.json"), HasSubstr("\"others\": ["));
}

TEST_F(ReportOf, WhatNobodyAskedForFailsNothing) {
  const RunResult result = report({"certify", example("table-chair.json")}, {"verdict.json"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(junit(), HasSubstr("failures=\"0\""));
  EXPECT_THAT(junit(), HasSubstr("it does not count"));
}

TEST_F(ReportOf, ACorpusHasACaseAFileAndSubject) {
  const RunResult result = report({"certify", "--corpus", GNOMON_REGRESSIONS "/area-basic",
                                   "--kernel", "plane", "--in-process"},
                                  {"table.txt", "corpus.json", "corpus.csv"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(junit(), HasSubstr("classname=\"corpus.plane\""));
}

TEST_F(ReportOf, MeasuredRowsAreSkippedWhereARoundedKernelFails) {
  const std::vector<std::string> few = {"--kernel",    "float",   "--kernel", "plane",
                                        "--algorithm", "sectors", "--repeat", "1"};
  std::vector<std::string> words = {"tradeoff", example("courtyard.json"), "--try", "1e-12"};
  words.insert(words.end(), few.begin(), few.end());
  EXPECT_EQ(report(words, {"table.txt", "rows.json", "rows.csv", "plot.svg"}).status, 0);
  EXPECT_THAT(junit(), AllOf(HasSubstr("tests=\"2\" failures=\"0\""), HasSubstr("skipped=\"1\"")));
  words = {"extremes", "offset", "--steps", "2"};
  words.insert(words.end(), few.begin(), few.end());
  EXPECT_EQ(report(words, {"table.txt", "rows.json", "rows.csv", "plot.svg"}).status, 0);
  words = {"compare", "city", "--size", "20"};
  words.insert(words.end(), few.begin(), few.end());
  EXPECT_EQ(report(words, {"table.txt", "rows.json", "rows.csv"}).status, 0);
  EXPECT_THAT(in_report("rows.json"), HasSubstr("cpu_seconds"));
}

TEST_F(ReportOf, CampaignsNameTheCommandThatShowsAFindingAgain) {
  const RunResult result =
      report({"fuzz", "--count", "20", "--kernel", "float", "--generator", "mix"},
             {"table.txt", "campaign.json", "findings.csv"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(in_report("findings.csv"), HasSubstr("gnomon replay --generator mix --seed "));
  EXPECT_THAT(junit(), AllOf(HasSubstr("failures=\"0\""), HasSubstr("it does not count")));
  const RunResult counted = report(
      {"fuzz", "--count", "20", "--kernel", "float", "--generator", "mix", "--fail-on", "any"},
      {"table.txt"});
  EXPECT_EQ(counted.status, 1);
  EXPECT_THAT(junit(), Not(HasSubstr("failures=\"0\"")));
}

TEST_F(ReportOf, ReplayHasACaseASubject) {
  const RunResult result =
      report({"replay", example("courtyard.json"), "--kernel", "float", "--kernel", "plane"},
             {"table.txt", "case.json", "failures.csv"});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_THAT(junit(), HasSubstr("name=\"plane\"/>"));
  EXPECT_THAT(in_report("case.json"), HasSubstr("gnomon-case"));
}

TEST_F(ReportOf, AYearHasItsHours) {
  const RunResult result = report({"year", example("courtyard.json"), "--at=51.99,4.35", "--tz",
                                   "1", "--from", "06-21", "--to", "06-21"},
                                  {"hours.csv", "year.json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(in_report("hours.csv"), StartsWith("side,all,01"));
  EXPECT_THAT(in_report("year.json"), HasSubstr("\"first\": \"2025-06-21\""));
  EXPECT_THAT(result.out, HasSubstr("24 rows"));
}

TEST_F(ReportOf, ErrorsOfRunsAreExportedForVtk) {
  const std::string file = directory_.file("errors.vtp");
  const std::vector<std::string> certify = {
      "certify", example("table-chair.json"), "--kernel", "float", "--kernel", "plane", "--export"};
  const auto exported = [&](const std::string& to, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = certify;
    arguments.push_back(to);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_gnomon(arguments);
  };
  exported(file);
  EXPECT_THAT(read_text(file), AllOf(HasSubstr("Name=\"wrong_share float\""),
                                     HasSubstr("Name=\"wrong_width plane\"")));
  for (const std::string name : {"errors.glb", "errors"}) {
    const RunResult other = exported(directory_.file(name));
    EXPECT_EQ(other.status, 2);
    EXPECT_THAT(other.err, HasSubstr("expected .vtp"));
    EXPECT_FALSE(std::filesystem::exists(directory_.file(name)));
  }
  const RunResult picture = exported(file, {"--eye", "9,-7,6", "--algorithm", "zbuffer"});
  EXPECT_EQ(picture.status, 2);
  EXPECT_THAT(picture.err, HasSubstr("--export says nothing of pictures"));
}

TEST_F(ReportOf, ADirectoryThatCannotBeMadeIsSaid) {
  const std::string file = directory_.file("taken");
  write_text(file, "");
  const RunResult result =
      run_gnomon({"certify", example("table-chair.json"), "--kernel", "plane", "--report", file});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("cannot make the directory"));
}

}  // namespace
}  // namespace gnomon::test
