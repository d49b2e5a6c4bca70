// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/loops/ridge_loops_report.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/components.h"
#include "report/json/json_writer.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::report {

namespace {

std::string_view name_of(RidgeKind kind) {
  switch (kind) {
    case RidgeKind::kVisible:
      return "VRE";
    case RidgeKind::kHidden:
      return "HRE";
    case RidgeKind::kBorder:
      break;
  }
  return "border";
}

/// Sums of one component, or of all.
struct LoopCounts {
  std::uint64_t facing = 0, visible = 0, hidden = 0, border = 0;
  std::uint64_t of_visible = 0, of_others = 0;  // crossings: of two VREs, and with an HRE or border
  std::uint64_t external = 0, holes = 0, internal = 0, imaginary = 0;
  std::uint64_t pairs = 0, all_pairs = 0;

  void add(const RidgeLoops& loops) {
    facing += loops.facing_parts;
    for (const RidgeEdge& edge : loops.edges) {
      ++(edge.kind == RidgeKind::kVisible  ? visible
         : edge.kind == RidgeKind::kHidden ? hidden
                                           : border);
    }
    for (const PseudoIntersection& crossing : loops.crossings) {
      const bool both = loops.edges[crossing.first].kind == RidgeKind::kVisible &&
                        loops.edges[crossing.second].kind == RidgeKind::kVisible;
      ++(both ? of_visible : of_others);
    }
    for (const RidgeLoop& loop : loops.loops) {
      ++(loop.kind == LoopKind::kExternal ? external
         : loop.kind == LoopKind::kHole   ? holes
                                          : internal);
      imaginary +=
          static_cast<std::uint64_t>(std::ranges::count_if(loop.steps, &LoopStep::imaginary));
    }
    pairs += loops.pairs;
    all_pairs += loops.all_pairs();
  }
};

std::vector<std::string> cells(const std::string& name, const LoopCounts& counts) {
  return {name,
          grouped(counts.facing),
          grouped(counts.visible),
          grouped(counts.hidden),
          grouped(counts.border),
          grouped(counts.of_visible),
          grouped(counts.of_others),
          grouped(counts.external),
          grouped(counts.holes),
          grouped(counts.internal)};
}

/// The polygon that a component begins with.
const std::string& first_polygon(const RidgeLoopsOf& all, const std::vector<Component>& components,
                                 const RidgeLoops& loops) {
  const std::uint32_t part = components[loops.component].parts.front();
  return all.scene.polygons[all.prepared.parts[part].polygon].id;
}

const Light& light_of(const RidgeLoopsOf& loops) {
  return loops.scene.lights[loops.prepared.lights[loops.light].light];
}

void write_edges(JsonWriter& json, const RidgeLoopsOf& all, const RidgeLoops& loops) {
  const auto polygon = [&](std::uint32_t part) -> std::string_view {
    return all.scene.polygons[all.prepared.parts[part].polygon].id;
  };
  json.key("edges");
  json.begin_array();
  for (const RidgeEdge& edge : loops.edges) {
    const EdgeEnds ends = all.prepared.geometry.edges[edge.edge.index()];
    json.begin_object(JsonLayout::kInline);
    for (const bool end : {false, true}) {
      json.key(end ? "to" : "from");
      json.begin_array(JsonLayout::kInline);
      const VertexId vertex = edge.edge.flipped() != end ? ends.b : ends.a;
      for (const double c : all.prepared.geometry.positions[vertex]) json.value(c);
      json.end_array();
    }
    json.member("kind", name_of(edge.kind));
    json.member("facing", polygon(edge.facing));
    if (edge.hidden != RidgeEdge::kNone) json.member("hidden", polygon(edge.hidden));
    json.end_object();
  }
  json.end_array();
}

void write_crossings(JsonWriter& json, const RidgeLoops& loops) {
  json.key("crossings");
  json.begin_array();
  for (const PseudoIntersection& crossing : loops.crossings) {
    json.begin_object(JsonLayout::kInline);
    json.key("edges");
    json.begin_array(JsonLayout::kInline);
    json.value(crossing.first);
    json.value(crossing.second);
    json.end_array();
    json.key("nearer");
    if (crossing.nearer == PseudoIntersection::kTouch) {
      json.null();
    } else {
      json.value(crossing.nearer);
    }
    json.member("ray", crossing.ray);
    json.end_object();
  }
  json.end_array();
}

void write_loops(JsonWriter& json, const RidgeLoops& loops) {
  json.key("loops");
  json.begin_array();
  for (const RidgeLoop& loop : loops.loops) {
    json.begin_object();
    json.member("kind", gnomon::name_of(loop.kind));
    json.member("depth", loop.depth);
    json.key("steps");
    json.begin_array(JsonLayout::kInline);
    for (const LoopStep& step : loop.steps) {
      json.begin_object(JsonLayout::kInline);
      json.member("ray", step.ray);
      json.member("edge", step.edge);
      if (step.imaginary) json.member("imaginary", true);
      json.end_object();
    }
    json.end_array();
    json.end_object();
  }
  json.end_array();
}

void write_rays(JsonWriter& json, const RidgeLoops& loops) {
  // Integers of any length, so as text.
  json.key("rays");
  json.begin_array();
  for (const auto& ray : loops.rays) {
    json.begin_array(JsonLayout::kInline);
    for (const mpz_class& c : ray) json.value(c.get_str());
    json.end_array();
  }
  json.end_array();
}

}  // namespace

std::string ridge_loops_text(const RidgeLoopsOf& loops, std::size_t most) {
  const std::vector<Component> components = find_components(loops.prepared);
  TextTable table({{"component from"},
                   {"facing", Align::kRight},
                   {"VRE", Align::kRight},
                   {"HRE", Align::kRight},
                   {"borders", Align::kRight},
                   {"VREPIPs", Align::kRight},
                   {"others", Align::kRight},
                   {"external", Align::kRight},
                   {"holes", Align::kRight},
                   {"internal", Align::kRight}});
  LoopCounts all;
  std::size_t shown = 0;
  for (const RidgeLoops& own : loops.components) {
    all.add(own);
    if (shown++ >= most) continue;
    LoopCounts counts;
    counts.add(own);
    table.add_row(cells(first_polygon(loops, components, own), counts));
  }
  const std::size_t count = loops.components.size();
  if (count > most) table.add_note("and " + grouped(count - most) + " more (--all)");
  if (count != 1) table.add_row(cells("all " + grouped(count), all));
  std::string text = "light " + light_of(loops).id + " of " +
                     (loops.scene.name.empty() ? loops.scene.file : loops.scene.name) + "\n\n" +
                     table.to_string() + '\n';
  text += "crossings were looked for in " + grouped(all.pairs) + " of " + grouped(all.all_pairs) +
          " pairs of ridge edges; " + grouped(all.imaginary) + " imaginary edges\n";
  return text;
}

void write_ridge_loops_json(TextSink& sink, const RidgeLoopsOf& loops) {
  const std::vector<Component> components = find_components(loops.prepared);
  JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-loops");
  json.member("version", 1);
  json.member("scene", loops.scene.name.empty() ? loops.scene.file : loops.scene.name);
  json.member("light", light_of(loops).id);
  json.key("components");
  json.begin_array();
  for (const RidgeLoops& own : loops.components) {
    json.begin_object();
    json.member("first_polygon", first_polygon(loops, components, own));
    json.member("facing_parts", own.facing_parts);
    json.member("pairs", own.pairs);
    json.member("cancelled", own.cancelled);
    write_edges(json, loops, own);
    write_crossings(json, own);
    write_loops(json, own);
    write_rays(json, own);
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
