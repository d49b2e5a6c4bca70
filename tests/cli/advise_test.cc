// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon advise, as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

RunResult advise(std::vector<std::string> options) {
  options.insert(options.begin(), "advise");
  return run_gnomon(options);
}

TEST(Advise, FiveLinesThatSayWhatIsProven) {
  const RunResult done = advise({std::string(GNOMON_EXAMPLES) + "/hair.json"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(std::ranges::count(done.out, '\n'), 5);
  // A hair of 1e-10 is closed by planes of 1e-9.
  EXPECT_THAT(done.out, AllOf(HasSubstr("proven by the oracle"), HasSubstr("plane by"),
                              HasSubstr("bits a coordinate"), HasSubstr("1e-09 wrong"),
                              HasSubstr("gnomon shadows ")));
}

TEST(Advise, WhereDoubleIsWrongItSaysSo) {
  const RunResult done = advise({"extreme:offset:40"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("Right:     plane by"), HasSubstr("0 wrong")));
}

TEST(Advise, LargeScenesAreJudgedByPoints) {
  const RunResult done = advise({"city:n=20", "--certify-up-to", "10"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("not proven: exact points were right"));
}

TEST(Advise, WrongWordsAreOneLine) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{},
                                                  {"nosuch-scene"},
                                                  {"city", "--tolerance", "2"},
                                                  {"city", "--budget", "soon"}}) {
    const RunResult done = advise(options);
    EXPECT_EQ(done.status, 2) << done.err;
    EXPECT_EQ(done.out, "");
  }
}

}  // namespace
}  // namespace gnomon::test
