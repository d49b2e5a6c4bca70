// SPDX-License-Identifier: GPL-3.0-or-later
// Every system on every kernel: the comparison of `gnomon compare` over the papers' scenes and the
// families of hard ones, as one table (comparison/README.md).
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "comparison/comparison.h"
#include "comparison/comparison_text.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/kernel_list.h"
#include "parts.h"

namespace gnomon::bench {
namespace {

/// Scenes of one size: Chin & Feiner 1989, Table 1; Slater 1992, Tables 1 to 3; 1992's area lights.
const std::vector<std::string> kPapers = {
    "solids",        "tetra-staircase",        "table-chair",       "room",
    "tetra:level=4", "tetra:level=3,ground=1", "slater-room:n=138", "figure-4f",
    "figure-6"};
/// Boxes on a lattice with room for all of them; pages, tiles and triangles as dense as they are.
const std::vector<std::string> kFamilies = {
    "city",         "quads",   "lattice:size=20", "coplanar-tiles", "touching-boxes:size=14",
    "nested-boxes", "pinwheel"};

std::vector<comparison::SceneSource> sources(const std::vector<std::string>& names) {
  std::vector<comparison::SceneSource> found;
  for (const std::string& name : names) {
    auto source = comparison::SceneSource::parse(name);
    if (!source) {
      fmt::print(stderr, "gnomon_bench: {}\n", to_string(source.error()));
      std::exit(2);
    }
    found.push_back(std::move(*source));
  }
  return found;
}

comparison::ComparePlan plan_of(Extent extent) {
  comparison::ComparePlan plan;
  for (const KernelInfo& info : kernel_list()) {
    if (has_kernel(info.id)) plan.kernels.emplace_back(info.name);
  }
  if (extent == Extent::kShort) {
    // Few polygons, once each: the table's form and its verdicts, not its times.
    plan.scenes = sources({"solids", "table-chair", "city", "quads", "lattice", "coplanar-tiles",
                           "touching-boxes", "nested-boxes", "pinwheel"});
    plan.sizes = {12, 48};
    plan.repeat = 1;
    plan.kernels = {"double", "plane"};
    plan.limits.seconds = 5;
    return plan;
  }
  std::vector<std::string> names = kPapers;
  names.insert(names.end(), kFamilies.begin(), kFamilies.end());
  plan.scenes = sources(names);
  plan.sizes = {100, 1000, 10'000};
  plan.limits.seconds = extent == Extent::kLong ? 600 : 30;
  // The oracle takes longer than most of what it judges.
  plan.certify_up_to = extent == Extent::kLong ? 1000 : 300;
  if (extent != Extent::kLong) plan.most_polygons = {{"epeck", 1000}, {"rational", 1000}};
  return plan;
}

}  // namespace

bool run_systems(Extent extent) {
  const comparison::ComparePlan plan = plan_of(extent);
  fmt::print(
      "\nSystems: every run is a process of its own on one thread, of at most {} s. Time is CPU "
      "time as a ratio to\nsvbsp (area lights: receiver) on double on the same scene; growth is "
      "the exponent over all sizes.\n",
      plan.limits.seconds);
  std::fflush(stdout);
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const auto done = comparison::compare(plan, {program, {"measure"}});
  if (!done) {
    fmt::print(stderr, "gnomon_bench: {}\n", to_string(done.error()));
    return false;
  }
  fmt::print("{}", comparison::comparison_text(*done));
  return run_pictures(extent) && done->contradictions.empty();
}

}  // namespace gnomon::bench
