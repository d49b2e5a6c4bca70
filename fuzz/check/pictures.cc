// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "fuzz/check/seven_eyes.h"
#include "fuzz/mistakes/compute.h"
#include "gnomon/oracle/verdict.h"
#include "report/pixels/pixel_claims_of.h"
#include "report/pixels/rows_of_table.h"

namespace gnomon::fuzz {
namespace {

constexpr std::uint32_t kSize = 16;         // samples in a row
constexpr std::uint32_t kPicks = 2;         // parts whose planes and edges eyes are on
constexpr double kExcusedClearance = 1e-9;  // of the scene's diagonal

std::string polygon_name(const Scene& scene, std::uint32_t polygon) {
  return polygon == PixelClaims::kNothing ? "nothing" : scene.polygons[polygon].id;
}

bool refuses_scenes(const Subject& subject) {
  const MethodNeeds& needs = method_info(subject.algorithm).needs;
  return needs.closed_meshes || needs.one_hemisphere;
}

}  // namespace

bool makes_pictures(const Subject& subject) {
  return !subject.foreign() && method_info(subject.algorithm).domain == Domain::kImageSpace;
}

std::string WrongPicture::disagreement() const {
  return report.worst && report.worst->light ? "wrong light" : "wrong polygon seen";
}

std::string WrongPicture::text(const Scene& scene) const {
  std::string text = fmt::format("eye {}: {} of {} samples wrong", eye, report.wrong,
                                 report.judged + report.moved);
  if (!report.worst) return text;
  const oracle::WrongSample& worst = *report.worst;
  text += fmt::format("; sample ({}, {}) on {}", worst.i, worst.j, polygon_name(scene, worst.seen));
  if (worst.light) {
    return text + fmt::format(", light {}: found {}", scene.lights[*worst.light].id,
                              worst.claimed_lit ? "lit" : "shadow");
  }
  return text + ": found " + polygon_name(scene, worst.claimed);
}

Expected<TakenPicture> take_picture(const Scene& scene, const Subject& subject, Mistake mistake,
                                    const ExactCamera& camera) {
  auto view = prepare_view(scene, camera);
  if (!view) return tl::unexpected(std::move(view.error()));
  PixelOptions options;
  options.kernel = shadow_options(subject).kernel;
  options.method = subject.algorithm;
  options.options = subject.options;
  options.scene = &scene;
  options.jobs = 1;
  for (std::uint32_t l = 0; l < view->scene.lights.size(); ++l) {
    if (!view->scene.lights[l].has_area()) options.lights.push_back(l);
  }
  if (options.lights.empty()) {
    return fail(ErrorCode::kUsage, "a picture without point and directional lights", "a light");
  }
  const auto pixels = compute_pixels(view->scene, view->frame, options, mistake);
  if (!pixels) return tl::unexpected(pixels.error());
  PixelClaims claims = report::pixel_claims_of(*pixels, view->scene, camera);
  return TakenPicture{*std::move(view), std::move(claims)};
}

Expected<std::optional<WrongPicture>> wrong_picture(const Scene& scene,
                                                    const PreparedScene& prepared,
                                                    const Subject& subject, Mistake mistake) {
  oracle::ImageOptions judging;
  judging.moves_ties = subject.kernel.exact();
  if (!subject.kernel.exact()) {
    judging.clearance = kExcusedClearance * oracle::scene_diagonal(prepared);
  }
  const bool lit = std::ranges::any_of(
      prepared.lights, [](const PreparedLight& light) { return !light.has_area(); });
  for (std::uint32_t pick = 0; lit && pick < kPicks; ++pick) {
    for (const NamedEye& eye : seven_eyes(prepared, kSize, pick)) {
      auto taken = take_picture(scene, subject, mistake, eye.camera);
      if (!taken) {
        // A method may refuse a scene, or an eye, that it says it does not take.
        if (refuses_scenes(subject) && taken.error().code == ErrorCode::kGeometry) continue;
        return tl::unexpected(std::move(taken.error()));
      }
      judging.near_border =
          report::rows_of_table(taken->view, {subject.algorithm, subject.options});
      auto report = oracle::judge_pixels(taken->view, taken->claims, judging);
      if (!report) return tl::unexpected(std::move(report.error()));
      // Too many samples on borders are no fault of the kernel.
      if (report->wrong == 0 || report->verdict == oracle::Verdict::kWithinTolerance) continue;
      return std::optional(WrongPicture{eye.name, std::move(taken->claims), *std::move(report)});
    }
  }
  return std::optional<WrongPicture>();
}

}  // namespace gnomon::fuzz
