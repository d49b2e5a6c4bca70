// SPDX-License-Identifier: GPL-3.0-or-later
// The counts that the papers print, beside ours on scenes of the same kind and polygon count
// (theirs were never published as files, and light positions are unknown): growth and ranges, not
// equality.
//
// Paper-like setting: no balanced prefix, no merging of sibling fragments; kernel `plane`.
#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

#include "answers.h"
#include "machine.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"

namespace gnomon::bench {
namespace {

struct PaperRow {
  std::string scene, generator;
  Parameters parameters;
  std::vector<std::uint32_t> lights;
  // As printed in Chin & Feiner 1989, Table 1.
  std::string input, facing, edges, nodes, fragments;
  bool large = false;
};

const std::vector<PaperRow>& paper_rows() {
  static const std::vector<PaperRow> kRows = {
      {"solids, light 1", "solids", {}, {0}, "27", "12", "49", "144", "122"},
      {"solids, light 2", "solids", {}, {1}, "27", "15", "61", "140", "108"},
      {"solids, light 3", "solids", {}, {2}, "27", "15", "61", "31", "49"},
      {"solids, all three",
       "solids",
       {},
       {0, 1, 2},
       "27",
       "12,15,15",
       "49,61,61",
       "144,140,32",
       "475"},
      {"tetra & staircase", "tetra-staircase", {}, {0}, "126", "61", "227", "88", "537"},
      {"table and chair", "table-chair", {}, {0, 1}, "65", "33,32", "132,128", "210,169", "523"},
      {"room", "room", {}, {0, 1}, "106", "49,53", "196,212", "415,191", "813"},
      {"Tetra256", "tetra", {{"level", 4}}, {0}, "258", "130", "390", "577", "723"},
      {"Tetra1024", "tetra", {{"level", 5}}, {0}, "1026", "514", "1542", "2894", "3345", true},
  };
  return kRows;
}

ShadowOptions paper_options(std::vector<std::uint32_t> lights) {
  ShadowOptions options;
  options.method.point = MethodId::kSvbsp;
  options.lights = std::move(lights);
  options.method.prefix = false;
  options.output.merge = false;
  return options;
}

template <class Count>
std::string listed(const ShadowResult& result, const Count& count) {
  std::string text;
  for (const LightResult& light : result.lights) {
    text += (text.empty() ? "" : ",") + std::to_string(count(light));
  }
  return text;
}

void chin_feiner(Extent extent) {
  fmt::print(
      "\nChin & Feiner 1989, Table 1: ours / printed. No prefix, no merging. Fragments of several "
      "lights are cut by\nall of them in a pipeline; polygons that face no light are not "
      "counted.\n");
  Table table({"scene", "polygons", "front-facing", "their edges", "SVBSP nodes", "fragments"});
  for (const PaperRow& row : paper_rows()) {
    if (row.large && extent == Extent::kShort) continue;
    const PreparedScene scene = make_scene(row.generator, row.parameters);
    ShadowOptions options = paper_options(row.lights);
    options.output.combined = row.lights.size() > 1;
    const ShadowResult result = shadows_or_stop(scene, options);
    const std::string fragments =
        options.output.combined
            ? std::to_string(result.combined.size())
            : listed(result, [](const LightResult& l) { return l.fragment_total; });
    const auto both = [](const std::string& ours, const std::string& printed) {
      return ours + " / " + printed;
    };
    table.add(
        {row.scene, both(std::to_string(scene.parts.size()), row.input),
         both(listed(result, [](const LightResult& l) { return l.facing_parts; }), row.facing),
         both(listed(result, [](const LightResult& l) { return l.facing_edges; }), row.edges),
         both(listed(result, [](const LightResult& l) { return l.tree_nodes; }), row.nodes),
         both(fragments, row.fragments)});
  }
  table.print();
}

void slater(Extent extent) {
  fmt::print(
      "\nSlater 1992, recursive tetrahedron on a ground of one polygon, SVBSP column: ours / "
      "printed. Output counts\npolygons that face away as one each. Seconds: CPU time of "
      "scene BSP and shadows, SparcStation 1+.\n");
  struct Row {
    std::int64_t level;
    std::string polygons, after, output, seconds;
  };
  const std::array<Row, 3> rows{{{3, "65", "83", "178", "0.4"},
                                 {4, "257", "299", "773", "1.6"},
                                 {5, "1025", "1135", "3268", "7.3"}}};
  Table table({"N", "after scene BSP", "output", "output, merged", "output, prefix", "seconds"});
  for (const Row& row : rows) {
    if (row.level == 5 && extent == Extent::kShort) continue;
    const PreparedScene scene = make_scene("tetra", {{"level", row.level}, {"ground", 1}});
    const auto output = [&](const ShadowOptions& options) {
      const ShadowResult result = shadows_or_stop(scene, options);
      return std::to_string(total_fragments(result) + scene.parts.size() -
                            result.lights[0].facing_parts);
    };
    ShadowOptions merged = paper_options({0});
    merged.output.merge = true;
    ShadowOptions prefix = paper_options({0});
    prefix.method.prefix = true;
    const double start = cpu_seconds();
    const std::string plain = output(paper_options({0}));
    const double seconds = cpu_seconds() - start;
    table.add({std::to_string(scene.parts.size()) + " / " + row.polygons,
               std::to_string(scene_bsp_pieces(scene)) + " / " + row.after,
               plain + " / " + row.output, output(merged), output(prefix),
               fmt::format("{:.4f} / {}", seconds, row.seconds)});
  }
  table.print();
}

// Slater's rooms: 138 to 318 polygons, 228 to 798 after the scene BSP.
void slater_rooms(Extent extent) {
  fmt::print(
      "\nSlater 1992, rooms of 138 to 318 polygons (228 to 798 after the scene BSP, printed "
      "for the whole range),\none and two lamps.\n");
  Table table(
      {"polygons", "after scene BSP", "lamps", "facing", "SVBSP nodes", "fragments", "CPU ms"});
  for (const std::int64_t n : {138, 178, 218, 258, 318}) {
    if (extent == Extent::kShort && n > 138) break;
    for (const std::int64_t lamps : {1, 2}) {
      const PreparedScene scene = make_scene("slater-room", {{"n", n}, {"lights", lamps}});
      const ShadowResult result = shadows_or_stop(scene, paper_options({}));
      table.add({std::to_string(n), std::to_string(scene_bsp_pieces(scene)), std::to_string(lamps),
                 listed(result, [](const LightResult& l) { return l.facing_parts; }),
                 listed(result, [](const LightResult& l) { return l.tree_nodes; }),
                 listed(result, [](const LightResult& l) { return l.fragment_total; }),
                 short_number(1e3 * (result.scene_bsp_seconds + result.shadow_seconds))});
    }
  }
  table.print();
}

}  // namespace

bool run_papers(Extent extent) {
  chin_feiner(extent);
  slater(extent);
  slater_rooms(extent);
  return true;
}

}  // namespace gnomon::bench
