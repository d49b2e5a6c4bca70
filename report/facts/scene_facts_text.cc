// SPDX-License-Identifier: GPL-3.0-or-later
// The facts of a scene for people and for programs.
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "report/facts/intent_text.h"
#include "report/facts/scene_facts.h"
#include "report/json/json_writer.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::report {

namespace {

constexpr std::size_t kWidth = TextTable::kWidth;
constexpr std::size_t kLabel = 16;

/// A label, and the text beside it.
std::string entry(const std::string& label, const std::string& text) {
  const std::string lines = wrapped(text, kWidth, kLabel, kLabel);
  return label + std::string(kLabel - std::min(kLabel, text_width(label)), ' ') +
         lines.substr(std::min(kLabel, lines.size()));
}

std::string point_text(const std::array<double, 3>& point) {
  return "(" + rounded(point[0], 9) + ", " + rounded(point[1], 9) + ", " + rounded(point[2], 9) +
         ")";
}

std::string position_text(const Position& position) {
  return "(" + position[0].to_text() + ", " + position[1].to_text() + ", " + position[2].to_text() +
         ")";
}

std::string plan_text(const std::string& title, std::span<const PredicateBits> plan) {
  TextTable table({{title + ": predicate"},
                   {"degree", Align::kRight},
                   {"bits", Align::kRight},
                   {"integers", Align::kRight}});
  for (const PredicateBits& predicate : plan) {
    std::string degree = std::to_string(predicate.degree);
    if (predicate.direction_degree > 0) degree += '+' + std::to_string(predicate.direction_degree);
    table.add_row({std::string(predicate.name), degree, std::to_string(predicate.bits),
                   std::string(width_name(predicate.width))});
  }
  return table.to_string();
}

/// The plan holds for all lights of a kind, and needs e only for directional ones.
std::array<PredicateBits, 13> light_plan(const SceneFacts& facts, bool directional) {
  return precision_plan(directional, facts.position_bits, facts.direction_bits);
}

/// How often a corner of an area light may be cut: by the receiver's plane, and by the caster's.
LightCuts light_cuts(const SceneFacts& facts) {
  std::size_t most = 0;
  for (const LightFacts& light : facts.lights) most = std::max(most, light.cutting);
  return most == 0 ? LightCuts::kNone : most == 1 ? LightCuts::kOnce : LightCuts::kTwice;
}

std::string facing_text(const FacingShare& facing) {
  std::string text = grouped(facing.facing) + " face it, " + grouped(facing.away) + " face away";
  if (facing.in_plane > 0) text += ", " + grouped(facing.in_plane) + " hold it in their plane";
  return text + " (" + percent(facing.away_share()) + " get no light)";
}

std::string plural(std::size_t count, const std::string& one, const std::string& many) {
  return grouped(count) + " " + (count == 1 ? one : many);
}

std::string area_light_text(const LightFacts& light) {
  return std::to_string(light.corners) + " corners; " + grouped(light.facing.facing) +
         " polygons see it, " + grouped(light.facing.away) + " do not (" +
         percent(light.facing.away_share()) + " get no light); " +
         (light.cutting == 0
              ? "no polygon's plane cuts it"
              : "cut by " + plural(light.cutting, "polygon's plane", "polygons' planes")) +
         "; " +
         plural(light.reaching_behind, "polygon reaches behind it", "polygons reach behind it");
}

std::string notes_text(const Scene& scene, const SceneFacts& facts, bool all_notes) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (const auto& [repair, count] : facts.repairs) {
    text += "  " + std::string(repair_name(repair)) + ": " + grouped(count) +
            (count == 1 ? " polygon\n" : " polygons\n");
    std::size_t shown = 0;
    for (const PreparationNote& note : facts.notes) {
      if (note.repair != repair) continue;
      if (!all_notes && shown == kMost) {
        text += "    ... (--all lists every one)\n";
        break;
      }
      ++shown;
      text += wrapped(scene.polygons[note.polygon].id + ": " + note.detail, kWidth, 4, 8);
    }
  }
  return text;
}

std::string left_out_text(const SceneFacts& facts, bool all) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (std::size_t i = 0; i < facts.left_out.size(); ++i) {
    if (!all && i == kMost) return text + "  ... (--all lists every one)\n";
    text += wrapped(left_out_polygon(facts.left_out[i]), kWidth, 2, 6);
  }
  return text;
}

/// How many parts hang together, and of what is open an edge of each; the first few unless `all`.
std::string components_text(const Scene& scene, const PreparedScene& prepared,
                            const SceneFacts& facts, bool all) {
  constexpr std::size_t kMost = 1;
  std::string text = grouped(facts.components) + "; " + grouped(facts.closed_components) +
                     " closed, " + grouped(facts.convex_components) + " of them convex";
  for (std::size_t i = 0; i < facts.unpaired.size(); ++i) {
    if (!all && i == kMost) return text + "; ... (--all lists one of each open component)";
    text += "; " + unpaired_edge_text(scene, prepared, facts.unpaired[i]);
  }
  return text;
}

