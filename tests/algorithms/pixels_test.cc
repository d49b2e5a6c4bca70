// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of every kernel and method against the oracle, from seven eyes.
#include "gnomon/algorithms/pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fuzz/check/seven_eyes.h"
#include "fuzz/generate/families.h"
#include "fuzz/generate/scene_pen.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/oracle/image.h"
#include "report/pixels/pixel_claims_of.h"
#include "solve.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kSize = 24;

PixelOptions options_of(KernelId kernel, MethodId method = MethodId::kZbuffer) {
  PixelOptions options;
  options.kernel.id = kernel;
  options.method = method;
  options.jobs = 1;
  return options;
}

/// The lights that have samples.
std::vector<std::uint32_t> lights_of(const PreparedScene& scene) {
  std::vector<std::uint32_t> lights;
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
    if (!scene.lights[l].has_area()) lights.push_back(l);
  }
  return lights;
}

/// Of exact kernels samples on boundaries are judged, too: their ties are defined.
oracle::ImageReport judged(const PreparedView& view, const ExactCamera& camera,
                           const Pixels& pixels) {
  oracle::ImageOptions options;
  options.moves_ties = pixels.exact;
  auto report =
      oracle::judge_pixels(view, report::pixel_claims_of(pixels, view.scene, camera), options);
  EXPECT_TRUE(report) << to_string(report.error());
  return *std::move(report);
}

std::string words_of(const oracle::ImageReport& report) {
  std::string text = std::to_string(report.wrong) + " of " + std::to_string(report.judged) +
                     " wrong, " + std::to_string(report.wrong_polygon) + " of polygon";
  if (report.worst) {
    text += "; sample " + std::to_string(report.worst->i) + "," + std::to_string(report.worst->j);
  }
  return text;
}

class Pictures : public testing::TestWithParam<std::string> {};

// No sample of an exact kernel is wrong, from any eye; rounded kernels end.
TEST_P(Pictures, OfExactKernelsAreRightFromSevenEyes) {
  const fuzz::Family& family = fuzz::family_by_name(GetParam());
  std::uint64_t judged_samples = 0, moved_samples = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Scene scene = family.make(seed);
    const auto prepared = prepare(scene);
    if (!prepared) continue;
    for (const fuzz::NamedEye& eye :
         fuzz::seven_eyes(*prepared, kSize, static_cast<std::uint32_t>(seed))) {
      const auto view = prepare_view(scene, eye.camera);
      ASSERT_TRUE(view) << to_string(view.error());
      for (const KernelInfo& kernel : kernel_list()) {
        if (!has_kernel(kernel.id)) continue;
        PixelOptions options = options_of(kernel.id);
        options.lights = lights_of(view->scene);
        const auto pixels = compute_pixels(view->scene, view->frame, options);
        ASSERT_TRUE(pixels) << to_string(pixels.error());
        if (!kernel.exact) continue;
        const oracle::ImageReport report = judged(*view, eye.camera, *pixels);
        ASSERT_EQ(report.wrong, 0u) << family.name << " seed " << seed << ", eye " << eye.name
                                    << ", " << kernel.name << ": " << words_of(report) << "\n"
                                    << text_of(scene);
        judged_samples += report.judged;
        moved_samples += report.moved;
      }
    }
  }
  EXPECT_GT(judged_samples, 1000u);
  EXPECT_TRUE(moved_samples > 0 || family.name == "Generic");
}

INSTANTIATE_TEST_SUITE_P(Families, Pictures,
                         testing::Values("Generic", "Lattice", "Crossing", "CoplanarTiles",
                                         "TouchingBoxes", "NestedBoxes", "Grazing", "Needles",
                                         "SmallLattice"),
                         [](const auto& info) { return info.param; });

/// A floor, a table over it, a box, and a lamp and a sun.
Scene small_room() {
  fuzz::ScenePen pen;
  pen.polygon({{0, 0, 0}, {16, 0, 0}, {16, 16, 0}, {0, 16, 0}});
  pen.two_sided(true);
  pen.polygon({{4, 4, 4}, {9, 4, 4}, {9, 9, 4}, {4, 9, 4}});
  pen.two_sided(false);
  pen.box({10, 3, 0}, {13, 6, 3});
  return pen.lamp({5, 7, 12}).sun({1, 2, 3}).take();
}

fuzz::NamedEye generic_eye(const Scene& scene, std::uint32_t size = 40) {
  return fuzz::seven_eyes(prepare(scene).value(), size).back();
}

Pixels pixels_of(const PreparedView& view, const PixelOptions& options) {
  auto pixels = compute_pixels(view.scene, view.frame, options);
  EXPECT_TRUE(pixels) << to_string(pixels.error());
  return *std::move(pixels);
}

