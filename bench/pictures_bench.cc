// SPDX-License-Identifier: GPL-3.0-or-later
// Samples a second of the picture methods, plane against double; the share of the exact stage; and
// the oracle, which must judge 512 x 512 samples of a thousand polygons in a minute.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/algorithms/pixels.h"
#include "gnomon/oracle/image.h"
#include "gnomon/scene/generate.h"
#include "parts.h"
#include "report/pixels/pixel_claims_of.h"
#include "table.h"
#include "timing.h"
#include "views.h"

namespace gnomon::bench {
namespace {

struct PictureScene {
  std::string name;
  std::string generator;
  std::map<std::string, std::int64_t> parameters;
};

const std::vector<PictureScene> kScenes = {
    {"room", "room", {}},
    {"tetra, 1,024", "tetra", {{"level", 5}}},
    {"city, 1,000", "city", {{"n", 200}}},
    {"cubes, 1,000", "touching-boxes", {{"n", 166}, {"size", 14}}},
};

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

bool run_pictures(Extent extent) {
  const std::uint32_t size = extent == Extent::kShort ? 64 : 512;
  const int rounds = extent == Extent::kShort ? 1 : 3;
  fmt::print("\nPictures of {0} x {0} samples, one thread: zbuffer.\n", size);
  Table table({"scene", "parts", "lights", "double, samples/s", "plane / double", "exact stage",
               "oracle, s", "wrong"});
  bool right = true;
  for (const PictureScene& picture : kScenes) {
    const auto scene = generate(picture.generator, picture.parameters);
    if (!scene) {
      fmt::print(stderr, "gnomon_bench: {}\n", to_string(scene.error()));
      return false;
    }
    ExactCamera camera;
    const auto view = view_from_a_corner(*scene, size, camera);
    if (!view) {
      fmt::print(stderr, "gnomon_bench: {}\n", to_string(view.error()));
      return false;
    }
    const auto options_of = [](KernelId kernel) {
      PixelOptions options;
      options.kernel.id = kernel;
      options.jobs = 1;
      return options;
    };
    std::vector<std::function<void()>> work;
    for (const KernelId kernel : {KernelId::kDouble, KernelId::kPlane}) {
      work.push_back([&, kernel] {
        right = compute_pixels(view->scene, view->frame, options_of(kernel)).has_value() && right;
      });
    }
    const std::vector<Times> times = interleaved(work, rounds);
    PixelOptions counted = options_of(KernelId::kPlane);
    counted.stage_counts = true;
    const auto pixels = compute_pixels(view->scene, view->frame, counted);
    if (!pixels) return false;
    const PixelClaims claims = report::pixel_claims_of(*pixels, view->scene, camera);
    const auto start = std::chrono::steady_clock::now();
    const auto report = oracle::judge_pixels(*view, claims, {});
    const double judging = seconds_since(start);
    right = right && report && report->wrong == 0;
    table.add({picture.name, grouped(view->scene.parts.size()), grouped(pixels->lights.size()),
               short_number(size * size / median(times[0].cpu)),
               short_number(median_ratio(times[1].cpu, times[0].cpu)),
               fmt::format("{:.2g} %", 100 * static_cast<double>(pixels->stages.exact()) /
                                           static_cast<double>(pixels->stages.total())),
               short_number(judging), report ? grouped(report->wrong) : "-"});
  }
  table.print();
  return right;
}

}  // namespace gnomon::bench
