// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon extremes, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include "run_gnomon.h"
#include "tests/support/test_directory.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Arguments = std::vector<std::string>;

RunResult extremes(const Arguments& options, const RunOptions& how = {}) {
  Arguments arguments{"extremes"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return run_gnomon(arguments, how);
}

TEST(ExtremesCommand, FindsTheStepAtWhichDoubleFails) {
  const TestDirectory directory;
  const Arguments options{
      "gap",         "--from",   "30",       "--to",   "44",       "--steps",
      "3",           "--bisect", "--kernel", "double", "--kernel", "plane",
      "--algorithm", "sectors",  "--repeat", "1",      "--log",    directory.file("log")};
  const RunResult done = extremes(options);
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("misclassified"), HasSubstr("never"), HasSubstr("widest")));
  EXPECT_EQ(extremes(options).out, done.out);  // from the log, times too
}

TEST(ExtremesCommand, ListsItsAxes) {
  const RunResult done = extremes({"--list"});
  EXPECT_EQ(done.status, 0);
  EXPECT_THAT(done.out, AllOf(HasSubstr("near-parallel"), HasSubstr("0 to 60")));
}

TEST(ExtremesCommand, WrongWordsAreOneLine) {
  for (const Arguments& options :
       {Arguments{"nosuch"}, Arguments{"gap", "--from", "61"}, Arguments{"gap", "--steps", "0"},
        Arguments{"gap", "--kernel", "nosuch"}, Arguments{"gap", "--from", "9", "--to", "3"},
        Arguments{"gap", "--log", "/nowhere/x"}}) {
    const RunResult done = extremes(options);
    EXPECT_EQ(done.status, 2) << done.err;
    EXPECT_THAT(done.err, HasSubstr("gnomon: "));
    EXPECT_EQ(done.out, "");
  }
}

}  // namespace
}  // namespace gnomon::test
