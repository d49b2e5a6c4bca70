// SPDX-License-Identifier: GPL-3.0-or-later
// Several lights together by svbsp (docs/moving-lights.md): what a light that moves costs beside
// computing all lights anew, how many fragments each order of lights makes, what trees of polygons
// and trees of fragments are like, and what is kept in memory.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "answers.h"
#include "gnomon/scene/light_arguments.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

/// Of computing all three lights anew, at most, where the last of them moves.
constexpr double kMostForLast = 0.45;

/// A scene under so many point lights: its own first, then some of these, in units of its box.
struct LitScene {
  std::string name;
  SceneRecipe recipe;
  std::size_t lights = 3;
  bool large = false;
};

const std::vector<LitScene>& lit_scenes() {
  static const std::vector<LitScene> kScenes = {
      {"solids", {"solids", {}}},
      {"solids, 4 lamps", {"solids", {}}, 4},
      {"table and chair", {"table-chair", {}}},
      {"tetra & staircase", {"tetra-staircase", {}}},
      {"room", {"room", {}}},
      {"room, 4 lamps", {"room", {}}, 4},
      {"Tetra256", {"tetra", {{"level", 4}, {"ground", 1}}}},
      {"Slater's room", {"slater-room", {{"n", 318}}}},
      {"city", {"city", {{"n", 1000}}}, 3, true},
      {"quads", {"quads", {{"n", 1000}}}, 3, true},
  };
  return kScenes;
}

/// A point of the scene's box, or above it.
Position in_box(const Scene& scene, const std::array<double, 3>& share) {
  Position place;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = scene.vertices[0][k].nearest(), high = low;
    for (const Position& vertex : scene.vertices) {
      low = std::min(low, vertex[k].nearest());
      high = std::max(high, vertex[k].nearest());
    }
    place[k] = Number(std::floor(low + (high - low) * share[k]));
  }
  return place;
}

Light lamp(std::size_t index, Position place) {
  Light light;
  light.id = "lamp" + std::to_string(index);
  light.position = std::move(place);
  return light;
}

/// Its point lights, made as many as asked for.
Scene scene_of(const LitScene& lit) {
  constexpr std::array<std::array<double, 3>, 4> kPlaces{
      {{0.31, 0.27, 0.93}, {0.72, 0.64, 0.97}, {0.18, 0.81, 0.95}, {0.55, 0.12, 0.9}}};
  Scene scene = generated(lit.recipe);
  std::erase_if(scene.lights, [](const Light& light) { return !light.is_point(); });
  if (scene.lights.size() > lit.lights) scene.lights.resize(lit.lights);
  while (scene.lights.size() < lit.lights) {
    const std::size_t i = scene.lights.size();
    scene.lights.push_back(lamp(100 + i, in_box(scene, kPlaces[i])));
  }
  return scene;
}

ShadowOptions together() {
  ShadowOptions options;
  options.output.combined = true;
  options.output.points = true;
  options.tuning.jobs = 1;
  return options;
}

double cpu_now() { return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC); }

struct Moved {
  double share = 0;  // of the time of computing all
  TogetherCounts counts;
};

