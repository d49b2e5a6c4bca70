// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon_bench [--short | --long] [PART...] [--benchmark_...]
//
// Parts: targets kernels area papers scene-bsp pitfalls thickness systems; all but the last three
// by default.
// Exit status: 0; 1 if exact kernels, algorithms or peers gave different answers, or fractions that
// do not add up to 1; 2 bad usage. (`child` and `measure` with their arguments are for the program
// itself: child.h, comparison/run_measurement.h.)
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "child.h"
#include "comparison/run_measurement.h"
#include "machine.h"
#include "parts.h"

namespace {

constexpr const char* kUsage =
    "usage: gnomon_bench [--short | --long] [PART...] [--benchmark_...]\n"
    "\n"
    "  targets    what the core was to reach beside what it does: doubles, other exact numbers,\n"
    "             peers (where built), growth, a million polygons, threads\n"
    "  kernels    every kernel on generic, degenerate and nearly degenerate scenes\n"
    "  area       area lights: both algorithms, growth, Figure 8 of Chin & Feiner 1992\n"
    "  papers     the tables of Chin & Feiner 1989 and Slater 1992\n"
    "  scene-bsp  splits, depth, memory and time of the scene BSP\n"
    "  pitfalls   scenes that are known to hurt\n"
    "  thickness  plane thickness of the rounded kernels against wrong answers\n"
    "  systems    every system on every kernel, on all scenes, by size: the table of `gnomon\n"
    "             compare`\n"
    "\n"
    "Without PART: all but pitfalls, thickness and systems. --short takes seconds; --long adds a "
    "million\n"
    "polygons to the scene BSP, full sizes for the slow exact kernels, and repetitions. Options\n"
    "that begin with --benchmark_ go to Google Benchmark.\n";

struct NamedPart {
  std::string_view name;
  bool (*run)(gnomon::bench::Extent);
  bool usual;  // runs where no part is named
};
constexpr std::array<NamedPart, 8> kParts{{{"targets", gnomon::bench::run_targets, true},
                                           {"kernels", gnomon::bench::run_kernels, true},
                                           {"area", gnomon::bench::run_area, true},
                                           {"papers", gnomon::bench::run_papers, true},
                                           {"scene-bsp", gnomon::bench::run_scene_bsp, true},
                                           {"pitfalls", gnomon::bench::run_pitfalls, false},
                                           {"thickness", gnomon::bench::run_thickness, false},
                                           {"systems", gnomon::bench::run_systems, false}}};

}  // namespace

int main(int argc, char** argv) {
  using namespace gnomon::bench;
  if (argc > 1 && std::string_view(argv[1]) == "child") return child_main(argc - 2, argv + 2);
  if (argc == 3 && std::string_view(argv[1]) == "measure") {
    return gnomon::comparison::measurement_main(argv[2]);
  }
  benchmark::Initialize(&argc, argv);
  Extent extent = Extent::kUsual;
  std::array<bool, kParts.size()> chosen{};
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const auto part = std::find_if(kParts.begin(), kParts.end(),
                                   [word](const NamedPart& p) { return p.name == word; });
    if (word == "--short") {
      extent = Extent::kShort;
    } else if (word == "--long") {
      extent = Extent::kLong;
    } else if (word == "--help" || word == "-h") {
      fmt::print("{}", kUsage);
      return 0;
    } else if (part != kParts.end()) {
      chosen[static_cast<std::size_t>(part - kParts.begin())] = true;
    } else {
      fmt::print(stderr, "gnomon_bench: unknown '{}'\n{}", word, kUsage);
      return 2;
    }
  }
  const bool none = std::find(chosen.begin(), chosen.end(), true) == chosen.end();
  fmt::print("{}", machine_text());
  bool good = true;
  for (std::size_t i = 0; i < kParts.size(); ++i) {
    if (chosen[i] || (none && kParts[i].usual)) good = kParts[i].run(extent) && good;
  }
  if (!good) fmt::print(stderr, "gnomon_bench: answers that must agree differ; see above\n");
  return good ? 0 : 1;
}
