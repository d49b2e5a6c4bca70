// SPDX-License-Identifier: GPL-3.0-or-later
// The counts that the papers print, beside ours on scenes of the same kind and polygon count
// (theirs were never published as files, and light positions are unknown): growth and ranges, not
// equality. Each number stands beside one of its own kind. Times of Slater: slater_times.cc.
//
// Paper-like setting: no balanced prefix, no merging of sibling fragments.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answers.h"
#include "papers.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

struct PaperRow {
  std::string scene, generator;
  Parameters parameters;
  std::vector<std::uint32_t> lights;
  // As printed in Chin & Feiner 1989, Table 1.
  std::string input, facing, edges, nodes, fragments;
  double seconds = 0;
  bool large = false;
};

const std::vector<PaperRow>& paper_rows() {
  static const std::vector<PaperRow> kRows = {
      {"solids, light 1", "solids", {}, {0}, "27", "12", "49", "144", "122", .62},
      {"solids, light 2", "solids", {}, {1}, "27", "15", "61", "140", "108", .68},
      {"solids, light 3", "solids", {}, {2}, "27", "15", "61", "31", "49", .23},
      {"solids, all three",
       "solids",
       {},
       {0, 1, 2},
       "27",
       "12,15,15",
       "49,61,61",
       "144,140,32",
       "475",
       5.33},
      {"tetra & staircase", "tetra-staircase", {}, {0}, "126", "61", "227", "88", "537", 1.96},
      {"table and chair",
       "table-chair",
       {},
       {0, 1},
       "65",
       "33,32",
       "132,128",
       "210,169",
       "523",
       4.97},
      {"room", "room", {}, {0, 1}, "106", "49,53", "196,212", "415,191", "813", 7.99},
      {"Tetra256", "tetra", {{"level", 4}}, {0}, "258", "130", "390", "577", "723", 4.15},
      {"Tetra1024",
       "tetra",
       {{"level", 5}},
       {0},
       "1026",
       "514",
       "1542",
       "2894",
       "3345",
       25.44,
       true},
  };
  return kRows;
}

template <class Count>
std::string listed(const ShadowResult& result, const Count& count) {
  std::string text;
  for (const LightResult& light : result.lights) {
    text += (text.empty() ? "" : ",") + std::to_string(count(light));
  }
  return text;
}

std::string fragments_of(const ShadowResult& result, const ShadowOptions& options) {
  if (options.output.combined) return std::to_string(result.combined.size());
  return listed(result, [](const LightResult& l) { return l.fragment_total; });
}

double number(const std::string& text) { return std::stod(text); }

constexpr int kRounds = 9;

/// How the tetrahedra grow from the smaller to the larger one.
struct Growth {
  double nodes = 0, fragments = 0;
};
Growth growth_of(const ShadowResult& small, const ShadowResult& large) {
  const auto ratio = [](std::uint64_t from, std::uint64_t to) {
    return static_cast<double>(to) / static_cast<double>(from);
  };
  return {ratio(small.lights[0].tree_nodes, large.lights[0].tree_nodes),
          ratio(small.lights[0].fragment_total, large.lights[0].fragment_total)};
}

/// Ratios of counts and of CPU time between the last two rows.
void tetrahedron_growth(const PaperRow& small_row, const PaperRow& large_row) {
  constexpr int kSmallRuns = 8;  // a round of the smaller one, so that clocks are fine enough
  const PreparedScene small = make_scene(small_row.generator, small_row.parameters);
  const PreparedScene large = make_scene(large_row.generator, large_row.parameters);
  const ShadowOptions identity = paper_options(small_row.lights);
  fmt::print("\n{} / {}: growth, and ratio of CPU time (median of {})\n", large_row.scene,
             small_row.scene, kRounds);
  Table table({"", "SVBSP nodes", "fragments", "seconds"});
  const auto add = [&](const std::string& name, const ShadowOptions& options) {
    const auto run = [&](const PreparedScene& scene, int times) {
      return [&scene, &options, times] {
        for (int i = 0; i < times; ++i) shadows_or_stop(scene, options);
      };
    };
    const std::vector<Times> times = interleaved({run(small, kSmallRuns), run(large, 1)}, kRounds);
    const Growth growth =
        growth_of(shadows_or_stop(small, options), shadows_or_stop(large, options));
    table.add({name, fmt::format("{:.2f}", growth.nodes), fmt::format("{:.2f}", growth.fragments),
               fmt::format("{:.2f}", kSmallRuns * median_ratio(times[1].cpu, times[0].cpu))});
  };
  add("plane, identity", identity);
  add("double, planes of all edges", plane_of_every_edge(identity));
  table.add({"printed", fmt::format("{:.2f}", number(large_row.nodes) / number(small_row.nodes)),
             fmt::format("{:.2f}", number(large_row.fragments) / number(small_row.fragments)),
             fmt::format("{:.2f}", large_row.seconds / small_row.seconds)});
  table.print();
}