/// Light `slot` goes from place to place, and at each of them all lights are computed anew, in
/// turn.
Moved move_light(Scene scene, std::size_t slot) {
  constexpr std::array<std::array<double, 3>, 7> kPlaces{{{0.4, 0.4, 0.9},
                                                          {0.45, 0.35, 0.9},
                                                          {0.5, 0.3, 0.92},
                                                          {0.55, 0.35, 0.94},
                                                          {0.6, 0.4, 0.92},
                                                          {0.55, 0.45, 0.9},
                                                          {0.5, 0.5, 0.9}}};
  const std::size_t lights = scene.lights.size();
  ShadowOptions options = together();
  options.lights.resize(lights);
  std::iota(options.lights.begin(), options.lights.end(), 0u);
  for (const auto& place : kPlaces) {
    options.steps.push_back(options.lights);
    options.steps.back()[slot] = static_cast<std::uint32_t>(scene.lights.size());
    scene.lights.push_back(lamp(scene.lights.size(), in_box(scene, place)));
  }
  const PreparedScene prepared = prepared_or_stop(scene);
  std::vector<double> step_seconds, all_seconds;
  Moved moved;
  std::size_t step = 0;
  double start = cpu_now();
  options.control.step_done = [&](const ShadowResult& result) {
    if (step > 0) step_seconds.push_back(cpu_now() - start);
    // The last step keeps nothing for later.
    if (step + 1 == kPlaces.size()) moved.counts = result.together;
    if (step > 0) {
      ShadowOptions anew = together();
      anew.lights = options.steps[step - 1];
      start = cpu_now();
      shadows_or_stop(prepared, anew);
      all_seconds.push_back(cpu_now() - start);
    }
    ++step;
    start = cpu_now();
    return true;
  };
  shadows_or_stop(prepared, options);
  moved.share = median_ratio(step_seconds, all_seconds);
  return moved;
}

bool moving(Extent extent) {
  fmt::print(
      "\nOne of several lights moves: CPU time of a step, output of points included, as a share of "
      "computing all lights\nanew (median of 7 places), and the loops that trees filter, as a "
      "share. "
      "The last of three is to take at most {:.0f} %.\n",
      100 * kMostForLast);
  Table table({"scene", "polygons", "lights", "the first", "the second", "the third", "the fourth",
               "filtered", "kept kB", "trees kB", "target"});
  bool good = true;
  for (const LitScene& lit : lit_scenes()) {
    if (lit.large && extent == Extent::kShort) continue;
    const Scene scene = scene_of(lit);
    std::vector<std::string> cells{lit.name, std::to_string(scene.polygons.size()),
                                   std::to_string(lit.lights)};
    Moved last;
    for (std::size_t slot = 0; slot < lit.lights; ++slot) {
      last = move_light(scene, slot);
      cells.push_back(fmt::format("{:.0f} %", 100 * last.share));
    }
    if (lit.lights < 4) cells.emplace_back("-");
    cells.push_back(
        fmt::format("{:.0f} %", 100 * static_cast<double>(last.counts.filters) /
                                    static_cast<double>(last.counts.filters_from_nothing)));
    cells.push_back(grouped(last.counts.kept_bytes / 1000));
    cells.push_back(grouped(last.counts.tree_bytes / 1000));
    const bool met = last.share <= kMostForLast;
    good = good && met;
    cells.emplace_back(met ? "met" : "missed");
    table.add(std::move(cells));
  }
  table.print();
  return good;
}

std::size_t combined_fragments(const PreparedScene& prepared, ShadowOptions options) {
  return shadows_or_stop(prepared, options).combined.size();
}

/// Place among all counts, the fewest being 1.
std::string ranked(std::size_t count, const std::vector<std::size_t>& sorted) {
  const auto rank = std::ranges::lower_bound(sorted, count) - sorted.begin() + 1;
  return fmt::format("{} ({})", grouped(count), rank);
}

