// SPDX-License-Identifier: GPL-3.0-or-later
// Candidates under area lights: what must be exact, what is accepted, and what is only a cost.
#include <gtest/gtest.h>

#include "gnomon/oracle/verdict.h"
#include "scene_builder.h"

namespace gnomon::oracle {
namespace {

const std::vector<Triple> kFloor{{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}};
const std::vector<Triple> kPanel{{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}, {1, -1, 4}};

CandidateFragment rectangle(ShadeClass shade, double x0, double y0, double x1, double y1) {
  CandidateFragment fragment;
  fragment.shade = shade;
  fragment.exact = true;
  fragment.loop = {at(x0, y0, 0), at(x1, y0, 0), at(x1, y1, 0), at(x0, y1, 0)};
  return fragment;
}

/// A floor whose nested squares are of these classes, from the outermost in.
Candidate nested(const std::vector<std::pair<double, ShadeClass>>& squares) {
  Candidate candidate;
  candidate.name = "by hand";
  CandidateLight light;
  light.id = "panel";
  CandidatePolygon floor;
  floor.id = "floor";
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const auto [outer, shade] = squares[i];
    if (i + 1 == squares.size()) {
      floor.fragments.push_back(rectangle(shade, -outer, -outer, outer, outer));
      continue;
    }
    const double inner = squares[i + 1].first;
    floor.fragments.push_back(rectangle(shade, -outer, -outer, outer, -inner));
    floor.fragments.push_back(rectangle(shade, -outer, inner, outer, outer));
    floor.fragments.push_back(rectangle(shade, -outer, -inner, -inner, inner));
    floor.fragments.push_back(rectangle(shade, inner, -inner, outer, inner));
  }
  light.polygons.push_back(std::move(floor));
  candidate.lights.push_back(std::move(light));
  return candidate;
}

constexpr ShadeClass kIsLit = ShadeClass::kLit, kIsPenumbra = ShadeClass::kPenumbra,
                     kIsUmbra = ShadeClass::kUmbra;

Report certified(const BuiltScene& built, const Candidate& candidate) {
  CertifyOptions options;
  options.subset = true;
  return *certify(built.scene, built.prepared, candidate, options);
}

class AreaVerdict : public testing::Test {
 protected:
  // Penumbra [-3, 3]^2, umbra [-1, 1]^2 of the whole lid.
  const BuiltScene whole_ = SceneBuilder()
                                .polygon("floor", kFloor)
                                .polygon("lid", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}})
                                .area("panel", kPanel)
                                .build();
};

TEST_F(AreaVerdict, ExactIsIdentical) {
  Candidate candidate = nested({{8, kIsLit}, {3, kIsPenumbra}, {1, kIsUmbra}});
  for (const bool per_caster : {false, true}) {
    candidate.lights[0].per_caster_umbra = per_caster;
    const Report report = certified(whole_, candidate);
    EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
    const PolygonComparison& floor = report.lights[0].polygons[0];
    EXPECT_EQ(floor.lit.exact, mpq_class(220) / 256);
    EXPECT_EQ(floor.penumbra.exact, mpq_class(32) / 256);
    EXPECT_EQ(floor.umbra.exact, mpq_class(4) / 256);
    EXPECT_TRUE(floor.missing_umbra.zero);
    EXPECT_TRUE(report.totals.umbra.contains(4));
    EXPECT_EQ(report.totals.invented + report.totals.lost, 0u);
  }
}

TEST_F(AreaVerdict, MissingUmbraIsACost) {
  Candidate candidate = nested({{8, kIsLit}, {3, kIsPenumbra}});
  Report report = certified(whole_, candidate);
  EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
  EXPECT_EQ(report.lights[0].polygons[0].missing_umbra.exact, mpq_class(4) / 256);
  EXPECT_TRUE(report.totals.missing_umbra.contains(4));
  EXPECT_EQ(report.totals.lost, 0u);
  candidate.lights[0].per_caster_umbra = true;
  report = certified(whole_, candidate);
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.lights[0].polygons[0].misclassified.exact, mpq_class(4) / 256);
  EXPECT_EQ(report.totals.lost, 1u);
  EXPECT_EQ(report.worst->text, "found penumbra, truly umbra behind 'lid'");
}

TEST_F(AreaVerdict, MissingPenumbraIsAnError) {
  const Report report = certified(whole_, nested({{8, kIsLit}, {2, kIsPenumbra}, {1, kIsUmbra}}));
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.lights[0].polygons[0].misclassified.exact, mpq_class(20) / 256);
  EXPECT_EQ(report.worst->text, "found lit, truly penumbra of 'lid'");
}