void chin_feiner(Extent extent) {
  fmt::print(
      "\nChin & Feiner 1989, Table 1: ours / printed. No prefix, no merging. Nodes: the paper's "
      "program made a plane of\nevery edge, also of those that splits made; so does kernel double "
      "without identity (all edges). Kernel plane\n(identity) knows the plane that made an edge. "
      "Fragments (plane / printed) of several lights are cut by all of them\nin a pipeline; "
      "polygons that face no light are not counted. Time: CPU, median of 9, plane / HP "
      "9000/350.\n");
  Table table({"scene", "polygons", "front-facing", "their edges", "nodes, all edges",
               "nodes, identity", "fragments", "time"});
  const std::vector<PaperRow>& rows = paper_rows();
  for (const PaperRow& row : rows) {
    if (row.large && extent == Extent::kShort) continue;
    const PreparedScene scene = make_scene(row.generator, row.parameters);
    ShadowOptions options = paper_options(row.lights);
    options.output.combined = row.lights.size() > 1;
    const ShadowResult result = shadows_or_stop(scene, options);
    const double seconds =
        median(interleaved({[&] { shadows_or_stop(scene, options); }}, kRounds)[0].cpu);
    const ShadowResult all_edges = shadows_or_stop(scene, plane_of_every_edge(options));
    const auto nodes = [](const LightResult& l) { return l.tree_nodes; };
    table.add(
        {row.scene, beside(std::to_string(scene.parts.size()), row.input),
         beside(listed(result, [](const LightResult& l) { return l.facing_parts; }), row.facing),
         beside(listed(result, [](const LightResult& l) { return l.facing_edges; }), row.edges),
         beside(listed(all_edges, nodes), row.nodes), listed(result, nodes),
         beside(fragments_of(result, options), row.fragments),
         fmt::format("{:.2f} ms / {:.2f} s", 1e3 * seconds, row.seconds)});
  }
  table.print();
  if (extent != Extent::kShort) tetrahedron_growth(rows[rows.size() - 2], rows.back());
}

/// Shadow polygons: the fragments of facing polygons that are in shadow.
std::uint64_t shadow_polygons(const ShadowResult& result) {
  std::uint64_t count = 0;
  for (const LightResult& light : result.lights) {
    count += static_cast<std::uint64_t>(
        std::ranges::count(light.fragments, LightState::kShadow, &Fragment::state));
  }
  return count;
}

struct TetrahedronRow {
  std::int64_t level;
  std::string polygons, after, seconds;
  std::map<std::string_view, double> output;  // by the name of the method
};

void slater(Extent extent) {
  fmt::print(
      "\nSlater 1992, Table 3: recursive tetrahedron on a ground of one polygon, ours / printed. "
      "Output: pieces of the\nscene BSP (all polygons) and shadow polygons; basic and tiling by "
      "cover=overlay. Time: CPU, median of 9, scene BSP and\nshadows by svbsp / SparcStation "
      "1+.\n");
  const std::array<TetrahedronRow, 3> rows{
      {{3, "65", "83", "0.4", {{"basic", 158}, {"tiling", 158}, {"svbsp", 178}}},
       {4, "257", "299", "1.6", {{"basic", 649}, {"tiling", 649}, {"svbsp", 773}}},
       {5, "1025", "1135", "7.3", {{"basic", 2672}, {"tiling", 2672}, {"svbsp", 3268}}}}};
  constexpr std::array<std::string_view, 3> kPrinted = {"basic", "tiling", "svbsp"};
  std::vector<std::string> header = {"N", "after scene BSP"};
  for (const std::string_view name : kPrinted) header.push_back("output, " + std::string(name));
  header.insert(header.end(), {"svbsp / basic", "time"});
  Table table(header);
  for (const TetrahedronRow& row : rows) {
    if (row.level == 5 && extent == Extent::kShort) continue;
    const PreparedScene scene = make_scene("tetra", {{"level", row.level}, {"ground", 1}});
    const std::uint64_t pieces = scene_bsp_pieces(scene);
    // Every method for point lights that the paper's table has and ours has, too.
    std::map<std::string_view, double> output;
    double seconds = 0;
    for (const Method& method : methods()) {
      if (!method.lights.point || !row.output.contains(method.name)) continue;
      ShadowOptions options = paper_options({0});
      options.method.point = method.id;
      // As in the paper: shadow polygons over polygons that stay whole.
      if (method.overlays) options.method.options.cover = Cover::kOverlay;
      const ShadowResult result = shadows_or_stop(scene, options);
      if (method.id == MethodId::kSvbsp) {
        seconds = median(interleaved({[&] { shadows_or_stop(scene, options); }}, kRounds)[0].cpu);
      }
      output[method.name] = static_cast<double>(pieces + shadow_polygons(result));
    }
    std::vector<std::string> cells = {beside(std::to_string(scene.parts.size()), row.polygons),
                                      beside(std::to_string(pieces), row.after)};
    const auto text = [](const std::map<std::string_view, double>& outputs, std::string_view name) {
      const auto found = outputs.find(name);
      return found == outputs.end() ? std::string("-") : fmt::format("{:.0f}", found->second);
    };
    for (const std::string_view name : kPrinted) {
      cells.push_back(beside(text(output, name), text(row.output, name)));
    }
    const auto ratio = [](const std::map<std::string_view, double>& outputs) {
      const auto svbsp = outputs.find("svbsp"), basic = outputs.find("basic");
      const bool both = svbsp != outputs.end() && basic != outputs.end();
      return both ? fmt::format("{:.2f}", svbsp->second / basic->second) : std::string("-");
    };
    cells.push_back(beside(ratio(output), ratio(row.output)));
    cells.push_back(fmt::format("{:.2f} ms / {} s", 1e3 * seconds, row.seconds));
    table.add(std::move(cells));
  }
  table.print();
}

}  // namespace

ShadowOptions paper_options(std::vector<std::uint32_t> lights) {
  ShadowOptions options;
  options.method.point = MethodId::kSvbsp;
  options.lights = std::move(lights);
  options.method.prefix = false;
  options.output.merge = false;
  return options;
}

ShadowOptions plane_of_every_edge(ShadowOptions options) {
  options.kernel.id = KernelId::kDouble;
  options.kernel.identity = false;
  return options;
}

std::string beside(const std::string& ours, const std::string& printed) {
  return ours + " / " + printed;
}

bool run_papers(Extent extent, const std::string& plots) {
  chin_feiner(extent);
  slater(extent);
  return slater_times(extent, plots);
}

}  // namespace gnomon::bench