void orders(Extent extent) {
  fmt::print(
      "\nOrder of lights: fragments of all orders, and those of two heuristics with their rank (1: "
      "the fewest). The mover\nlast: the mean rank of the orders in which some light is last and "
      "the others come by facing.\n");
  Table table({"scene", "lights", "fewest", "mean", "most", "file", "facing", "mover last"});
  for (const LitScene& lit : lit_scenes()) {
    if (lit.large && extent != Extent::kLong) continue;
    const PreparedScene prepared = prepared_or_stop(scene_of(lit));
    std::vector<std::uint32_t> order(lit.lights);
    std::iota(order.begin(), order.end(), 0u);
    std::vector<std::size_t> counts;
    do {
      ShadowOptions options = together();
      options.lights = order;
      counts.push_back(combined_fragments(prepared, options));
    } while (std::ranges::next_permutation(order).found);
    std::ranges::sort(counts);
    ShadowOptions options = together();
    const std::size_t file = combined_fragments(prepared, options);
    options.method.point = MethodId::kSvbsp;
    options.method.options.light_order = LightOrder::kFacing;
    const ShadowResult by_facing = shadows_or_stop(prepared, options);
    std::vector<std::uint32_t> facing(lit.lights);
    std::iota(facing.begin(), facing.end(), 0u);
    std::ranges::stable_sort(facing, {},
                             [&](std::uint32_t i) { return by_facing.lights[i].facing_parts; });
    double ranks = 0;
    for (std::uint32_t last = 0; last < lit.lights; ++last) {
      ShadowOptions own = together();
      std::ranges::copy_if(facing, std::back_inserter(own.lights),
                           [&](std::uint32_t light) { return light != last; });
      own.lights.push_back(last);
      ranks += static_cast<double>(
          std::ranges::lower_bound(counts, combined_fragments(prepared, own)) - counts.begin() + 1);
    }
    const double sum = static_cast<double>(std::accumulate(counts.begin(), counts.end(), 0ull));
    table.add(
        {lit.name, std::to_string(lit.lights), grouped(counts.front()),
         short_number(sum / static_cast<double>(counts.size())), grouped(counts.back()),
         ranked(file, counts), ranked(by_facing.combined.size(), counts),
         fmt::format("{:.1f} of {}", ranks / static_cast<double>(lit.lights), counts.size())});
  }
  table.print();
}

std::string listed_nodes(const ShadowResult& result) {
  std::string text;
  for (const LightResult& light : result.lights) {
    text += (text.empty() ? "" : ", ") + grouped(light.tree_nodes);
  }
  return text;
}

/// As the paper's program: a plane of every edge, no prefix, no merging.
void growth() {
  fmt::print(
      "\nWhat trees grow from, as in Chin & Feiner 1989, Table 1 (no prefix, no merging; kernel "
      "double, a plane of every\nedge): nodes of each light alone, of all together grown from the "
      "polygons, and from the fragments that earlier\nlights left; and the fragments at the end. "
      "Printed: solids 144, 140, 31 alone and 144, 140, 32 together.\n");
  Table table({"scene", "alone", "from polygons", "from fragments", "fragments", "from fragments"});
  for (const char* generator : {"solids", "table-chair", "room"}) {
    const PreparedScene prepared = make_scene(generator, {});
    ShadowOptions options;
    options.kernel.id = KernelId::kDouble;
    options.method.point = MethodId::kSvbsp;
    options.method.prefix = false;
    options.output.merge = false;
    const std::string alone = listed_nodes(shadows_or_stop(prepared, options));
    options.output.combined = true;
    const ShadowResult polygons = shadows_or_stop(prepared, options);
    options.method.options.grow = GrowFrom::kFragments;
    const ShadowResult fragments = shadows_or_stop(prepared, options);
    table.add({generator, alone, listed_nodes(polygons), listed_nodes(fragments),
               grouped(polygons.combined.size()), grouped(fragments.combined.size())});
  }
  table.print();
}

void memory(Extent extent) {
  fmt::print(
      "\nTrees in memory: each is dropped when its light is done, so that the most at one time are "
      "those of one light.\n");
  Table table({"scene", "lights", "all trees kB", "at one time kB", "share"});
  for (const LitScene& lit : lit_scenes()) {
    if (lit.large && extent == Extent::kShort) continue;
    const TogetherCounts counts =
        shadows_or_stop(prepared_or_stop(scene_of(lit)), together()).together;
    table.add({lit.name, std::to_string(lit.lights), grouped(counts.tree_bytes / 1000),
               grouped(counts.tree_bytes_at_once / 1000),
               fmt::format("{:.0f} %", 100 * static_cast<double>(counts.tree_bytes_at_once) /
                                           static_cast<double>(counts.tree_bytes))});
  }
  table.print();
}

}  // namespace

bool run_lights(Extent extent) {
  const bool good = moving(extent);
  orders(extent);
  growth();
  memory(extent);
  if (!good) fmt::print("\nThe last of three lights takes more than its share somewhere.\n");
  return true;
}

}  // namespace gnomon::bench
