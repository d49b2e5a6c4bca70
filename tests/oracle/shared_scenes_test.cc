// SPDX-License-Identifier: GPL-3.0-or-later
// Real scenes, where they are at hand: the prepared scene holds, regions agree with the visibility
// of exact points and with the checker of claims, and the overlay calls them identical.
#include <gtest/gtest.h>

#include <filesystem>

#include "gnomon/oracle/prepared_check.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/oracle/witness_check.h"
#include "gnomon/scene/read.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

std::optional<BuiltScene> load(const std::filesystem::path& path) {
  if (std::string(GNOMON_SHARED_SCENES).empty() || !std::filesystem::exists(path)) {
    return std::nullopt;
  }
  Expected<ReadResult> read = read_scene(path);
  EXPECT_TRUE(read.has_value()) << to_string(read.error());
  Expected<PreparedScene> prepared = prepare(read->scene);
  EXPECT_TRUE(prepared.has_value()) << to_string(prepared.error());
  return BuiltScene{std::move(read->scene), std::move(*prepared)};
}

std::filesystem::path json_folder() { return std::filesystem::path(GNOMON_SHARED_SCENES) / "json"; }

TEST(SharedScenes, EastWallAtTheFirstSun) {
  const std::optional<BuiltScene> built = load(json_folder() / "ashrae140-case630.json");
  if (!built) GTEST_SKIP() << "no shared scenes";
  const ExactAnswer answer(built->scene, built->prepared);
  for (const AnswerEntry& entry : answer.entries(0)) {
    if (built->scene.polygons[entry.polygon].id != "ZONE SURFACE EAST") continue;
    EXPECT_EQ(*answer.fractions(0, entry).lit.exact, mpq_class(97, 147));
    return;
  }
  FAIL() << "no east wall";
}

TEST(SharedScenes, AllWaysAgree) {
  if (std::string(GNOMON_SHARED_SCENES).empty() || !std::filesystem::exists(json_folder())) {
    GTEST_SKIP() << "no shared scenes";
  }
  for (const auto& file : std::filesystem::directory_iterator(json_folder())) {
    if (file.path().extension() != ".json") continue;
    const std::optional<BuiltScene> built = load(file.path());
    // The candidate made here is as simple as it is slow.
    if (!built || built->prepared.parts.size() > 120) continue;
    SCOPED_TRACE(file.path().filename().string());
    const std::vector<PreparedFinding> findings = check_prepared(built->scene, built->prepared);
    EXPECT_TRUE(findings.empty()) << findings[0].polygon << ": " << findings[0].text;
    const ExactAnswer answer(built->scene, built->prepared);
    Claims candidate = exact_candidate(answer);
    std::erase_if(candidate.lights,
                  [](const ClaimedLight& light) { return light.polygons.empty(); });
    const Report report = *certify(answer, candidate, {});
    EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
    CertifyOptions by_points;
    by_points.most_pairs = 0;
    const Report points = *certify(answer, candidate, by_points);
    EXPECT_EQ(points.points_wrong, 0u) << points.reason;
    EXPECT_GT(points.points_checked, 0u);
    const WitnessReport claims = check_witnesses(built->scene, built->prepared, candidate);
    EXPECT_EQ(claims.violations, 0u)
        << claims.findings[0].polygon << " " << claims.findings[0].text;
  }
}

}  // namespace
}  // namespace gnomon::oracle
