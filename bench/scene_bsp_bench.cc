// SPDX-License-Identifier: GPL-3.0-or-later
// The scene BSP by itself, over all polygons in random order: it is the part of the pipeline whose
// cost on large scenes is least known.
#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "algorithms/scene_bsp/scene_bsp.inl.h"
#include "kernel/implicit/implicit_scene_space.h"
#include "machine.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"

namespace gnomon::bench {
namespace {

template <class Space>
auto whole_tree(Space& space, const PreparedScene& scene, Roots roots = Roots::kChosen) {
  std::vector<std::uint32_t> parts(scene.parts.size());
  std::iota(parts.begin(), parts.end(), 0u);
  return build_scene_bsp(space, scene, parts, 1, true, nullptr, 100'000'000, {}, roots);
}

PreparedScene family(const std::string& name, std::int64_t n) {
  if (name == "city") return make_scene("city", {{"n", n / 5}});
  if (name == "quads") return make_scene("quads", {{"n", n}});
  return long_sticks(n);
}

}  // namespace

std::uint64_t scene_bsp_pieces(const PreparedScene& scene, Roots roots) {
  ImplicitSceneSpace<NoStats> space(scene.geometry, {});
  return whole_tree(space, scene, roots).node_pieces.size();
}

bool run_scene_bsp(Extent extent) {
  fmt::print(
      "\nScene BSP over all polygons in random order, kernel plane. Memory: of the finished "
      "tree, without the scene.\n");
  Table table({"scene", "polygons", "pieces", "splits %", "nodes", "depth", "CPU s", "growth", "MB",
               "bytes/piece", "exact %"});
  std::vector<std::int64_t> sizes = {1000, 10000, 100000};
  if (extent == Extent::kShort) sizes = {1000};
  if (extent == Extent::kLong) sizes.push_back(1000000);
  for (const std::string name : {"city", "quads", "long sticks"}) {
    double last_seconds = 0, last_n = 0;
    for (const std::int64_t n : sizes) {
      if (name == "long sticks" && n > 100000) continue;  // 26 million pieces, 13 GB
      const PreparedScene scene = family(name, n);
      const std::size_t before = bytes_in_use();
      const double start = cpu_seconds();
      ImplicitSceneSpace<CountStats> space(scene.geometry, {});
      const auto tree = whole_tree(space, scene);
      const double seconds = cpu_seconds() - start;
      const std::size_t after = bytes_in_use();
      const double bytes = after > before ? static_cast<double>(after - before) : 0;
      const StageCounts stages = space.stage_counts();
      const auto polygons = static_cast<double>(scene.parts.size());
      // The exponent of n since the row above.
      const std::string growth = last_n > 0
                                     ? fmt::format("n^{:.2f}", std::log(seconds / last_seconds) /
                                                                   std::log(polygons / last_n))
                                     : "";
      table.add({name, grouped(scene.parts.size()), grouped(tree.node_pieces.size()),
                 short_number(100 * static_cast<double>(tree.splits) / polygons),
                 grouped(tree.nodes.size()), std::to_string(tree.depth), short_number(seconds),
                 growth, short_number(bytes / 1e6),
                 short_number(bytes / static_cast<double>(tree.node_pieces.size())),
                 fmt::format("{:.2f}", 100.0 * static_cast<double>(stages.exact()) /
                                           static_cast<double>(stages.total()))});
      last_seconds = seconds;
      last_n = polygons;
    }
  }
  table.print();
  return true;
}

}  // namespace gnomon::bench
