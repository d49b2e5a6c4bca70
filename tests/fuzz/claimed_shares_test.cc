// SPDX-License-Identifier: GPL-3.0-or-later
// Results without fragments: fractions and areas in all their spellings.
#include "fuzz/corpus/claimed_shares.h"

#include <gtest/gtest.h>

#include "gnomon/scene/read.h"

namespace gnomon::fuzz {
namespace {

const std::string kScene = R"({ "format": "gnomon-scene", "version": 1, "name": "table",
  "vertices": [[0,0,0],[4,0,0],[4,4,0],[0,4,0],[1,1,1],[3,1,1],[3,3,1],[1,3,1]],
  "polygons": [{"id": "floor", "loop": [0,1,2,3]}, {"id": "top", "loop": [4,5,6,7]}],
  "lights": [{"id": "sun", "type": "directional", "to_light": [0,0,1]},
             {"id": "panel", "type": "area", "loop": [[1,1,2],[1,3,2],[3,3,2],[3,1,2]]}] })";

class ClaimedShares : public testing::Test {
 protected:
  void SetUp() override {
    auto read = parse_scene(kScene, "table.json");
    ASSERT_TRUE(read);
    scene_ = std::move(read->scene);
    auto prepared = prepare(scene_);
    ASSERT_TRUE(prepared);
    prepared_ = std::move(*prepared);
    auto recorded = exact_answer_of(JudgedScene(scene_, prepared_));
    ASSERT_TRUE(recorded);
    recorded_ = std::move(*recorded);
    // The floor under the panel: penumbra 6 wide, cut to 4 by 4, umbra 2 wide.
    ASSERT_EQ(*recorded_[1].sides[0].shares[2].exact, mpq_class(1, 4));
  }
  /// "" if it agrees, else what differs, or the error.
  std::string judge(const std::string& floor_in_sun, const std::string& floor_under_panel,
                    const std::string& umbra = "") {
    const std::string top = R"(, {"id": "top", "side": "front", "lit": 1}]})";
    const auto differs = compare_shares(
        R"({"lights": [{"id": "sun", "polygons": [{"id": "floor", )" + floor_in_sun + "}" + top +
            R"(, {"id": "panel", )" + umbra + R"("polygons": [{"id": "floor", )" +
            floor_under_panel + "}" + top + "]}",
        scene_, prepared_, recorded_, 1e-9);
    return differs ? *differs : "error: " + to_string(differs.error());
  }

  Scene scene_;
  PreparedScene prepared_;
  std::vector<RecordedLight> recorded_;
};

const std::string kDark = R"("lit": 0, "penumbra": 0.75, "umbra": 0.25)";

TEST_F(ClaimedShares, EverySpellingOfAShare) {
  for (const std::string floor :
       {R"("lit": 0.75, "shadow": 0.25)", R"("lit": "3/4")", R"("shadow": "2/8")",
        R"("lit": {"fraction": "3/4"}, "shadow": {"fraction": 0.25})", R"("lit": {"area": 12.0})",
        R"("side": "front", "shadow": {"area": 4})", R"("lit": 0.7500000001)"}) {
    EXPECT_EQ(judge(floor, kDark), "") << floor;
  }
  EXPECT_EQ(judge(R"("lit": 0.5)", kDark),
            "light 'sun', polygon 'floor' (front): lit 0.5 instead of 0.75");
  EXPECT_EQ(judge(R"("lit": 0.75, "shadow": 0.5)", kDark),
            "light 'sun', polygon 'floor' (front): shadow 0.5 instead of 0.25");
  EXPECT_EQ(judge(R"("side": "back", "lit": 0.75)", kDark),
            "light 'sun', polygon 'floor' (front) is missing");
  EXPECT_TRUE(judge(R"("lit": "x")", kDark).starts_with("error: "))
      << judge(R"("lit": "x")", kDark);
  EXPECT_TRUE(judge(R"("lit": {"fraction": null})", kDark).starts_with("error: "));
  EXPECT_TRUE(judge(R"("area": 16)", kDark).starts_with("error: "));
}

TEST_F(ClaimedShares, UmbraCountsOnlyIfItIsThatOfOneCaster) {
  const std::string floor = R"("lit": "3/4")", all_penumbra = R"("lit": 0, "penumbra": 1)";
  EXPECT_EQ(judge(floor, all_penumbra), "");
  EXPECT_EQ(judge(floor, kDark, R"("umbra": "per-caster", )"), "");
  EXPECT_EQ(judge(floor, all_penumbra, R"("umbra": "per-caster", )"),
            "light 'panel', polygon 'floor' (front): penumbra 1 instead of 0.75");
  EXPECT_NE(judge(floor, R"("lit": 0.5)"), "");
}

TEST_F(ClaimedShares, FragmentsAreForTheOracle) {
  EXPECT_FALSE(*has_shares_alone(R"({"lights": [{"polygons": [{"fragments": []}]}]})"));
  EXPECT_TRUE(*has_shares_alone(R"({"lights": [{"polygons": [{"lit": 1}]}]})"));
  EXPECT_FALSE(*has_shares_alone(R"({"lights": 7})"));
  EXPECT_FALSE(has_shares_alone("{"));
}

}  // namespace
}  // namespace gnomon::fuzz
