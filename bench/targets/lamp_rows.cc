// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of lamps: shadows under one light in a fresh process, and steady, as of one light among
// others in one run.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "targets/target_run.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

struct LampWork {
  SizedScene scene;
  std::size_t lamps;  // of the steady run, at least 2
  double steady;      // target
  std::optional<double> fresh;
  bool compared;  // bounds of all shares, too
  /// CPU time of Clipper 2 with the same search of casters, in that of version 0.1.0, if known.
  std::optional<double> clipper2;
};
// Seconds, of one session outside this program: Debian has no package of Clipper 2.
constexpr double kClipper2OnQuads = 0.038 / 0.040, kClipper2OnTriangles = 0.038 / 0.037;

/// CPU seconds of the shadows of one lamp, by round.
struct LampTimes {
  std::vector<double> fresh, steady;
};

void add_round(const Command& command, const Words& one, const Words& all, std::size_t lamps,
               LampTimes& times) {
  const double first = command.shadows(one, true).phases.shadows;
  // The first lamp's share of the longer run is taken out: what a process does once is no part of a
  // steady light.
  const double together = command.shadows(all, true).phases.shadows;
  times.fresh.push_back(first);
  times.steady.push_back((together - first) / static_cast<double>(lamps - 1));
}

void measure(TargetRun& run, const LampWork& work) {
  fmt::print(stderr, "gnomon_bench: {}, {} lamps\n", work.scene.title, work.lamps);
  const Words scene = {run.files.scene(run.now, work.scene.recipe)};
  const Words more = {"--lights", run.files.more_lamps(work.scene.recipe, work.lamps - 1)};
  LampTimes before, now;
  for (int round = 0; round < run.rounds(); ++round) {
    if (run.before) add_round(*run.before, scene, scene + more, work.lamps, before);
    add_round(run.now, scene + contour_words(), scene + more + contour_words(), work.lamps, now);
  }
  const auto add = [&](const std::string& what, double target, const std::vector<double>& old_times,
                       const std::vector<double>& new_times) {
    const bool measured = !old_times.empty();
    run.verdicts.add(
        what, work.scene.title, at_least(target),
        {measured ? median_ratio(old_times, new_times) : kNotMeasured},
        before_and_now(measured ? median(old_times) : kNotMeasured, median(new_times)));
  };
  add("one lamp, steady", work.steady, before.steady, now.steady);
  if (work.fresh) add("one lamp, fresh process", *work.fresh, before.fresh, now.fresh);
  if (work.clipper2) {
    const double ratio =
        before.steady.empty() ? kNotMeasured : median_ratio(before.steady, now.steady);
    run.verdicts.add(
        "one lamp, steady, against Clipper 2", work.scene.title, at_least(4),
        {*work.clipper2 * ratio},
        fmt::format("Clipper 2 as {:.2f} times version 0.1.0, measured elsewhere", *work.clipper2));
  }
  if (work.compared) compare_answers(run, work.scene, {}, Compared::kBounds);
}

void compare_small(TargetRun& run, const SizedScene& scene) {
  compare_answers(run, scene, {"--lights", run.files.more_lamps(scene.recipe, 1)},
                  Compared::kRationals);
}

}  // namespace

void measure_lamps(TargetRun& run) {
  const std::size_t lamps = run.small() ? 4 : 10;
  std::vector<LampWork> works = {
      {quads(run.size(1000, 10'000)), lamps, 5, 2.8, true, kClipper2OnQuads},
      {triangles(run.size(5, 7)), lamps, 5, 2.8, true, kClipper2OnTriangles},
      {city(run.size(200, 2000)), lamps, 2.5, {}, true, {}},
  };
  if (!run.small()) works.push_back({city(20'000), 4, 2.3, {}, true, {}});
  if (run.extent == Extent::kLong) {
    works.push_back({city(200'000), 3, 2.4, {}, false, {}});
    works.push_back({quads(1'000'000), 3, 3, {}, false, {}});
  }
  for (const LampWork& work : works) measure(run, work);
  for (const SizedScene& scene : {quads(300), triangles(4), city(60)}) compare_small(run, scene);
}

}  // namespace gnomon::bench
