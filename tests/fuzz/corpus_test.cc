// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes of tests/regressions (docs/corpus.md): exact kernels by all algorithms and the oracle
// say what is recorded, every rounded kernel gets the y_ ones right, and on the i_ ones those
// differ that are recorded to: when one turns right, the list is out of date
// (`gnomon certify --corpus tests/regressions --record`).
#include "fuzz/corpus/corpus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string_view>

#include "area_check.h"
#include "exact_check.h"
#include "fuzz/check/check.h"
#include "fuzz/corpus/corpus_judge.h"
#include "fuzz/kinds/kind_predicates.h"
#include "fuzz/scene/kinds.h"
#include "gnomon/scene/read.h"
#include "report/sides/polygon_sides.h"

namespace gnomon::fuzz {
namespace {

using test::Case;

const std::vector<Fixture>& corpus() {
  static const std::vector<Fixture> fixtures = [] {
    auto read = read_corpus(GNOMON_REGRESSIONS);
    if (!read) throw std::runtime_error(to_string(read.error()));
    return std::move(*read);
  }();
  return fixtures;
}

std::vector<const Fixture*> fixtures_of(bool rejected) {
  std::vector<const Fixture*> some;
  for (const Fixture& fixture : corpus()) {
    if ((fixture.expectation == Expectation::kReject) == rejected) some.push_back(&fixture);
  }
  return some;
}

std::set<std::string> kinds_of_scenes() {
  std::set<std::string> kinds;
  for (const Fixture* fixture : fixtures_of(false)) kinds.insert(fixture->kind);
  return kinds;
}

/// One test a kind, for all its scenes.
class CorpusKind : public testing::TestWithParam<std::string> {
 protected:
  template <class Check>
  void for_each_scene(const Check& check) {
    for (const Fixture* fixture : fixtures_of(false)) {
      if (fixture->kind != GetParam()) continue;
      SCOPED_TRACE(fixture->name);
      std::string why;
      const auto scene = Case::make(fixture->scene, &why);
      ASSERT_TRUE(scene) << why;
      check(*fixture, *scene);
    }
  }
};

bool has_area_light(const Fixture& fixture) {
  return std::ranges::any_of(fixture.scene.lights,
                             [](const Light& light) { return light.has_area(); });
}

TEST_P(CorpusKind, ExactResultsWrittenAsDoublesPassBothJudges) {
  CheckOptions options;
  options.subjects = {*parse_subject("plane")};
  options.properties = {Property::kWritten};
  for_each_scene([&](const Fixture& fixture, const Case&) {
    const CaseReport report = check_scene(fixture.scene, options);
    for (const Failure& failure : report.failures) {
      ADD_FAILURE() << failure.signature() << ": " << failure.text;
    }
  });
}

TEST_P(CorpusKind, ExactKernelsAndOracleAgree) {
  for_each_scene([](const Fixture& fixture, const Case& scene) {
    EXPECT_EQ(test::check_exact(scene), "");
    if (has_area_light(fixture)) {
      EXPECT_EQ(test::check_area_exact(scene), "");
    }
  });
}

TEST_P(CorpusKind, FractionsAreThoseRecorded) {
  for_each_scene([](const Fixture& fixture, const Case& scene) {
    EXPECT_EQ(difference_from_oracle(scene.answer(), fixture.fractions), "");
    ShadowOptions options = test::options_for(KernelId::kPlane);
    const auto check = [&] {
      const auto result = compute_shadows(scene.prepared(), options);
      ASSERT_TRUE(result) << to_string(result.error());
      const auto found = recorded_of(
          scene.scene(), scene.prepared(), *result,
          report::classified_sides(scene.prepared(), *result, options.output.exact_fractions));
      ASSERT_TRUE(found) << to_string(found.error());
      EXPECT_EQ(difference(fixture.fractions, *found), "");
    };
    options.method.point = MethodId::kSvbsp;
    options.method.area = MethodId::kMerged;
    for (options.method.seed = 1; options.method.seed <= 8; ++options.method.seed)
      check();  // orders of splitting
    options.method.point = MethodId::kSectors;
    options.method.area = MethodId::kReceiver;
    for (options.tuning.leaf_size = 0; options.tuning.leaf_size <= 4; ++options.tuning.leaf_size)
      check();
  });
}

TEST_P(CorpusKind, EveryMethodAgrees) {
  for_each_scene(
      [](const Fixture&, const Case& scene) { EXPECT_EQ(test::check_methods(scene), ""); });
}

TEST_P(CorpusKind, RoundedKernelsDifferWhereRecorded) {
  for_each_scene([](const Fixture& fixture, const Case& scene) {
    const std::vector<std::string> wrong = wrong_subjects(scene.judged(), recorded_subjects());
    EXPECT_EQ(wrong, fixture.wrong);
    if (fixture.expectation == Expectation::kInform) {
      EXPECT_FALSE(wrong.empty()) << "an i_ scene that all get right is a y_ scene";
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Corpus, CorpusKind, testing::ValuesIn(kinds_of_scenes()),
                         [](const auto& info) {
                           std::string name = info.param;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(Corpus, ScenesAreWhereAndWhatTheySay) {
  for (const Fixture* fixture : fixtures_of(false)) {
    SCOPED_TRACE(fixture->name);
    EXPECT_EQ(fixture->file.parent_path().filename(), fixture->kind);
    EXPECT_EQ(fixture->scene.name, fixture->file.stem());
    EXPECT_TRUE(fixture->shows.ends_with('.')) << fixture->shows;
    EXPECT_FALSE(fixture->scene.lights.empty());
    for (const std::string& name : fixture->wrong) EXPECT_TRUE(parse_subject(name)) << name;
    EXPECT_EQ(has_area_light(*fixture), fixture->kind.starts_with("area-"));
  }
}

TEST(Corpus, FilesAreRejectedAsRecorded) {
  CorpusOptions options;
  options.subjects = {Subject{}};
  for (const Fixture* fixture : fixtures_of(true)) {
    const auto report = judge_corpus({*fixture}, options);
    ASSERT_TRUE(report);
    const Judgement& own = report->judgements[0][0];
    EXPECT_EQ(own.outcome, Outcome::kPass) << fixture->name << ": " << own.why;
    EXPECT_EQ(fixture->file.parent_path().filename(), fixture->kind);
  }
}

/// A scene up to names, and up to where its loops and lists begin: what prepare() makes of it, on
/// the grid that starts at the box's corner.
std::string shape_of(const Fixture& fixture) {
  const auto prepared = prepare(fixture.scene);
  if (!prepared) return fixture.name;
  const GridPositions& grid = prepared->geometry.grid;
  std::vector<std::string> polygons;
  for (const Part& part : prepared->parts) {
    std::vector<std::string> corners;
    for (const VertexId vertex : prepared->loop(part)) {
      corners.push_back(grid.at(vertex, 0).get_str() + ' ' + grid.at(vertex, 1).get_str() + ' ' +
                        grid.at(vertex, 2).get_str());
    }
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    std::string text;
    for (const std::string& corner : corners) text += '(' + corner + ')';
    polygons.push_back(text);
  }
  std::ranges::sort(polygons);
  std::string text = prepared->geometry.step.get_str();
  for (const std::string& polygon : polygons) text += '\n' + polygon;
  for (const PreparedLight& light : prepared->lights) {
    text += "\nlight";
    for (const auto& component : light.point.grid) text += ' ' + component.get_str();
    for (const auto& corner : light.area_loop) {
      for (const auto& component : corner) text += ' ' + component.get_str();
    }
  }
  return text;
}

TEST(Corpus, HoldsNoSceneTwice) {
  std::map<std::string, std::string> known;
  for (const Fixture* fixture : fixtures_of(false)) {
    const auto [place, is_new] = known.emplace(shape_of(*fixture), fixture->name);
    EXPECT_TRUE(is_new) << fixture->name << " is " << place->second;
  }
  std::set<std::string> sentences;
  for (const Fixture& fixture : corpus()) {
    EXPECT_TRUE(sentences.insert(fixture.shows).second) << fixture.name << ": a known sentence";
  }
}

TEST(Corpus, IsLargeEnough) {
  std::size_t scenes = 0, informing = 0, rejected = 0;
  std::set<std::string> kinds, names;
  for (const Fixture& fixture : corpus()) {
    ++(fixture.expectation == Expectation::kReject ? rejected : scenes);
    informing += fixture.expectation == Expectation::kInform ? 1 : 0;
    kinds.insert(fixture.kind);
    names.insert(fixture.name);
  }
  EXPECT_GE(scenes, 160u);
  EXPECT_GE(informing, 70u);
  EXPECT_GE(rejected, 40u);
  EXPECT_GE(kinds.size(), 45u);
  EXPECT_EQ(names.size(), corpus().size());
}

TEST(Corpus, HoldsEveryKindOfDegeneracy) {
  // Of those that the generators make; what a scene is based on and its family are none.
  std::set<std::string_view> missing;
  for (std::uint16_t id = 0; id < id_of(Kind::kFirstFamily); ++id) missing.insert(kinds()[id].name);
  for (const Fixture* fixture : fixtures_of(false)) {
    const KindChecker checker(fixture->scene);
    std::erase_if(missing, [&](std::string_view name) {
      return checker.holds(static_cast<Kind>(*kind_by_name(name)));
    });
  }
  EXPECT_EQ(missing, std::set<std::string_view>());
}

TEST(Corpus, RejectsForEveryReason) {
  std::set<ErrorCode> codes;
  for (const Fixture* fixture : fixtures_of(true)) codes.insert(fixture->error.code);
  for (const ErrorCode code :
       {ErrorCode::kSyntax, ErrorCode::kFormat, ErrorCode::kNumber, ErrorCode::kIndex,
        ErrorCode::kId, ErrorCode::kGeometry, ErrorCode::kLimit}) {
    EXPECT_TRUE(codes.contains(code)) << error_code_name(code);
  }
}

TEST(Corpus, JudgesAllKernels) {
  CorpusOptions options;
  options.subjects = default_corpus_subjects();
  const auto report = judge_corpus(corpus(), options);
  ASSERT_TRUE(report);
  EXPECT_FALSE(report->disagree()) << corpus_text(*report, false);
  EXPECT_EQ(report->failures(false), 0u) << corpus_text(*report, false);
}

TEST(Corpus, SlantedThroughIsSplitAtAll) {
  // The scene would show nothing if no order of splitting cut A.
  const auto scene = Case::make(test::regression_scene("y_slanted_through"));
  ASSERT_TRUE(scene);
  unsigned split = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    ShadowOptions options = test::options_for(KernelId::kPlane);
    options.method.point = MethodId::kSvbsp;
    options.method.seed = seed;
    const Expected<ShadowResult> result = compute_shadows(scene->prepared(), options);
    ASSERT_TRUE(result);
    split += result->bsp_fragments > scene->prepared().parts.size() ? 1 : 0;
  }
  EXPECT_GT(split, 0u);
}

}  // namespace
}  // namespace gnomon::fuzz
