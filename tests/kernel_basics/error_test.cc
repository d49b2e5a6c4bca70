// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/kernel/error.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(ErrorText, HasEveryPartThatIsKnown) {
  const Error error{ErrorCode::kIndex,
                    {"a.json", 3, 14, "/polygons/0/loop/2"},
                    "index 9 is outside the vertices",
                    "0 to 7"};
  EXPECT_EQ(
      to_string(error),
      "a.json:3:14: index 9 is outside the vertices; expected 0 to 7 (at /polygons/0/loop/2)");
}

TEST(ErrorText, LeavesOutWhatIsNotKnown) {
  EXPECT_EQ(to_string(Error{ErrorCode::kUsage, {}, "no scene given", ""}), "no scene given");
  EXPECT_EQ(to_string(Error{ErrorCode::kFile, {"a.obj", 0, 0, ""}, "cannot be opened", ""}),
            "a.obj: cannot be opened");
  EXPECT_EQ(to_string(Error{ErrorCode::kSyntax, {"a.obj", 7, 0, ""}, "ends early", ""}),
            "a.obj:7: ends early");
}

TEST(ErrorText, AKeyOfAFileIsNoMatterForATerminal) {
  const auto shown = [](std::string pointer) {
    return to_string(Error{ErrorCode::kFormat, {"a", 1, 2, std::move(pointer)}, "no", ""});
  };
  EXPECT_EQ(shown(std::string("/a\n\x1b[2J\0b\x7f", 10)),
            "a:1:2: no (at /a\\x0A\\x1B[2J\\x00b\\x7F)");
  EXPECT_EQ(shown("/\xC3\xA4\xC2\x9B\xC2\xA7"), "a:1:2: no (at /\xC3\xA4\\x9B\xC2\xA7)");
  EXPECT_EQ(shown("/\xC2"), "a:1:2: no (at /\xC2)");
  EXPECT_EQ(shown(std::string(5000, 'k')), "a:1:2: no (at " + std::string(200, 'k') + "...)");
}

TEST(ErrorText, FailMakesTheValue) {
  const Expected<int> answer = fail(ErrorCode::kNumber, "not a number", "digits", {"a", 1, 2, ""});
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::kNumber);
  EXPECT_EQ(to_string(answer.error()), "a:1:2: not a number; expected digits");
}

}  // namespace
}  // namespace gnomon