TEST_F(AreaVerdict, TooMuchPenumbraIsAnError) {
  const Report report = certified(whole_, nested({{8, kIsLit}, {4, kIsPenumbra}, {1, kIsUmbra}}));
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.lights[0].polygons[0].misclassified.exact, mpq_class(28) / 256);
}

TEST_F(AreaVerdict, TooMuchUmbraIsAnErrorThatSeesLight) {
  const Report report = certified(whole_, nested({{8, kIsLit}, {3, kIsPenumbra}, {2, kIsUmbra}}));
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.lights[0].polygons[0].misclassified.exact, mpq_class(12) / 256);
  EXPECT_NE(report.worst->text.find("of the light is seen"), std::string::npos)
      << report.worst->text;
}

TEST_F(AreaVerdict, ClassesOfPointLightsAreUnknownHere) {
  const Report report =
      certified(whole_, nested({{8, kIsLit}, {3, kIsPenumbra}, {1, ShadeClass::kShadow}}));
  EXPECT_EQ(report.verdict, Verdict::kFailed);
  EXPECT_EQ(report.reason,
            "light 'panel': polygon 'floor' has a fragment of class 'shadow'; lit, penumbra or "
            "umbra was expected");
}

TEST_F(AreaVerdict, BackgroundIsAClassOfTheLight) {
  Candidate candidate = nested({{3, kIsPenumbra}, {1, kIsUmbra}});
  candidate.lights[0].background = kIsLit;
  candidate.lights[0].polygons.push_back({});
  candidate.lights[0].polygons[1].id = "lid";
  EXPECT_EQ(certified(whole_, candidate).verdict, Verdict::kIdentical);
  candidate.lights[0].background = kIsUmbra;
  EXPECT_EQ(certified(whole_, candidate).verdict, Verdict::kFailed);
}

TEST(AreaVerdictSoups, ExactCandidatesAreIdentical) {
  std::uint64_t fragments = 0;
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    const BuiltScene built = lattice_area_soup(seed, 9, seed % 2 == 0 ? 4 : 2);
    const ExactAnswer answer(built.scene, built.prepared);
    Candidate candidate = exact_candidate(answer);
    for (const bool per_caster : {true, false}) {
      candidate.lights[0].per_caster_umbra = per_caster;
      const Expected<Report> report = certify(answer, candidate, {});
      ASSERT_TRUE(report.has_value());
      EXPECT_EQ(report->verdict, Verdict::kIdentical) << seed << " " << report->reason;
      EXPECT_TRUE(report->problems.empty()) << seed;
      EXPECT_EQ(report->totals.invented + report->totals.lost, 0u) << seed;
      EXPECT_TRUE(report->totals.missing_umbra.is_zero());
      fragments += report->totals.fragments;
    }
    CertifyOptions points;
    points.most_pairs = 1;
    const Report by_points = *certify(answer, candidate, points);
    EXPECT_TRUE(by_points.by_points);
    EXPECT_EQ(by_points.points_wrong, 0u) << seed << " " << by_points.reason;
    // One class changed is found, by regions and as a rule by points.
    Random random(seed);
    candidate.lights[0].per_caster_umbra = true;
    CandidateLight& light = candidate.lights[0];
    CandidatePolygon& polygon = light.polygons[random.next() % light.polygons.size()];
    CandidateFragment& fragment = polygon.fragments[random.next() % polygon.fragments.size()];
    fragment.shade = fragment.shade == kIsUmbra ? kIsPenumbra : kIsUmbra;
    EXPECT_EQ(certify(answer, candidate, {})->verdict, Verdict::kFailed) << seed;
  }
  EXPECT_GT(fragments, 4000u);
}

TEST(AreaVerdictMixed, LightsOfEveryKind) {
  const BuiltScene built =
      SceneBuilder()
          .polygon("floor", kFloor)
          .polygon("lid", {{-1, -1, 2}, {1, -1, 2}, {1, 1, 2}, {-1, 1, 2}}, true)
          .point("lamp", {0, 0, 4})
          .area("panel", kPanel)
          .sun("sun", {0, 1, 2})
          .build();
  const ExactAnswer answer(built.scene, built.prepared);
  Candidate candidate = exact_candidate(answer);
  const Report report = *certify(answer, candidate, {});
  EXPECT_EQ(report.verdict, Verdict::kIdentical) << report.reason;
  ASSERT_EQ(report.lights.size(), 3u);
  EXPECT_TRUE(report.notes.empty());
  candidate.lights.erase(candidate.lights.begin() + 1);
  EXPECT_EQ(certify(answer, candidate, {})->reason, "light 'panel' is missing");
}

}  // namespace
}  // namespace gnomon::oracle
