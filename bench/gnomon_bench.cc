// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon_bench [--short | --long] [--against COMMAND] [--json] [--plots FOLDER] [PART...]
//              [--benchmark_...]
//
// Parts: targets point kernels area papers scene-bsp lights pitfalls thickness systems pictures
// classes ridge; all but the last seven by default. Exit status: 0; 1 if exact kernels, algorithms
// or peers gave different answers, or fractions that do not add up to 1; 2 bad usage. (`child` and
// `measure` with their arguments are for the program itself: child.h,
// comparison/run_measurement.h.)
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <string_view>
#include <vector>

#include "arguments.h"
#include "child.h"
#include "comparison/run_measurement.h"
#include "machine.h"
#include "parts.h"

namespace {

using gnomon::bench::Arguments;

constexpr const char* kUsage =
    "usage: gnomon_bench [--short | --long] [--against COMMAND] [--json] [--plots FOLDER]\n"
    "                    [PART...] [--benchmark_...]\n"
    "\n"
    "  targets    how much faster point lights and suns are to be than another build's command "
    "and\n"
    "             than Clipper (where built), beside what was measured\n"
    "  point      point lights: doubles, other exact numbers, peers (where built), growth, a "
    "million\n"
    "             polygons, threads\n"
    "  kernels    every kernel on generic, degenerate and nearly degenerate scenes\n"
    "  area       area lights: both algorithms, growth, Figure 8 of Chin & Feiner 1992\n"
    "  papers     the tables of Chin & Feiner 1989 and Slater 1992, and Slater's times and "
    "figures\n"
    "  scene-bsp  splits, depth, memory and time of the scene BSP\n"
    "  lights     lights together: one of them moves, their order, memory\n"
    "  pitfalls   scenes that are known to hurt\n"
    "  thickness  plane thickness of the rounded kernels against wrong answers\n"
    "  systems    every system on every kernel, on all scenes, by size: the table of `gnomon\n"
    "             compare`, and pictures\n"
    "  pictures   samples a second of pictures, plane against double, and the oracle's time\n"
    "  classes    the three classes of Crow 1977: storage, time, growth, lines of code\n"
    "  ridge      the objects and cubes of Thakur, Cheng & Miura: look-ups, times, growth\n"
    "\n"
    "Without PART: all but lights, pitfalls, thickness, systems, pictures, classes and ridge.\n"
    "--short takes seconds; --long adds a million polygons to the targets and the scene BSP, full "
    "sizes\n"
    "for the slow exact kernels, and repetitions. --against names the gnomon command that the\n"
    "targets are ratios to; --json writes the targets alone, as JSON; --plots writes the figures\n"
    "of the papers to a folder. Options that begin with --benchmark_ go to Google Benchmark.\n";

struct NamedPart {
  std::string_view name;
  bool (*run)(const Arguments& arguments);
  bool usual;  // runs where no part is named
};

template <bool (*Part)(gnomon::bench::Extent)>
bool by_extent(const Arguments& arguments) {
  return Part(arguments.extent);
}

bool targets(const Arguments& arguments) {
  return gnomon::bench::run_targets(arguments.extent, arguments.against, arguments.json);
}

bool papers(const Arguments& arguments) {
  return gnomon::bench::run_papers(arguments.extent, arguments.plots);
}

// The targets come first: the peak memory of a program is never below that of who started it.
constexpr std::array<NamedPart, 13> kParts{
    {{"targets", targets, true},
     {"point", by_extent<gnomon::bench::run_point>, true},
     {"kernels", by_extent<gnomon::bench::run_kernels>, true},
     {"area", by_extent<gnomon::bench::run_area>, true},
     {"papers", papers, true},
     {"scene-bsp", by_extent<gnomon::bench::run_scene_bsp>, true},
     {"lights", by_extent<gnomon::bench::run_lights>, false},
     {"pitfalls", by_extent<gnomon::bench::run_pitfalls>, false},
     {"thickness", by_extent<gnomon::bench::run_thickness>, false},
     {"systems", by_extent<gnomon::bench::run_systems>, false},
     {"pictures", by_extent<gnomon::bench::run_pictures>, false},
     {"classes", by_extent<gnomon::bench::run_classes>, false},
     {"ridge", by_extent<gnomon::bench::run_ridge>, false}}};

}  // namespace

int main(int argc, char** argv) {
  using namespace gnomon::bench;
  if (argc > 1 && std::string_view(argv[1]) == "child") return child_main(argc - 2, argv + 2);
  if (argc == 3 && std::string_view(argv[1]) == "measure") {
    return gnomon::comparison::measurement_main(argv[2]);
  }
  benchmark::Initialize(&argc, argv);
  std::vector<std::string_view> names;
  for (const NamedPart& part : kParts) names.push_back(part.name);
  const std::vector<std::string_view> words(argv + 1, argv + argc);
  const auto [arguments, complaint] = read_arguments(words, names);
  if (!complaint.empty()) {
    fmt::print(stderr, "gnomon_bench: {}\n{}", complaint, kUsage);
    return 2;
  }
  if (arguments.help) {
    fmt::print("{}", kUsage);
    return 0;
  }
  if (!arguments.json) fmt::print("{}", machine_text());
  bool good = true;
  for (const NamedPart& part : kParts) {
    const bool wanted = arguments.parts.empty() ? part.usual : arguments.names(part.name);
    if (wanted) good = part.run(arguments) && good;
  }
  if (!good) fmt::print(stderr, "gnomon_bench: answers that must agree differ; see above\n");
  return good ? 0 : 1;
}