std::string contour_text(const LightFacts& light) {
  return "; " + plural(light.contour_edges, "contour edge", "contour edges") + " in " +
         plural(light.contour_loops, "loop", "loops") + ", " + percent(light.contour_share) +
         " of the edges of facing polygons";
}

void write_components(JsonWriter& json, const Scene& scene, const PreparedScene& prepared,
                      const SceneFacts& facts) {
  json.member("components", facts.components);
  json.member("closed_components", facts.closed_components);
  json.member("convex_components", facts.convex_components);
  if (facts.unpaired.empty()) return;
  json.member("open_because", unpaired_edge_text(scene, prepared, facts.unpaired.front()));
}

void write_left_out(JsonWriter& json, const SceneFacts& facts) {
  json.key("left_out");
  json.begin_array();
  for (const LeftOutPolygon& polygon : facts.left_out) {
    json.begin_object(JsonLayout::kInline);
    json.member("polygon", polygon.id);
    json.member("line", polygon.why.where.line);
    json.member("why", polygon.why.what);
    json.end_object();
  }
  json.end_array();
}

void write_plan(JsonWriter& json, const char* name, std::span<const PredicateBits> plan) {
  json.key(name);
  json.begin_array();
  for (const PredicateBits& predicate : plan) {
    json.begin_object(JsonLayout::kInline);
    json.member("predicate", predicate.name);
    json.member("degree", predicate.degree);
    json.member("direction_degree", predicate.direction_degree);
    json.member("bits", predicate.bits);
    json.member("integers", width_name(predicate.width));
    json.end_object();
  }
  json.end_array();
}

void write_point(JsonWriter& json, const char* name, const std::array<double, 3>& point) {
  json.key(name);
  json.begin_array(JsonLayout::kInline);
  for (double coordinate : point) json.value(coordinate);
  json.end_array();
}

}  // namespace

std::string left_out_polygon(const LeftOutPolygon& polygon) {
  // The polygon has been named already.
  std::string_view why = polygon.why.what;
  const std::string name = "polygon '" + polygon.id + "': ";
  if (why.starts_with(name)) why.remove_prefix(name.size());
  std::string text = polygon.id;
  if (polygon.why.where.line != 0) {
    text += " in line " + std::to_string(polygon.why.where.line);
  }
  return text + " (" + std::string(why) + ")";
}

std::string facts_text(const Scene& scene, const PreparedScene& prepared, const SceneFacts& facts,
                       bool all_notes) {
  std::string text;
  text += entry("scene", (facts.name.empty() ? "(no name)" : facts.name) + ", from " + facts.file);
  text += entry("geometry", facts.geometry_digest);
  text +=
      entry("numbers", facts.numbers == NumberMeaning::kDecimal ? "decimals, exactly as written"
                                                                : "the nearest doubles, exactly");
  text += entry("as read", grouped(facts.vertices) + " vertices, " + grouped(facts.polygons) +
                               " polygons with " + grouped(facts.holes) + " holes, up to " +
                               grouped(facts.largest_loop) + " vertices a loop; " +
                               grouped(facts.two_sided) + " two-sided, " +
                               grouped(facts.not_casting) + " cast nothing");
  text += entry("as prepared", grouped(facts.parts) + " convex planar parts over " +
                                   grouped(facts.positions) + " positions, " +
                                   grouped(facts.dropped) + " polygons dropped");
  text += entry("planes", grouped(facts.planes) + "; " + grouped(facts.sharing_plane) + " of " +
                              grouped(facts.polygons - facts.dropped) +
                              " polygons share a plane with another, up to " +
                              grouped(facts.largest_family) + " parts a plane");
  text += entry("edges", grouped(facts.edges) + "; " + grouped(facts.shared_edges) +
                             " shared by two parts, " + grouped(facts.crowded_edges) + " by more");
  text += entry("components", components_text(scene, prepared, facts, all_notes));
  text += entry("box", point_text(facts.low) + " to " + point_text(facts.high) + ", diagonal " +
                           rounded(facts.diagonal, 9));
  const double step = facts.step.get_d();
  text += entry("grid",
                "step " +
                    (facts.step.get_str().size() <= 24 ? facts.step.get_str() : rounded(step, 6)) +
                    ", b = " + std::to_string(facts.position_bits) + " bits a coordinate" +
                    (facts.has_directional
                         ? ", e = " + std::to_string(facts.direction_bits) + " bits a direction"
                         : ""));
  if (!facts.repairs.empty()) {
    text += "\nmade convex and planar\n" + notes_text(scene, facts, all_notes);
  }
  if (!facts.left_out.empty()) {
    text += "\nleft out: " + plural(facts.left_out.size(), "polygon", "polygons") + "\n" +
            left_out_text(facts, all_notes);
  }
  text += "\nlights\n";
  if (facts.lights.empty()) text += "  none\n";
  for (const LightFacts& light : facts.lights) {
    std::string line = light.id + ": " + std::string(light_type_name(light.type));
    if (light.type == LightType::kArea) {
      line += ", " + area_light_text(light);
    } else {
      line += " " + position_text(light.position) + "; " + facing_text(light.facing) +
              contour_text(light);
    }
    text += wrapped(line, kWidth, 2, 6);
  }
  text += intent_text(scene, prepared, facts.intent, all_notes);
  text += "\nprecision plan: what the exact stage of `plane` needs here\n";
  std::vector<std::string> plans;
  if (facts.has_point || facts.lights.empty()) {
    plans.push_back(plan_text("point lights", light_plan(facts, false)));
  }
  if (facts.has_directional) {
    plans.push_back(plan_text("directional lights", light_plan(facts, true)) +
                    "degree: in positions + in the direction to the light\n");
  }
  const unsigned b = facts.position_bits;
  if (facts.has_area) {
    plans.push_back(plan_text("area lights", volume_precision_plan(LightCuts::kNone, b)));
    if (light_cuts(facts) != LightCuts::kNone) {
      plans.push_back(plan_text("area lights, where planes of polygons cut them",
                                volume_precision_plan(light_cuts(facts), b)));
    }
  }
  for (std::size_t i = 0; i < plans.size(); ++i) text += (i == 0 ? "" : "\n") + plans[i];
  return text;
}

