// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of whole processes: from the scene's file to the shares, as JSON and, where the command
// writes one, as a table; against the other build's JSON, the only form that version 0.1.0 has.
#include <fmt/format.h>

#include <cstdio>

#include "targets/target_run.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

void measure(TargetRun& run, const SizedScene& scene, double target) {
  fmt::print(stderr, "gnomon_bench: {}, whole process\n", scene.title);
  const Words words = {run.files.scene(run.now, scene.recipe)};
  const bool tables = run.now.knows("--shares");
  const std::string table = run.files.path("shares.csv");
  std::vector<double> before, json, shares;
  for (int round = 0; round < run.rounds(); ++round) {
    if (run.before) before.push_back(run.before->shadows(words, false).cpu);
    json.push_back(run.now.shadows(words + contour_words(), false).cpu);
    if (!tables) continue;
    shares.push_back(
        run.now.shadows(words + Words{"--shares", table} + contour_words(), false).cpu);
    std::filesystem::remove(table);
  }
  const auto add = [&](const std::string& what, const std::vector<double>& now) {
    const double old = before.empty() ? kNotMeasured : median(before);
    if (now.empty()) {
      run.verdicts.add(what, scene.title, at_least(target), {kNotMeasured}, kNoTable);
      return;
    }
    run.verdicts.add(what, scene.title, at_least(target),
                     {before.empty() ? kNotMeasured : median_ratio(before, now)},
                     before_and_now(old, median(now)));
  };
  add("whole process, file to a table of shares", shares);
  add("whole process, file to a JSON result", json);
}

}  // namespace

void measure_whole_process(TargetRun& run) {
  measure(run, quads(run.size(1000, 10'000)), 3);
  measure(run, city(run.size(200, 2000)), 3);
  if (run.extent == Extent::kLong) measure(run, city(200'000), 2);
}

}  // namespace gnomon::bench
