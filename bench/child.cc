// SPDX-License-Identifier: GPL-3.0-or-later
#include "child.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "answers.h"
#include "machine.h"

extern char** environ;

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

/// What the child wrote; nothing if it could not be started or failed.
std::optional<std::string> output_of(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  posix_spawn_file_actions_addclose(&actions, ends[1]);
  pid_t child = 0;
  const int started =
      posix_spawn(&child, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t n = 0; started == 0 && (n = read(ends[0], buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int status = 0;
  if (started != 0 || waitpid(child, &status, 0) != child || status != 0) return std::nullopt;
  return text;
}

}  // namespace

ChildReport run_in_child(const SceneRecipe& recipe, MethodId algorithm, unsigned jobs,
                         MethodId area_algorithm) {
  std::vector<std::string> words = {"gnomon_bench",
                                    "child",
                                    recipe.generator,
                                    std::to_string(static_cast<int>(recipe.coordinates)),
                                    std::to_string(static_cast<int>(algorithm)),
                                    std::to_string(static_cast<int>(area_algorithm)),
                                    std::to_string(jobs)};
  for (const auto& [name, value] : recipe.parameters) {
    words.push_back(name);
    words.push_back(std::to_string(value));
  }
  const std::optional<std::string> text = output_of(words);
  if (!text) stop("failed on " + recipe.generator);
  ChildReport report;
  std::istringstream in(*text);
  in >> report.polygons >> report.facing >> report.fragments >> report.nodes >>
      report.prepare_wall >> report.prepare_cpu >> report.shadow_wall >> report.shadow_cpu >>
      report.scene_bsp_cpu >> report.lit_lower >> report.lit_upper >> report.peak_bytes >>
      report.shadow_bytes;
  if (!in) stop("cannot read its report: " + *text);
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
