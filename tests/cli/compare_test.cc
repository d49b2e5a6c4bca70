// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon compare, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <csignal>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using Arguments = std::vector<std::string>;

RunResult compare(const Arguments& options, const RunOptions& how = {}) {
  Arguments arguments{"compare"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_gnomon(arguments, how);
}

rapidjson::Document parsed(const std::string& text) {
  rapidjson::Document document;
  document.Parse(text.c_str());
  EXPECT_FALSE(document.HasParseError()) << text.substr(0, 200);
  return document;
}

TEST(Compare, OneTableWithVerdictsRatiosAndGrowth) {
  const RunResult done =
      compare({"city", "--size", "30", "--size", "60", "--algorithm", "svbsp", "--algorithm",
               "tiling:tiles=16", "--repeat", "1", "--commands", "--counters"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.err, "");
  EXPECT_THAT(done.out,
              AllOf(HasSubstr("verdict"), HasSubstr("identical"), HasSubstr("within tolerance"),
                    HasSubstr("1x"), HasSubstr("n^"), HasSubstr("tile writes")));
  EXPECT_THAT(done.out, HasSubstr("gnomon compare city --size 60 --algorithm tiling:tiles=16 "
                                  "--kernel plane --repeat 1"));
}

TEST(Compare, EverySystemOnEveryKernelByDefaultAndByAll) {
  const RunResult done = compare({"figure-4f", "--kernel", "all", "--repeat", "1", "--csv", "-"});
  EXPECT_EQ(done.status, 0) << done.err;
  // Three methods for area lights on seven kernels, and the header.
  EXPECT_EQ(std::ranges::count(done.out, '\n'), 22);
  EXPECT_THAT(done.out, AllOf(HasSubstr(",merged,rational,measured,"), HasSubstr("identical"),
                              Not(HasSubstr("svbsp"))));
}

TEST(Compare, JsonIsStableAndHasNoTimesUnlessAsked) {
  const Arguments options{"lattice:n=6", "tetra",  "--size", "70",          "--repeat",
                          "1",           "--json", "-",      "--algorithm", "all"};
  const RunResult done = compare(options);
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(compare(options).out, done.out);
  const rapidjson::Document document = parsed(done.out);
  EXPECT_STREQ(document["format"].GetString(), "gnomon-comparison");
  EXPECT_EQ(document["contradictions"].Size(), 0u);
  const auto& row = document["rows"][0];
  EXPECT_STREQ(row["scene"].GetString(), "lattice:n=6");
  EXPECT_TRUE(row["size"].IsNull());
  EXPECT_TRUE(row.HasMember("checksum") && row.HasMember("verdict") && row.HasMember("command"));
  EXPECT_FALSE(row.HasMember("cpu_seconds"));
  Arguments with_times = options;
  with_times.emplace_back("--times");
  const rapidjson::Document timed = parsed(compare(with_times).out);
  EXPECT_GT(timed["rows"][0]["cpu_seconds"].GetDouble(), 0);
  EXPECT_TRUE(timed.HasMember("growth"));
}

TEST(Compare, WhatARowNeedsAndDoesNotGetIsARow) {
  const RunResult refused = compare({"figure-4f", "--algorithm", "basic", "--kernel", "plane"});
  EXPECT_EQ(refused.status, 0) << refused.err;
  EXPECT_THAT(refused.out, HasSubstr("refused: it takes no area lights"));
  const RunResult time = compare({"quads", "--size", "20000", "--algorithm", "basic", "--kernel",
                                  "rational", "--time", "0.3"});
  EXPECT_EQ(time.status, 0) << time.err;
  EXPECT_THAT(time.out, HasSubstr("time limit: no end within 0.3 s"));
}

TEST(Compare, MemoryIsLimited) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "no address space is left to limit";
#else
  const RunResult done = compare(
      {"quads", "--size", "60000", "--algorithm", "svbsp", "--kernel", "double", "--memory", "20"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("memory limit: more than 20 MB"));
#endif
}

TEST(Compare, WrongWordsAreRefusedInOneLine) {
  for (const Arguments& options :
       {Arguments{"castle"}, Arguments{"city", "--algorithm", "magic"},
        Arguments{"city", "--kernel", "magic"}, Arguments{"city", "--size", "0"},
        Arguments{"city:n=0"}, Arguments{"city", "--time", "soon"}, Arguments{}}) {
    const RunResult done = compare(options);
    EXPECT_EQ(done.status, 2) << (options.empty() ? "" : options.back());
    EXPECT_EQ(done.out, "");
    EXPECT_THAT(done.err, StartsWith("gnomon: "));
    EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
  }
}

TEST(Compare, AnInterruptWritesWhatIsDone) {
  const TestDirectory directory;
  RunOptions how;
  how.signal = SIGINT;
  how.signal_after = 1.5;
  const RunResult done = compare(
      {"quads", "--size", "100", "--size", "30000", "--kernel", "double", "--kernel", "rational",
       "--algorithm", "svbsp", "--certify-up-to", "0", "--json", directory.file("table.json")},
      how);
  EXPECT_EQ(done.status, 130) << done.err;
  EXPECT_THAT(done.out, HasSubstr("Interrupted"));
  const rapidjson::Document document = parsed(read_text(directory.file("table.json")));
  EXPECT_TRUE(document["interrupted"].GetBool());
  EXPECT_GE(document["rows"].Size(), 1u);
  EXPECT_LT(document["rows"].Size(), 4u);
}

}  // namespace
}  // namespace gnomon::test