void write_facts_json(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                      const SceneFacts& facts) {
  JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-info");
  json.member("version", 1);
  json.member("scene", facts.name);
  json.member("geometry", facts.geometry_digest);
  json.member("numbers", facts.numbers == NumberMeaning::kDecimal ? "decimal" : "double");
  json.member("vertices", facts.vertices);
  json.member("polygons", facts.polygons);
  json.member("holes", facts.holes);
  json.member("largest_loop", facts.largest_loop);
  json.member("two_sided", facts.two_sided);
  json.member("not_casting", facts.not_casting);
  json.member("positions", facts.positions);
  json.member("parts", facts.parts);
  json.member("dropped", facts.dropped);
  json.member("planes", facts.planes);
  json.member("polygons_sharing_a_plane", facts.sharing_plane);
  json.member("largest_family", facts.largest_family);
  json.member("edges", facts.edges);
  json.member("shared_edges", facts.shared_edges);
  json.member("crowded_edges", facts.crowded_edges);
  write_components(json, scene, prepared, facts);
  write_point(json, "low", facts.low);
  write_point(json, "high", facts.high);
  json.member("diagonal", facts.diagonal);
  json.member("grid_step", facts.step.get_str());
  json.member("position_bits", facts.position_bits);
  json.member("direction_bits", facts.direction_bits);
  json.key("repairs");
  json.begin_array();
  for (const PreparationNote& note : facts.notes) {
    json.begin_object(JsonLayout::kInline);
    json.member("polygon", scene.polygons[note.polygon].id);
    json.member("repair", repair_name(note.repair));
    json.member("detail", note.detail);
    json.end_object();
  }
  json.end_array();
  write_left_out(json, facts);
  json.key("lights");
  json.begin_array();
  for (const LightFacts& light : facts.lights) {
    json.begin_object(JsonLayout::kInline);
    json.member("id", light.id);
    json.member("type", light_type_name(light.type));
    json.member("facing", light.facing.facing);
    json.member("away", light.facing.away);
    json.member("light_in_plane", light.facing.in_plane);
    json.member("away_share", light.facing.away_share());
    if (light.type == LightType::kArea) {
      json.member("corners", light.corners);
      json.member("cut_by_planes_of", light.cutting);
      json.member("reaching_behind", light.reaching_behind);
    } else {
      json.member("contour_edges", light.contour_edges);
      json.member("contour_loops", light.contour_loops);
      json.member("contour_share", light.contour_share);
    }
    json.end_object();
  }
  json.end_array();
  write_intent_json(json, scene, prepared, facts.intent);
  write_plan(json, "point_light_plan", light_plan(facts, false));
  write_plan(json, "directional_light_plan", light_plan(facts, true));
  const unsigned b = facts.position_bits;
  write_plan(json, "area_light_plan", volume_precision_plan(LightCuts::kNone, b));
  if (light_cuts(facts) != LightCuts::kNone) {
    write_plan(json, "cut_area_light_plan", volume_precision_plan(light_cuts(facts), b));
  }
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
