// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon_bench [--short | --long] [PART...] [--benchmark_...]
//
// Parts: kernels papers scene-bsp thickness; all but the last by default. Exit status: 0; 1 if
// exact kernels gave different answers or fractions that do not add up to 1; 2 bad usage.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <vector>

#include "machine.h"
#include "parts.h"

namespace {

constexpr const char* kUsage =
    "usage: gnomon_bench [--short | --long] [PART...] [--benchmark_...]\n"
    "\n"
    "  kernels    every kernel on generic, degenerate and nearly degenerate scenes\n"
    "  papers     the tables of Chin & Feiner 1989 and Slater 1992\n"
    "  scene-bsp  splits, depth, memory and time of the scene BSP\n"
    "  thickness  plane thickness of the rounded kernels against wrong answers\n"
    "\n"
    "Without PART: kernels, papers and scene-bsp. --short takes seconds, --long adds a million\n"
    "polygons. Options that begin with --benchmark_ go to Google Benchmark.\n";

}  // namespace

int main(int argc, char** argv) {
  using namespace gnomon::bench;
  benchmark::Initialize(&argc, argv);
  Extent extent = Extent::kUsual;
  std::vector<std::string> parts;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--short") {
      extent = Extent::kShort;
    } else if (word == "--long") {
      extent = Extent::kLong;
    } else if (word == "--help" || word == "-h") {
      fmt::print("{}", kUsage);
      return 0;
    } else if (word == "kernels" || word == "papers" || word == "scene-bsp" ||
               word == "thickness") {
      parts.push_back(word);
    } else {
      fmt::print(stderr, "gnomon_bench: unknown '{}'\n{}", word, kUsage);
      return 2;
    }
  }
  if (parts.empty()) parts = {"kernels", "papers", "scene-bsp"};
  fmt::print("{}", machine_text());
  bool good = true;
  for (const std::string& part : parts) {
    if (part == "kernels") good = run_kernels(extent) && good;
    if (part == "papers") good = run_papers(extent) && good;
    if (part == "scene-bsp") good = run_scene_bsp(extent) && good;
    if (part == "thickness") good = run_thickness(extent) && good;
  }
  if (!good) fmt::print(stderr, "gnomon_bench: exact kernels disagree; see above\n");
  return good ? 0 : 1;
}
