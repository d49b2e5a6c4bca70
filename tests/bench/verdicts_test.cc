// SPDX-License-Identifier: GPL-3.0-or-later
#include "verdicts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace gnomon::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::string printed(const Verdicts& verdicts) {
  testing::internal::CaptureStdout();
  verdicts.print();
  return testing::internal::GetCapturedStdout();
}

/// The line of the table that begins with `work`, its cells between single blanks.
std::vector<std::string> cells(const std::string& text, const std::string& work) {
  const std::size_t begin = text.find("\n" + work) + 1;
  std::string line = text.substr(begin, text.find('\n', begin) - begin);
  std::vector<std::string> found;
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t gap = std::min(line.find("  ", at), line.size());
    found.push_back(line.substr(at, gap - at));
    at = std::min(line.find_first_not_of(' ', gap), line.size());
  }
  return found;
}

TEST(BenchVerdicts, SaysMetOrByWhatItIsMissed) {
  Verdicts verdicts("Targets", {"measured"});
  verdicts.add("fast", "quads", at_least(5), {6.25});
  verdicts.add("equal", "quads", at_least(5), {5});
  verdicts.add("slow", "quads", at_least(5), {4}, "2 ms -> 1 ms");
  verdicts.add("near", "city", at_most(1.15), {1.15});
  verdicts.add("far", "city", at_most(0.2, Unit::kShare), {0.5});
  verdicts.add("long", "city", at_most(30, Unit::kSeconds), {45});
  verdicts.add("none", "city", at_most(0.3, Unit::kGigabytes), {kNothing}, "why");
  const std::string text = printed(verdicts);
  EXPECT_THAT(text, HasSubstr("\nTargets\nwork"));
  EXPECT_THAT(cells(text, "fast"), ElementsAre("fast", "quads", "at least 5x", "6.25x", "met"));
  EXPECT_THAT(cells(text, "equal"), ElementsAre("equal", "quads", "at least 5x", "5.00x", "met"));
  EXPECT_THAT(cells(text, "slow"), ElementsAre("slow", "quads", "at least 5x", "4.00x",
                                               "missed by 1.25x", "2 ms -> 1 ms"));
  EXPECT_THAT(cells(text, "near"), ElementsAre("near", "city", "at most 1.15x", "1.15x", "met"));
  EXPECT_THAT(cells(text, "far"),
              ElementsAre("far", "city", "at most 20 %", "50.0 %", "missed by 2.50x"));
  EXPECT_THAT(cells(text, "long"),
              ElementsAre("long", "city", "at most 30 s", "45.0 s", "missed by 1.50x"));
  EXPECT_THAT(cells(text, "none"),
              ElementsAre("none", "city", "at most 0.3 GB", "-", "not measured", "why"));
}

TEST(BenchVerdicts, JudgesTheColumnThatItIsTold) {
  Verdicts verdicts("Targets", {"sectors", "svbsp"}, 1);
  verdicts.add("ratio", "quads", at_least(2), {1, 3});
  EXPECT_THAT(cells(printed(verdicts), "ratio"),
              ElementsAre("ratio", "quads", "at least 2x", "1.00x", "3.00x", "met"));
}

TEST(BenchVerdicts, JsonHasEveryRow) {
  Verdicts verdicts("Targets", {"measured"});
  verdicts.add("a \"row\"", "quads", at_least(5), {4}, "note");
  verdicts.add("none", "city", at_most(1.15), {kNothing});
  rapidjson::Document rows;
  rows.Parse(verdicts.json().c_str());
  ASSERT_TRUE(rows.IsArray());
  ASSERT_EQ(rows.Size(), 2u);
  EXPECT_STREQ(rows[0]["work"].GetString(), "a \"row\"");
  EXPECT_STREQ(rows[0]["target"].GetString(), "at least 5x");
  EXPECT_EQ(rows[0]["limit"].GetDouble(), 5);
  EXPECT_TRUE(rows[0]["at_least"].GetBool());
  EXPECT_STREQ(rows[0]["unit"].GetString(), "ratio");
  EXPECT_EQ(rows[0]["measured"]["measured"].GetDouble(), 4);
  EXPECT_FALSE(rows[0]["met"].GetBool());
  EXPECT_STREQ(rows[0]["note"].GetString(), "note");
  EXPECT_TRUE(rows[1]["measured"]["measured"].IsNull());
  EXPECT_TRUE(rows[1]["met"].IsNull());
}

}  // namespace
}  // namespace gnomon::bench
