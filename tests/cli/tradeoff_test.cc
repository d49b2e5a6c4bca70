// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon tradeoff, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "run_gnomon.h"
#include "tests/support/test_directory.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Arguments = std::vector<std::string>;

RunResult tradeoff(const Arguments& options, const RunOptions& how = {}) {
  Arguments arguments{"tradeoff"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_gnomon(arguments, how);
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Tradeoff, EveryKernelThicknessAndMethodWithAFront) {
  const TestDirectory directory;
  const std::string json = directory.file("rows.json"), csv = directory.file("rows.csv"),
                    plot = directory.file("rows.svg");
  const RunResult done =
      tradeoff({"city:n=3", "--algorithm", "sectors",  "--algorithm", "svbsp", "--kernel", "float",
                "--kernel", "double",      "--kernel", "plane",       "--try", "0",        "--try",
                "1e-12",    "--try",       "1e-3",     "--repeat",    "1",     "--json",   json,
                "--csv",    csv,           "--plot",   plot});
  EXPECT_EQ(done.status, 0) << done.err;  // float fails, which is the subject
  EXPECT_THAT(done.out, AllOf(HasSubstr("identical"), HasSubstr("worst share"), HasSubstr("*")));
  rapidjson::Document rows;
  rows.Parse(text_of(json).c_str());
  ASSERT_FALSE(rows.HasParseError());
  EXPECT_STREQ(rows["format"].GetString(), "gnomon-tradeoff");
  EXPECT_EQ(rows["rows"].Size(), 14u);  // of two methods: twice three thicknesses, and plane
  bool front = false;
  for (const auto& row : rows["rows"].GetArray()) front = front || row["on_front"].GetBool();
  EXPECT_TRUE(front);
  EXPECT_EQ(rows["thickness"].Size(), 4u);
  const std::string lines = text_of(csv);
  EXPECT_EQ(std::ranges::count(lines, '\n'), 15);
  EXPECT_THAT(text_of(plot), AllOf(HasSubstr("<svg"), HasSubstr("</svg>"), HasSubstr("double")));
}

TEST(Tradeoff, ThicknessesOfAFolder) {
  const TestDirectory directory;
  for (const char* name : {"pinwheel.json", "hair.json"}) {
    std::filesystem::copy_file(std::string(GNOMON_EXAMPLES) + '/' + name, directory.file(name));
  }
  std::ofstream(directory.file("other.json")) << "{}";
  const RunResult done = tradeoff({directory.path().string(), "--thickness", "--algorithm",
                                   "sectors", "--try", "1e-12", "--try", "1e-6"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("best single thickness 1e-12"), HasSubstr("2 of 2")));
  EXPECT_THAT(done.err, HasSubstr("1 of 3 files are left out"));
}

TEST(Tradeoff, Invariances) {
  const RunResult done = tradeoff({"city:n=3", "--invariances", "--algorithm", "sectors",
                                   "--kernel", "double", "--kernel", "plane"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("axes yzx"), HasSubstr("mirror"), HasSubstr("plane")));
}

TEST(Tradeoff, ALogIsGoneOnWith) {
  const TestDirectory directory;
  const std::string log = directory.file("runs.log");
  const Arguments options{"city:n=2", "--algorithm", "sectors", "--kernel", "plane",
                          "--repeat", "1",           "--log",   log};
  const RunResult first = tradeoff(options);
  EXPECT_EQ(first.status, 0) << first.err;
  const std::string before = text_of(log);
  EXPECT_EQ(tradeoff(options).out, first.out);
  EXPECT_EQ(text_of(log), before);
  std::ofstream(log) << "nonsense\n";
  const RunResult wrong = tradeoff(options);
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("line 1"));
}

TEST(Tradeoff, WrongWordsAreOneLine) {
  for (const Arguments& options :
       {Arguments{"nosuch-scene"}, Arguments{"city", "--try", "-1"},
        Arguments{"city", "--try", "x"}, Arguments{"city", "--kernel", "nosuch"},
        Arguments{"city", "--algorithm", "nosuch"}, Arguments{"city", "--change", "nosuch"},
        Arguments{"city", "--thickness", "--invariances"}, Arguments{}}) {
    const RunResult done = tradeoff(options);
    EXPECT_EQ(done.status, 2) << done.err;
    EXPECT_THAT(done.err, HasSubstr("gnomon: "));
    EXPECT_EQ(done.out, "");
  }
}

}  // namespace
}  // namespace gnomon::test
