// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/subject.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gnomon::fuzz {
namespace {

using testing::HasSubstr;

TEST(Subject, IsMadeAgainByItsName) {
  for (const char* name :
       {"double", "double+identity+thin", "plane/svbsp", "plane/sectors/merged", "epick+identity",
        "plane/svbsp~coplanar-in-sequence", "command:solver --quick"}) {
    const auto subject = parse_subject(name);
    ASSERT_TRUE(subject) << name;
    EXPECT_EQ(name_of(*subject), name);
    EXPECT_TRUE(*parse_subject(name_of(*subject)) == *subject) << name;
  }
}

TEST(Subject, OnlySoundExactKernelsOweTheExactAnswer) {
  EXPECT_TRUE(parse_subject("plane/svbsp")->exact());
  EXPECT_FALSE(parse_subject("plane~on-swapped")->exact());
  EXPECT_FALSE(parse_subject("double")->exact());
  EXPECT_FALSE(parse_subject("command:x")->exact());
}

TEST(Subject, ErrorsNameWhatThereIs) {
  const auto message = [](const char* name) { return to_string(parse_subject(name).error()); };
  EXPECT_THAT(message("quad"), HasSubstr("one of: float double"));
  EXPECT_THAT(message("double/bsp"), HasSubstr("sectors, contour, svbsp, receiver"));
  EXPECT_THAT(message("double/svbsp/trees"), HasSubstr("receiver, merged"));
  EXPECT_THAT(message("double/"), HasSubstr("missing"));
  EXPECT_THAT(message("double~typo"), HasSubstr("coplanar-in-sequence"));
  EXPECT_THAT(message("command:"), HasSubstr("empty command"));
}

}  // namespace
}  // namespace gnomon::fuzz
