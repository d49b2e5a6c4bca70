// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace gnomon::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ArgumentsRead read(std::vector<std::string_view> words) {
  static const std::vector<std::string_view> kParts = {"targets", "kernels", "area", "papers"};
  return read_arguments(words, kParts);
}

TEST(BenchArguments, NothingIsTheUsualExtentOfTheUsualParts) {
  const auto [arguments, complaint] = read({});
  EXPECT_EQ(complaint, "");
  EXPECT_EQ(arguments.extent, Extent::kUsual);
  EXPECT_THAT(arguments.parts, IsEmpty());
  EXPECT_EQ(arguments.against, "");
  EXPECT_FALSE(arguments.json);
  EXPECT_FALSE(arguments.help);
}

TEST(BenchArguments, WordsComeInAnyOrder) {
  const auto [arguments, complaint] =
      read({"area", "--against", "build/old/gnomon", "targets", "--short", "area"});
  EXPECT_EQ(complaint, "");
  EXPECT_EQ(arguments.extent, Extent::kShort);
  EXPECT_THAT(arguments.parts, ElementsAre("area", "targets"));
  EXPECT_TRUE(arguments.names("targets"));
  EXPECT_FALSE(arguments.names("kernels"));
  EXPECT_EQ(arguments.against, "build/old/gnomon");
  EXPECT_EQ(read({"--long"}).arguments.extent, Extent::kLong);
  EXPECT_TRUE(read({"-h"}).arguments.help);
}

TEST(BenchArguments, JsonIsOfTheTargetsAlone) {
  EXPECT_TRUE(read({"targets", "--json"}).arguments.json);
  EXPECT_EQ(read({"targets", "--json"}).complaint, "");
  EXPECT_THAT(read({"--json"}).complaint, HasSubstr("targets alone"));
  EXPECT_THAT(read({"--json", "targets", "area"}).complaint, HasSubstr("targets alone"));
}

TEST(BenchArguments, PlotsAreOfThePapers) {
  EXPECT_EQ(read({"papers", "--plots", "docs/img"}).arguments.plots, "docs/img");
  EXPECT_EQ(read({"--plots", "docs/img"}).complaint, "");  // papers are a usual part
  EXPECT_EQ(read({"--plots", "docs/img", "area"}).complaint, "--plots is of the part papers");
  EXPECT_EQ(read({"papers", "--plots"}).complaint, "--plots needs a folder");
}

TEST(BenchArguments, ComplainsOfWhatItDoesNotKnow) {
  EXPECT_EQ(read({"targets", "--fast"}).complaint, "unknown '--fast'");
  EXPECT_EQ(read({"kernel"}).complaint, "unknown 'kernel'");
  EXPECT_EQ(read({"--against"}).complaint, "--against needs a gnomon command");
  EXPECT_EQ(read({"--against", ""}).complaint, "--against needs a gnomon command");
}

}  // namespace
}  // namespace gnomon::bench
