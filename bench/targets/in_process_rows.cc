// SPDX-License-Identifier: GPL-3.0-or-later
// Rows measured in this process, of this build alone: contour against Clipper with the same search
// of casters, and the exact kernel against doubles.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "answers.h"
#include "contest.h"
#include "peers/peer.h"
#include "targets/target_run.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

PreparedScene prepared_with_lamps(const SceneRecipe& recipe, std::size_t lamps) {
  Scene scene = generated(recipe);
  const Light first = scene.lights.at(0);
  for (std::size_t i = 1; i < lamps; ++i) {
    Light lamp = first;
    lamp.id = fmt::format("lamp{}", i);
    lamp.position[0] = Number(lamp.position[0].nearest() + static_cast<double>(i));
    scene.lights.push_back(std::move(lamp));
  }
  return prepared_or_stop(scene);
}

const Peer* clipper() {
  const auto found = std::ranges::find(peers(), "Clipper", &Peer::name);
  return found == peers().end() ? nullptr : &*found;
}

void measure_one(TargetRun& run, const SizedScene& sized) {
  constexpr std::size_t kLamps = 10;
  fmt::print(stderr, "gnomon_bench: {}, Clipper\n", sized.title);
  const PreparedScene scene = prepared_with_lamps(sized.recipe, kLamps);
  const Peer* peer = clipper();
  const ShadowOptions options = options_for(MethodId::kContour, KernelId::kPlane);
  ShadowResult result;
  PeerResult rival;
  std::vector<std::function<void()>> work = {[&] { result = shadows_or_stop(scene, options); }};
  if (peer != nullptr) work.emplace_back([&] { rival = peer->run(scene, 0); });
  std::vector<Times> times = interleaved(work, run.rounds());
  std::vector<double>& own = times[0].cpu;
  for (double& seconds : own) seconds /= kLamps;
  const std::string name = "one lamp, steady, against Clipper 6";
  if (peer == nullptr) {
    run.verdicts.add(name, sized.title, at_least(8), {kNotMeasured},
                     "not built: ./dev bench --peers targets");
  } else {
    const std::vector<double> areas = part_areas(scene);
    const double exact = lit_area(result.lights[0], areas);
    const bool same = std::abs(rival.lit_area - exact) <= peer->sum_tolerance * exact;
    run.good = run.good && same;
    run.answers.add({fmt::format("lit area within {}", peer->sum_tolerance), sized.title,
                     grouped(areas.size()), fmt::format("Clipper {:.9g}", rival.lit_area),
                     fmt::format("{:.9g}", exact), same ? "yes" : "NO"});
    run.verdicts.add(name, sized.title, at_least(8), {median_ratio(times[1].cpu, own)},
                     before_and_now(median(times[1].cpu), median(own)));
  }
}

/// Plane against doubles in one method; `points`: of fragments, put out too.
void measure_kernels(TargetRun& run, const SizedScene& sized, MethodId method, bool points,
                     const std::string& work, double target) {
  const PreparedScene scene = make_scene(sized.recipe);
  Contest contest(scene);
  for (const KernelId kernel : {KernelId::kDouble, KernelId::kPlane}) {
    ShadowOptions options = options_for(method, kernel);
    options.output.points = points;
    contest.enter(options);
  }
  contest.run(run.rounds());
  run.verdicts.add(work, sized.title, at_most(target), {contest.ratio(1, 0)},
                   fmt::format("double {} ms, plane {} ms", short_number(1e3 * contest.cpu(0)),
                               short_number(1e3 * contest.cpu(1))));
}

}  // namespace

void measure_rays(TargetRun& run) {
  const SizedScene sized = city(run.size(200, 2000));
  const std::string name = "one light, against 4,096 Embree rays a polygon";
#if GNOMON_BENCH_PEERS
  fmt::print(stderr, "gnomon_bench: {}, Embree\n", sized.title);
  const PreparedScene scene = make_scene(sized.recipe);
  const ShadowOptions options = options_for(MethodId::kContour, KernelId::kPlane);
  ShadowResult result;
  PeerResult rival;
  const std::vector<Times> times = interleaved({[&] { result = shadows_or_stop(scene, options); },
                                                [&] { rival = run_embree_rays(scene, 0); }},
                                               1);
  const std::vector<double> areas = part_areas(scene);
  const double exact = lit_area(result.lights[0], areas);
  constexpr double kTolerance = 1e-3;  // of sampling
  const bool same = std::abs(rival.lit_area - exact) <= kTolerance * exact;
  run.good = run.good && same;
  run.answers.add({fmt::format("lit area within {}", kTolerance), sized.title,
                   grouped(areas.size()), fmt::format("Embree {:.9g}", rival.lit_area),
                   fmt::format("{:.9g}", exact), same ? "yes" : "NO"});
  run.verdicts.add(name, sized.title, at_least(1), {median_ratio(times[1].cpu, times[0].cpu)},
                   before_and_now(median(times[1].cpu), median(times[0].cpu)) + ", " + rival.work);
#else
  run.verdicts.add(name, sized.title, at_least(1), {kNotMeasured},
                   "not built: ./dev bench --peers targets");
#endif
}

void measure_clipper(TargetRun& run) {
  measure_one(run, quads(run.size(1000, 10'000)));
  measure_one(run, triangles(run.size(5, 7)));
}

void measure_plane_and_double(TargetRun& run) {
  const std::int64_t houses = run.size(200, 2000);
  SizedScene decimals = city(houses), doubles = city(houses);
  decimals.title += ", decimals";
  decimals.recipe.coordinates = Coordinates::kDecimals;
  doubles.title += ", doubles";
  doubles.recipe.coordinates = Coordinates::kDoubles;
  for (const SizedScene& scene : {quads(run.size(1000, 10'000)), triangles(run.size(5, 7)),
                                  city(houses), decimals, doubles}) {
    fmt::print(stderr, "gnomon_bench: {}, plane and double\n", scene.title);
    measure_kernels(run, scene, MethodId::kContour, false, "plane / double, contour", 1.15);
    measure_kernels(run, scene, MethodId::kSectors, true, "plane / double, sectors with points",
                    1.3);
  }
}

}  // namespace gnomon::bench
