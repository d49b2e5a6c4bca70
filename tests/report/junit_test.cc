// SPDX-License-Identifier: GPL-3.0-or-later
// JUnit XML: well-formed whatever the texts hold, and counts that agree with the cases.
#include "report/junit/junit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace gnomon::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string junit_of(const std::vector<JUnitCase>& cases) {
  StringSink sink;
  write_junit(sink, "gnomon certify", cases);
  return sink.text();
}

TEST(JUnit, HasACaseAVerdictAndCountsThem) {
  const std::string text =
      junit_of({{"certify.room", "plane", JUnitOutcome::kPassed, {}, {}},
                {"certify.room", "double", JUnitOutcome::kFailed, "wrong", "at"},
                {"certify.room", "epick", JUnitOutcome::kError, "stopped", {}},
                {"certify.room", "float", JUnitOutcome::kSkipped, "no", {}}});
  EXPECT_THAT(text, HasSubstr("<testsuite name=\"gnomon certify\" tests=\"4\" failures=\"1\" "
                              "errors=\"1\" skipped=\"1\">"));
  EXPECT_THAT(text, HasSubstr("<testcase classname=\"certify.room\" name=\"plane\"/>"));
  EXPECT_THAT(text, HasSubstr("<failure message=\"wrong\">at</failure>"));
  EXPECT_THAT(text, HasSubstr("<error message=\"stopped\"></error>"));
  EXPECT_THAT(text, HasSubstr("<skipped message=\"no\"></skipped>"));
}

TEST(JUnit, IsWellFormedWhateverTheTextsHold) {
  const std::string text =
      junit_of({{"a<b", "\"&\"\n", JUnitOutcome::kFailed, "]]>\x01", "\xff\xC3\xA9\xEF\xBF\xBF"}});
  EXPECT_THAT(text, HasSubstr("classname=\"a&lt;b\" name=\"&quot;&amp;&quot;&#10;\""));
  EXPECT_THAT(text, HasSubstr("message=\"]]&gt;\xEF\xBF\xBD\""));
  // A broken byte, a whole character, and one that XML has not.
  EXPECT_THAT(text, HasSubstr(">\xEF\xBF\xBD\xC3\xA9\xEF\xBF\xBD<"));
  EXPECT_THAT(text, Not(HasSubstr("\x01")));
}

}  // namespace
}  // namespace gnomon::report
