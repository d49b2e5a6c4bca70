// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes that are known to hurt: many polygons at one projected edge or point, stacks of nearly
// coincident borders, long crossing sticks. What they cost, and how it grows.
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

#include "answers.h"
#include "machine.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

struct Pitfall {
  std::string name;
  std::function<PreparedScene(std::int64_t)> make;
};

const std::vector<Pitfall>& pitfalls() {
  static const std::vector<Pitfall> kPitfalls = {
      {"one edge (pages of a book)",
       [](std::int64_t n) {
         return make_scene("radial-fan", {{"n", n}, {"kind", 0}});
       }},
      {"one point (umbrella)",
       [](std::int64_t n) {
         return make_scene("radial-fan", {{"n", n}, {"kind", 2}});
       }},
      {"one point, at all depths", [](std::int64_t n) { return wheel_of_needles(n); }},
      {"nearly coincident borders", [](std::int64_t n) { return stack_of_sheets(n); }},
      {"long crossing sticks", [](std::int64_t n) { return long_sticks(n); }},
  };
  return kPitfalls;
}

}  // namespace

bool run_pitfalls(Extent extent) {
  fmt::print(
      "\nPitfalls: kernel plane, one thread; CPU time of scene BSP, shadows and certified areas;\n"
      "growth: exponent since the row above, and over all rows by least squares.\n");
  std::vector<std::int64_t> sizes = {250, 500, 1000, 2000, 4000};
  if (extent == Extent::kShort) sizes = {60, 120};
  Table table({"scene", "algorithm", "polygons", "BSP pieces", "fragments", "per polygon", "CPU s",
               "growth", "overall", "exact %"});
  bool good = true;
  for (const Pitfall& pitfall : pitfalls()) {
    std::vector<std::vector<double>> n(algorithms().size()), seconds(algorithms().size());
    for (const std::int64_t size : sizes) {
      const PreparedScene scene = pitfall.make(size);
      std::vector<ShadowResult> results;
      for (std::size_t a = 0; a < algorithms().size(); ++a) {
        ShadowOptions options;
        options.method.point = algorithms()[a].algorithm;
        options.tuning.jobs = 1;
        const double start = cpu_seconds();
        results.push_back(shadows_or_stop(scene, options));
        n[a].push_back(static_cast<double>(scene.parts.size()));
        seconds[a].push_back(cpu_seconds() - start);
        options.output.stage_counts = true;
        const StageCounts stages = shadows_or_stop(scene, options).stages;
        const std::uint64_t fragments = total_fragments(results.back());
        std::string growth, overall;
        if (n[a].size() > 1) {
          growth =
              fmt::format("n^{:.2f}", growth_exponent({n[a].end()[-2], n[a].back()},
                                                      {seconds[a].end()[-2], seconds[a].back()}));
        }
        if (size == sizes.back()) {
          overall = fmt::format("n^{:.2f}", growth_exponent(n[a], seconds[a]));
        }
        table.add(
            {pitfall.name, algorithms()[a].name, grouped(scene.parts.size()),
             grouped(results.back().bsp_fragments), grouped(fragments),
             short_number(static_cast<double>(fragments) / static_cast<double>(scene.parts.size())),
             short_number(seconds[a].back()), growth, overall,
             fmt::format("{:.2f}", 100.0 * static_cast<double>(stages.exact()) /
                                       static_cast<double>(stages.total()))});
      }
      for (const ShadowResult& result : results) {
        if (!enclosures_overlap(results[0], result)) {
          fmt::print("{}, {}: THE ALGORITHMS' CERTIFIED BOUNDS DO NOT OVERLAP\n", pitfall.name,
                     size);
          good = false;
        }
      }
    }
  }
  table.print();
  return good;
}

}  // namespace gnomon::bench
