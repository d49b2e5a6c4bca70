// SPDX-License-Identifier: GPL-3.0-or-later
#include "child.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "answers.h"
#include "machine.h"
#include "process.h"

namespace gnomon::bench {
namespace {

/// A line such as "VmHWM:  1234 kB" of this process's status, in bytes. Unlike the resource usage,
/// it does not begin with the parent's.
std::uint64_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line)) {
    if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1)) * 1024;
  }
  return 0;
}

[[noreturn]] void stop(const std::string& why) {
  fmt::print(stderr, "gnomon_bench: child process: {}\n", why);
  std::exit(2);
}

}  // namespace

ChildReport run_in_child(const SceneRecipe& recipe, MethodId algorithm, unsigned jobs,
                         MethodId area_algorithm) {
  std::vector<std::string> words = {"child",
                                    recipe.generator,
                                    std::to_string(static_cast<int>(recipe.coordinates)),
                                    std::to_string(static_cast<int>(algorithm)),
                                    std::to_string(static_cast<int>(area_algorithm)),
                                    std::to_string(jobs)};
  for (const auto& [name, value] : recipe.parameters) {
    words.push_back(name);
    words.push_back(std::to_string(value));
  }
  const std::optional<ProcessRun> run = run_process("/proc/self/exe", words, Keep::kOutput);
  if (!run || run->status != 0) stop("failed on " + recipe.generator);
  ChildReport report;
  std::istringstream in(run->text);
  in >> report.polygons >> report.facing >> report.fragments >> report.nodes >>
      report.prepare_wall >> report.prepare_cpu >> report.shadow_wall >> report.shadow_cpu >>
      report.scene_bsp_cpu >> report.lit_lower >> report.lit_upper >> report.peak_bytes >>
      report.shadow_bytes;
  if (!in) stop("cannot read its report: " + run->text);
  return report;
}

int child_main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  if (argc < 5 || argc % 2 != 1) return 2;
  SceneRecipe recipe{argv[0], {}, static_cast<Coordinates>(std::atoi(argv[1]))};
  ShadowOptions options;
  options.method.point = static_cast<MethodId>(std::atoi(argv[2]));
  options.method.area = static_cast<MethodId>(std::atoi(argv[3]));
  options.tuning.jobs = static_cast<unsigned>(std::atoi(argv[4]));
  for (int i = 5; i < argc; i += 2) recipe.parameters[argv[i]] = std::atoll(argv[i + 1]);

  const Scene scene = generated(recipe);
  ChildReport report;
  Clock::time_point start = Clock::now();
  double cpu_start = cpu_seconds();
  const PreparedScene prepared = prepared_or_stop(scene);
  report.prepare_wall = since(start);
  report.prepare_cpu = cpu_seconds() - cpu_start;
  const std::uint64_t resident = status_bytes("VmRSS");
  start = Clock::now();
  cpu_start = cpu_seconds();
  const ShadowResult result = shadows_or_stop(prepared, options);
  report.shadow_wall = since(start);
  report.shadow_cpu = cpu_seconds() - cpu_start;
  report.scene_bsp_cpu = result.scene_bsp_seconds;
  report.peak_bytes = status_bytes("VmHWM");
  report.shadow_bytes = report.peak_bytes > resident ? report.peak_bytes - resident : 0;
  report.polygons = prepared.parts.size();
  report.fragments = total_fragments(result);
  for (const LightResult& light : result.lights) {
    report.facing += light.facing_parts;
    report.nodes += light.tree_nodes;
    for (const PartResult& part : light.parts) {
      report.lit_lower += part.lit.lower;
      report.lit_upper += part.lit.upper;
    }
  }
  fmt::print("{} {} {} {} {} {} {} {} {} {} {} {} {}\n", report.polygons, report.facing,
             report.fragments, report.nodes, report.prepare_wall, report.prepare_cpu,
             report.shadow_wall, report.shadow_cpu, report.scene_bsp_cpu, report.lit_lower,
             report.lit_upper, report.peak_bytes, report.shadow_bytes);
  return 0;
}

}  // namespace gnomon::bench
