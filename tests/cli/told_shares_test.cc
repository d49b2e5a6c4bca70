// SPDX-License-Identifier: GPL-3.0-or-later
// Candidates that tell shares without fragments, and fragments with holes, through every command
// that judges them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A shade over a quarter of a floor.
constexpr const char* kRing = R"({ "format": "gnomon-scene", "version": 1, "name": "ring",
  "numbers": "decimal",
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[3,1,1],[3,3,1],[1,3,1]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "shade", "loop": [4,5,6,7]}],
  "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]}] })";

class ToldSharesCommand : public testing::Test {
 protected:
  void SetUp() override { write_text(scene_, kRing); }

  RunResult certify(const std::string& polygons, std::vector<std::string> options = {}) {
    const std::string file = directory_.file("candidate.json");
    write_text(file, R"({"lights": [{"id": "sun", "polygons": [)" + polygons + "]}]}");
    options.insert(options.begin(), {"certify", scene_, "--candidate", file});
    return run_gnomon(options);
  }

  TestDirectory directory_;
  const std::string scene_ = directory_.file("ring.json");
};

TEST_F(ToldSharesCommand, HolesOfFragmentsAreHonoured) {
  const std::string shade =
      R"(, {"id": "shade", "fragments": [{"class": "lit", "loop": [[1,1,1],[3,1,1],[3,3,1],[1,3,1]]}]})";
  const auto floor = [](const std::string& holes) {
    return R"({"id": "floor", "fragments": [{"class": "lit",
               "loop": [[0,0,0],[4,0,0],[4,4,0],[0,4,0]], "holes": [)" +
           holes + R"(]}, {"class": "shadow", "loop": [[1,1,0],[3,1,0],[3,3,0],[1,3,0]]}]})";
  };
  for (const std::string hole :
       {"[[1,1,0],[1,3,0],[3,3,0],[3,1,0]]", "[[1,1,0],[3,1,0],[3,3,0],[1,3,0]]"}) {
    const RunResult run = certify(floor(hole) + shade);
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_THAT(run.out, HasSubstr("Identical to the exact answer"));
  }
  for (const std::string hole : {"", "[[1,1,0],[1,3,0],[2,3,0],[2,1,0]]"}) {
    EXPECT_EQ(certify(floor(hole) + shade).status, 1);
  }
}

TEST_F(ToldSharesCommand, AreJudgedByCertify) {
  const RunResult right = certify(R"({"id": "floor", "lit": 0.75}, {"id": "shade", "lit": 1})");
  EXPECT_EQ(right.status, 0) << right.out << right.err;
  EXPECT_THAT(right.out, HasSubstr("shares agree"));
  EXPECT_THAT(right.out, HasSubstr("half a unit of the last digit"));
  EXPECT_THAT(right.out, Not(HasSubstr("Identical")));
  const RunResult part = certify(R"({"id": "floor", "lit": {"fraction": "3/4"}})", {"--subset"});
  EXPECT_EQ(part.status, 0) << part.out << part.err;

  const RunResult wrong =
      certify(R"({"id": "floor", "lit": 0.74}, {"id": "shade", "lit": 1})", {"--json", "-"});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.out, HasSubstr(R"("verdict": "failed")"));
  EXPECT_THAT(wrong.out, HasSubstr("lit told as 0.74, truly 3/4"));
  EXPECT_THAT(wrong.out, HasSubstr(R"("share_tolerance": "digits")"));
  const RunResult asked = certify(R"({"id": "floor", "lit": 0.74}, {"id": "shade", "lit": 1})",
                                  {"--tolerance", "0.02"});
  EXPECT_EQ(asked.status, 0) << asked.out;
  const RunResult missing = certify(R"({"id": "floor", "lit": 0.75})");
  EXPECT_EQ(missing.status, 1);
  EXPECT_THAT(missing.out, HasSubstr("polygon 'shade' (front) is missing"));
}

TEST_F(ToldSharesCommand, OurOwnResultWithoutFragmentsIsOne) {
  const std::string file = directory_.file("own.json");
  for (const std::string option : {"--exact-fractions", "--algorithm=contour"}) {
    ASSERT_EQ(run_gnomon({"shadows", scene_, option, "-o", file}).status, 0);
    const RunResult run = run_gnomon({"certify", scene_, "--candidate", file});
    EXPECT_EQ(run.status, 0) << run.out << run.err;
    EXPECT_THAT(run.out, HasSubstr("shares agree"));
  }
}

TEST_F(ToldSharesCommand, FormsThatAreNotKnownAreNamed) {
  const RunResult run = certify(R"({"id": "floor", "sunlit": 0.75})");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err,
              HasSubstr("an object with \"id\", \"sunlit\" has neither fragments nor shares"));
}

TEST_F(ToldSharesCommand, AreJudgedInCampaignsAndReplays) {
  if (std::system("python3 -c ''") != 0) GTEST_SKIP() << "no python3";
  const std::string program = std::string("python3 ") + GNOMON_EXAMPLES + "/shadows.py";
  const RunResult campaign = run_gnomon(
      {"fuzz", "--candidate-command", program, "--count", "12", "--seconds", "60", "--jobs", "2"});
  EXPECT_EQ(campaign.status, 0) << campaign.err;
  EXPECT_THAT(campaign.out, HasSubstr("every property held"));
  EXPECT_EQ(run_gnomon({"replay", scene_, "--candidate-command", program}).status, 0);
  // A shadow of another size.
  const RunResult wrong = run_gnomon(
      {"replay", scene_, "--candidate-command", program + " \"$1\" | sed 's:3/4:2/3:' && :"});
  EXPECT_EQ(wrong.status, 1) << wrong.out << wrong.err;
  EXPECT_THAT(wrong.out, HasSubstr("oracle:misclassified"));
}

}  // namespace
}  // namespace gnomon::test
