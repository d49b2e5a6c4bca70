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

TEST(ErrorText, FailMakesTheValue) {
  const Expected<int> answer = fail(ErrorCode::kNumber, "not a number", "digits", {"a", 1, 2, ""});
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::kNumber);
  EXPECT_EQ(to_string(answer.error()), "a:1:2: not a number; expected digits");
}

}  // namespace
}  // namespace gnomon
