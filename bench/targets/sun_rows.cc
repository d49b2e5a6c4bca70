// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of suns over a city: a sun among a hundred in one run, and a year's with their table.
#include <fmt/format.h>

#include <cstdio>

#include "targets/suns.h"
#include "targets/target_run.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

/// With a sun instead of the lamp.
SizedScene sunny_city(std::int64_t houses) {
  SizedScene scene = city(houses);
  scene.recipe.parameters["light"] = 1;
  return scene;
}

/// The scene has one sun already.
Words more_suns(const TargetRun& run, std::size_t count) {
  return {"--lights", run.files.suns(suns_of_a_year(count - 1))};
}

}  // namespace

void measure_suns(TargetRun& run) {
  const SizedScene scene = sunny_city(run.size(200, 2000));
  const auto suns = static_cast<std::size_t>(run.size(20, 100));
  fmt::print(stderr, "gnomon_bench: {}, {} suns\n", scene.title, suns);
  const Words words = Words{run.files.scene(run.now, scene.recipe)} + more_suns(run, suns);
  std::vector<double> before, now;
  for (int round = 0; round < 3; ++round) {
    if (run.before) before.push_back(run.before->shadows(words, true).phases.shadows);
    now.push_back(run.now.shadows(words + contour_words(), true).phases.shadows);
  }
  const auto count = static_cast<double>(suns);
  run.seconds_a_sun = median(now) / count;
  const bool measured = !before.empty();
  run.verdicts.add(
      fmt::format("a sun of {} in one run", suns), scene.title, at_least(4.5),
      {measured ? median_ratio(before, now) : kNotMeasured},
      before_and_now(measured ? median(before) / count : kNotMeasured, run.seconds_a_sun));
  const SizedScene small = sunny_city(60);
  compare_answers(run, small, more_suns(run, 20), Compared::kRationals);
  compare_answers(run, scene, more_suns(run, 5), Compared::kBounds);
}

void measure_year(TargetRun& run) {
  const SizedScene scene = sunny_city(run.size(200, 2000));
  const auto suns = static_cast<std::size_t>(run.size(40, kHoursOfSun));
  const std::string work = fmt::format("{} suns to a table", grouped(suns));
  const auto add = [&](double cpu, double output, double gigabytes, const std::string& note) {
    run.verdicts.add(work + ", CPU", scene.title, at_most(30, Unit::kSeconds), {cpu}, note);
    run.verdicts.add(work + ", output", scene.title, at_most(0.2, Unit::kShare), {output}, note);
    run.verdicts.add(work + ", peak memory", scene.title, at_most(0.3, Unit::kGigabytes),
                     {gigabytes}, note);
  };
  const double estimate = run.seconds_a_sun * static_cast<double>(suns);
  constexpr double kPatience = 600;  // seconds
  std::string why;
  if (!run.now.knows("--shares")) {
    why = kNoTable;
  } else if (estimate > kPatience) {
    why = fmt::format("would take {:.0f} s", estimate);
  }
  if (!why.empty()) {
    add(kNotMeasured, kNotMeasured, kNotMeasured, why);
    return;
  }
  fmt::print(stderr, "gnomon_bench: {}, {}\n", scene.title, work);
  const std::string table = run.files.path("year.npy");
  const Command::Run measured =
      run.now.shadows(Words{run.files.scene(run.now, scene.recipe), "--shares", table} +
                          more_suns(run, suns) + contour_words(),
                      true);
  const double bytes = static_cast<double>(std::filesystem::file_size(table));
  std::filesystem::remove(table);
  add(measured.cpu, measured.phases.output / measured.cpu,
      1e-9 * static_cast<double>(measured.peak_bytes),
      fmt::format("shadows {} s, output {} s, table of {} MB",
                  short_number(measured.phases.shadows), short_number(measured.phases.output),
                  short_number(1e-6 * bytes)));
}

}  // namespace gnomon::bench
