// SPDX-License-Identifier: GPL-3.0-or-later
// Findings as folders: whole or not at all, the same bytes every time, and read back as they were.
#include "fuzz/findings/finding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "fuzz/generate/area_families.h"
#include "fuzz/generate/families.h"
#include "fuzz/shrink/shrink.h"
#include "fuzz/shrink/still_fails.h"
#include "gnomon/scene/generate.h"
#include "solve.h"
#include "tests/support/test_directory.h"

namespace gnomon::fuzz {
namespace {

namespace fs = std::filesystem;
using test::text_of;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Findings : public testing::Test {
 protected:
  /// Of the first scene of a family on which the subject fails so; not shrunken.
  static Finding found(const Family& family, const char* subject, Property property) {
    Finding finding;
    finding.check.subjects = {*parse_subject("plane"), *parse_subject(subject)};
    finding.generator = family.name;
    for (finding.case_seed = 0; finding.case_seed < 60; ++finding.case_seed) {
      finding.scene = finding.original = family.make(finding.case_seed);
      for (const Failure& failure : check_scene(finding.scene, finding.check).failures) {
        if (failure.property != property) continue;
        finding.failure = failure;
        return finding;
      }
    }
    ADD_FAILURE() << subject << " never fails on " << family.name;
    return finding;
  }
  static Finding shrunken(Finding finding) {
    ShrinkResult result = shrink(finding.original, fails_like(finding.failure, finding.check));
    finding.scene = std::move(result.scene);
    finding.locally_minimal = result.locally_minimal;
    return finding;
  }

  std::map<std::string, std::string> files(const fs::path& place) {
    std::map<std::string, std::string> texts;
    for (const auto& entry : fs::directory_iterator(place)) {
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      texts[entry.path().filename().string()] = text.str();
    }
    return texts;
  }
  fs::path written(const Finding& finding, const char* below = "findings") {
    const auto place = write_finding(folder_ / below, finding);
    EXPECT_TRUE(place) << to_string(place.error());
    return place ? *place : fs::path();
  }

  const test::TestDirectory directory_;
  const fs::path folder_ = directory_.path();
};

TEST_F(Findings, SayAllThereIsToSay) {
  Finding finding = shrunken(found(family_by_name("Needles"), "double+thin", Property::kOracle));
  finding.generator = "mix";
  finding.recipe = "needles+sliver";
  finding.campaign_seed = 7;
  finding.case_index = 123;
  const fs::path place = written(finding);
  EXPECT_EQ(place.filename(), finding_name(finding));
  EXPECT_THAT(place.filename().string(),
              StartsWith("oracle-" + finding.failure.disagreement + "-double+thin-"));
  auto texts = files(place);
  for (const char* file : {"README.md", "candidate.svg", "exact.svg", "fixture.json",
                           "original.json", "scene.json", "verdict.json"}) {
    EXPECT_NE(texts[file], "") << file;
  }
  EXPECT_EQ(texts.size(), 7u);
  const std::string& readme = texts["README.md"];
  EXPECT_THAT(readme, AllOf(HasSubstr("# double+thin: " + finding.failure.disagreement),
                            HasSubstr("locally minimal"),
                            HasSubstr("gnomon replay " + finding_name(finding)),
                            HasSubstr("case 123"), HasSubstr("`needles+sliver`")));
  // The first decision in words.
  EXPECT_THAT(readme, AllOf(HasSubstr("Decision "), HasSubstr("double+thin says "),
                            HasSubstr("exact says ")));
  EXPECT_THAT(texts["scene.json"], HasSubstr("\"fails\": \"" + finding.failure.signature() + "\""));
  EXPECT_THAT(texts["candidate.svg"], AllOf(StartsWith("<"), HasSubstr("double+thin")));
  EXPECT_THAT(texts["fixture.json"], HasSubstr("\"fractions\""));
}

TEST_F(Findings, ReadBackAndFailAgain) {
  Finding finding = shrunken(found(family_by_name("Decimals"), "epick", Property::kClaims));
  finding.check.seed = 0xffffffffffffffffu;
  finding.check.tolerance = 1.0 / 3e9;
  finding.check.width = 1e-300;
  finding.case_seed = 0xfedcba9876543210u;
  const auto read = read_finding(written(finding));
  ASSERT_TRUE(read) << to_string(read.error());
  EXPECT_EQ(fingerprint_of(read->scene), fingerprint_of(finding.scene));
  EXPECT_EQ(text_of(read->original), text_of(finding.original));
  EXPECT_TRUE(read->failure.alike(finding.failure));
  EXPECT_EQ(read->check.subjects, narrowed(finding.check, finding.failure).subjects);
  EXPECT_EQ(read->check.properties, std::vector{finding.failure.property});
  EXPECT_EQ(read->check.seed, finding.check.seed);
  EXPECT_EQ(read->check.tolerance, finding.check.tolerance);
  EXPECT_EQ(read->check.width, finding.check.width);
  EXPECT_EQ(read->case_seed, finding.case_seed);
  EXPECT_EQ(read->generator, finding.generator);
  EXPECT_EQ(read->locally_minimal, finding.locally_minimal);
  EXPECT_NE(check_scene(read->scene, read->check).find(read->failure), nullptr);
  // What was read is the same finding, byte for byte.
  EXPECT_EQ(finding_name(*read), finding_name(finding));
}

/// A subject that makes pictures has no fragments to be painted.
TEST_F(Findings, OfPicturesSayWhyThereIsNoAnswerToShow) {
  const Finding finding =
      found(family_by_name("Lattice"), "plane/shadow-polygons~eye-always-lit", Property::kOracle);
  auto texts = files(written(finding));
  EXPECT_THAT(texts["README.md"], HasSubstr("makes no fragments"));
  EXPECT_NE(texts["scene.json"], "");
  EXPECT_EQ(texts.count("candidate.svg"), 0u);
}

TEST_F(Findings, AreTheSameBytesEveryTimeAndOneFolder) {
  const Finding finding = shrunken(found(family_by_name("Grazing"), "float", Property::kOracle));
  const fs::path one = written(finding, "one"), two = written(finding, "two");
  EXPECT_EQ(files(one), files(two));
  // Found again by another seed: still one, and as it was.
  Finding again = finding;
  again.case_seed += 1;
  again.original = finding.scene;
  const auto before = files(one);
  EXPECT_EQ(written(again, "one"), one);
  EXPECT_EQ(files(one), before);
  // Nothing half-written is left beside it.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "one"), fs::directory_iterator()), 1);
  // Another subject on the same scene is another finding.
  again.failure.subject = "double";
  EXPECT_NE(finding_name(again), finding_name(finding));
}

TEST_F(Findings, AreaLightsHaveAPlaceAndDecisions) {
  const Finding finding = shrunken(found(area_families().front(), "float", Property::kOracle));
  auto texts = files(written(finding));
  EXPECT_THAT(texts["README.md"],
              AllOf(HasSubstr("## The first decision that differs"),
                    HasSubstr("Every decision of the run agrees with the exact one"),
                    HasSubstr("| worst place | light ")));
  EXPECT_NE(texts["candidate.svg"], "");
}

TEST_F(Findings, WhatCrashedIsNotRunAgainHere) {
  Finding finding;
  finding.scene = finding.original = *generate("table-chair");
  finding.check.subjects = {*parse_subject("double")};
  finding.failure = {Property::kCrash, "double", "signal 11", {}, {}, "subject double: signal 11"};
  finding.check.stage = [](std::string_view) { FAIL() << "a check was run"; };
  auto texts = files(written(finding));
  EXPECT_EQ(texts.count("candidate.svg"), 0u);
  EXPECT_NE(texts["exact.svg"], "");
  EXPECT_THAT(texts["README.md"], AllOf(HasSubstr("double gave no answer (signal 11)"),
                                        HasSubstr("not run again here")));
}

TEST_F(Findings, MistakesSayWhatIsWrongOnPurpose) {
  Finding finding;
  finding.scene = finding.original = *generate("table-chair");
  finding.check.subjects = {*parse_subject("plane~on-swapped")};
  finding.failure = {Property::kOracle, "plane~on-swapped", "misclassified", {}, {}, "found lit"};
  auto texts = files(written(finding));
  EXPECT_THAT(texts["README.md"], HasSubstr("wrong on purpose (on-swapped)"));
}

TEST_F(Findings, NamesAreFitForEveryFileSystem) {
  Finding finding;
  finding.failure = {
      Property::kOracle, "command:../my solver --x='y' | tee /tmp/z", "missing", {}, {}, {}};
  const std::string name = finding_name(finding);
  EXPECT_EQ(name.find_first_of("/ '|:=\\"), std::string::npos) << name;
  EXPECT_LT(name.size(), 100u);
}

TEST_F(Findings, BrokenOnesAreErrorsWithAPlace) {
  EXPECT_EQ(read_finding(folder_ / "none").error().code, ErrorCode::kFile);
  const fs::path place =
      written(shrunken(found(family_by_name("Grazing"), "float", Property::kOracle)));
  const std::string good = files(place)["verdict.json"];
  const auto with = [&](const std::string& text) {
    std::ofstream(place / "verdict.json") << text;
    const auto read = read_finding(place);
    return read ? std::string("read") : to_string(read.error());
  };
  EXPECT_EQ(with(good), "read");
  EXPECT_THAT(with(good.substr(0, good.size() / 2)), HasSubstr("verdict.json:"));
  EXPECT_THAT(with("[]"), HasSubstr("not an object"));
  EXPECT_THAT(with("{\"format\": \"gnomon-finding\", \"version\": 2}"), HasSubstr("version 1"));
  std::string other = good;
  other.replace(other.find("\"float\""), 7, "\"quad!\"");
  other.replace(other.find("\"float\""), 7, "\"quad!\"");
  EXPECT_THAT(with(other), HasSubstr("quad!"));
  other = good;
  other.replace(other.find("\"tolerance\""), 11, "\"tolerances\"");
  EXPECT_THAT(with(other), HasSubstr("/check/tolerance"));
}

TEST_F(Findings, AFolderThatCannotBeMadeIsAnError) {
  std::ofstream(folder_ / "file") << "x";
  Finding finding;
  finding.scene = finding.original = *generate("table-chair");
  const auto place = write_finding(folder_ / "file" / "below", finding);
  ASSERT_FALSE(place);
  EXPECT_EQ(place.error().code, ErrorCode::kFile);
}

}  // namespace
}  // namespace gnomon::fuzz