// Every method of object space can be sampled, too, and shows the same picture.
TEST(Pixels, EveryMethodShowsTheSamePicture) {
  const Scene scene = small_room();
  const fuzz::NamedEye eye = generic_eye(scene);
  const PreparedView view = prepare_view(scene, eye.camera).value();
  const Pixels reference = pixels_of(view, options_of(KernelId::kPlane));
  EXPECT_EQ(judged(view, eye.camera, reference).wrong, 0u);
  for (const Method& method : methods()) {
    if (!method.lights.point || !method.chosen_by_name || !method.makes_fragments) continue;
    for (const KernelId kernel : {KernelId::kPlane, KernelId::kRational, KernelId::kDouble}) {
      const Pixels pixels = pixels_of(view, options_of(kernel, method.id));
      EXPECT_EQ(judged(view, eye.camera, pixels).wrong, 0u) << method.name << ' ' << pixels.kernel;
      EXPECT_EQ(pixels.part, reference.part) << method.name << ' ' << pixels.kernel;
    }
  }
  PixelOptions overlay = options_of(KernelId::kPlane, MethodId::kBasic);
  overlay.options.cover = Cover::kOverlay;
  EXPECT_EQ(pixels_of(view, overlay).lit_by, reference.lit_by);
}

// Neither the order of drawing nor the threads change a sample, and counts do not depend on
// threads.
TEST(Pixels, DoNotDependOnOrderOrThreads) {
  const Scene scene = small_room();
  const PreparedView view = prepare_view(scene, generic_eye(scene).camera).value();
  const Pixels reference = pixels_of(view, options_of(KernelId::kPlane));
  for (const InsertionOrder order : {InsertionOrder::kFile, InsertionOrder::kFarFirst}) {
    PixelOptions options = options_of(KernelId::kPlane);
    options.options.order = order;
    const Pixels pixels = pixels_of(view, options);
    EXPECT_EQ(pixels.part, reference.part);
    EXPECT_EQ(pixels.lit_by, reference.lit_by);
  }
  PixelOptions threads = options_of(KernelId::kPlane);
  threads.jobs = 3;
  const Pixels pixels = pixels_of(view, threads);
  EXPECT_EQ(pixels.part, reference.part);
  EXPECT_EQ(pixels.lit_by, reference.lit_by);
  EXPECT_EQ(pixels.work, reference.work);
}

// Tiles of one plane that share edges: every sample that looks at their union sees exactly one, on
// every kernel.
TEST(Pixels, ExactlyOneOfNeighboursCoversASample) {
  fuzz::ScenePen pen;
  for (int x = 0; x < 4; ++x) {
    for (int y = 0; y < 4; ++y) {
      pen.polygon({{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}});
      pen.polygon({{x, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}});
    }
  }
  const Scene scene = pen.sun({0, 0, 1}).take();
  // Straight from above, so that rays run through edges and corners.
  ExactCamera camera{{Number(2), Number(2), Number(4)}, {1, 0, 0}, {0, 1, 0}, {0, 0, -2}, 32, 32};
  const PreparedView view = prepare_view(scene, camera).value();
  for (const KernelInfo& kernel : kernel_list()) {
    if (!has_kernel(kernel.id)) continue;
    const Pixels pixels = pixels_of(view, options_of(kernel.id));
    // The picture is the square [0, 4]^2, no sample of it on its border.
    EXPECT_EQ(pixels.work[Counter::kDepthComplexity], 1'000'000u) << kernel.name;
    EXPECT_EQ(pixels.work[Counter::kSamples], 32u * 32u) << kernel.name;
  }
}

TEST(Pixels, AreaLightsAndUnknownOnesAreErrors) {
  fuzz::ScenePen pen;
  pen.polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
  pen.panel({{1, 1, 3}, {1, 2, 3}, {2, 2, 3}, {2, 1, 3}});
  const Scene scene = pen.take();
  const PreparedView view = prepare_view(scene, generic_eye(scene).camera).value();
  const auto message = [&](const PixelOptions& options) {
    const auto pixels = compute_pixels(view.scene, view.frame, options);
    return pixels ? std::string("accepted") : to_string(pixels.error());
  };
  EXPECT_THAT(message(options_of(KernelId::kPlane)), HasSubstr("area lights"));
  PixelOptions unknown = options_of(KernelId::kPlane);
  unknown.lights = {7};
  EXPECT_THAT(message(unknown), HasSubstr("no light 7"));
  EXPECT_THAT(message(options_of(KernelId::kPlane, MethodId::kContour)), HasSubstr("area lights"));
}

TEST(Pixels, AMethodWithoutFragmentsHasNone) {
  const Scene scene = small_room();
  const PreparedView view = prepare_view(scene, generic_eye(scene).camera).value();
  const auto pixels =
      compute_pixels(view.scene, view.frame, options_of(KernelId::kPlane, MethodId::kContour));
  ASSERT_FALSE(pixels);
  EXPECT_THAT(to_string(pixels.error()), HasSubstr("makes no fragments"));
}

}  // namespace
}  // namespace gnomon::test
