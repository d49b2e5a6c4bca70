// SPDX-License-Identifier: GPL-3.0-or-later
// scan-out against zbuffer and the oracle from seven eyes, and what its lists count.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "exact_check.h"
#include "fuzz/check/seven_eyes.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/pixels.h"
#include "gnomon/oracle/image.h"
#include "gnomon/scene/generate.h"
#include "picture_runs.h"
#include "report/pixels/pixel_claims_of.h"

namespace gnomon::test {
namespace {

TEST(ScanOut, HasTheSamplesOfZbufferAndTheOracleFromSevenEyes) {
  std::uint32_t pick = 0;
  std::uint64_t judged = 0;
  for (const Scene& scene : scenes_of_all_generators()) {
    const PreparedScene prepared = prepare(scene).value();
    for (const fuzz::NamedEye& eye : fuzz::seven_eyes(prepared, 40, ++pick)) {
      const auto view = prepare_view(scene, eye.camera);
      ASSERT_TRUE(view) << to_string(view.error());
      const Pixels reference = pixels_of(*view, options_of("zbuffer"));
      for (const KernelId kernel : kExactKernels) {
        const Pixels pixels = pixels_of(*view, options_of("scan-out", kernel));
        EXPECT_EQ(pixels.part, reference.part) << scene.name << ", " << eye.name;
        EXPECT_EQ(pixels.lit_by, reference.lit_by) << scene.name << ", " << eye.name;
      }
      oracle::ImageOptions exact;
      exact.moves_ties = true;
      const Pixels own = pixels_of(*view, options_of("scan-out"));
      const auto report =
          oracle::judge_pixels(*view, report::pixel_claims_of(own, view->scene, eye.camera), exact);
      ASSERT_TRUE(report) << to_string(report.error());
      EXPECT_EQ(report->wrong, 0u) << scene.name << ", " << eye.name;
      judged += report->judged;
      for (const KernelId kernel : {KernelId::kFloat, KernelId::kDouble, KernelId::kEpick}) {
        EXPECT_EQ(pixels_of(*view, options_of("scan-out", kernel)).part.size(),
                  reference.part.size());
      }
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(judged, 100'000u);
}

TEST(ScanOut, WhoIsAskedChangesNoListAndNoSample) {
  std::uint32_t pick = 0;
  for (const Scene& scene : scenes_of_all_generators()) {
    const PreparedScene prepared = prepare(scene).value();
    for (const fuzz::NamedEye& eye : fuzz::seven_eyes(prepared, 16, ++pick)) {
      const PreparedView view = prepare_view(scene, eye.camera).value();
      const Pixels all = pixels_of(view, options_of("scan-out:lists=all"));
      for (const char* lists : {"sectors", "tiles"}) {
        const Pixels some = pixels_of(view, options_of(std::string("scan-out:lists=") + lists));
        EXPECT_EQ(some.lit_by, all.lit_by);
        EXPECT_EQ(some.work[Counter::kListEntries], all.work[Counter::kListEntries]);
        EXPECT_EQ(some.work[Counter::kLongestList], all.work[Counter::kLongestList]);
        EXPECT_LE(some.work[Counter::kOverlapTests], all.work[Counter::kOverlapTests]);
      }
      const Pixels lazy = pixels_of(view, options_of("scan-out:lazy=on"));
      EXPECT_EQ(lazy.lit_by, all.lit_by);
      EXPECT_LE(lazy.work[Counter::kListEntries], all.work[Counter::kListEntries]);
    }
  }
}

TEST(ScanOut, AsksEveryPairOnlyIfItIsToldTo) {
  const Scene scene = generate("city", {{"n", 400}}).value();
  const PreparedScene prepared = prepare(scene).value();
  const PreparedView view =
      prepare_view(scene, fuzz::seven_eyes(prepared, 64, 1).back().camera).value();
  const auto tests = [&](const std::string& method) {
    PixelOptions own = options_of(method);
    own.lights = {0};
    return pixels_of(view, own).work[Counter::kOverlapTests];
  };
  const std::uint64_t all = tests("scan-out:lists=all");
  EXPECT_LT(5 * tests("scan-out:lists=sectors"), all);
  EXPECT_LT(5 * tests("scan-out:lists=tiles"), all);
  EXPECT_LT(tests("scan-out:lazy=on"), tests("scan-out"));
}

TEST(ScanOut, CountsDoNotDependOnThreads) {
  for (const Scene& scene : scenes_of_all_generators()) {
    const PreparedScene prepared = prepare(scene).value();
    const auto eyes = fuzz::seven_eyes(prepared, 24, 1);
    if (eyes.empty()) continue;
    const PreparedView view = prepare_view(scene, eyes.back().camera).value();
    for (const char* method : {"scan-out", "scan-out:lazy=on"}) {
      PixelOptions options = options_of(method);
      const Pixels one = pixels_of(view, options);
      options.jobs = 3;
      const Pixels three = pixels_of(view, options);
      EXPECT_EQ(one.part, three.part);
      EXPECT_EQ(one.lit_by, three.lit_by);
      EXPECT_EQ(one.work, three.work);
    }
  }
}

TEST(ScanOut, OptionsAreReadAndTold) {
  for (const std::string text :
       {"scan-out", "scan-out:lists=all", "scan-out:lists=tiles,lazy=on"}) {
    const auto selection = parse_method(text, Domain::kImageSpace);
    ASSERT_TRUE(selection) << text;
    EXPECT_EQ(method_text(selection->id, selection->values), text);
  }
  EXPECT_FALSE(parse_method("scan-out:lists=none", Domain::kImageSpace));
}

}  // namespace
}  // namespace gnomon::test
