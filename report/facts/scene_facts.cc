// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/facts/scene_facts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "gnomon/algorithms/facing_chain.h"
#include "gnomon/algorithms/facing_sides.h"
#include "gnomon/scene/digest.h"
#include "report/facts/facing.h"

namespace gnomon::report {

namespace {

FacingShare facing_of(const PreparedScene& prepared, const std::vector<Sign>& signs) {
  FacingShare share;
  for (std::size_t polygon = 0; polygon + 1 < prepared.first_part.size(); ++polygon) {
    const std::uint32_t first = prepared.first_part[polygon],
                        last = prepared.first_part[polygon + 1];
    if (first == last) continue;
    bool faces = false, in_plane = true;
    for (std::uint32_t index = first; index < last; ++index) {
      const Sign sign = signs[index];
      faces = faces || sign == Sign::kPositive ||
              (sign == Sign::kNegative && prepared.parts[index].two_sided);
      in_plane = in_plane && sign == Sign::kZero;
    }
    ++(faces ? share.facing : in_plane ? share.in_plane : share.away);
  }
  return share;
}

void count_contour(const PreparedScene& prepared, const LightPoint& light, LightFacts& facts) {
  const FacingChain chain = facing_chain(prepared, facing_sides(prepared, light));
  facts.contour_edges = chain.loop_edges.size();
  facts.contour_loops = chain.loops();
  facts.contour_share = chain.contour_share();
}

void count_area_light(const PreparedScene& prepared, const PreparedLight& light,
                      LightFacts& facts) {
  for (std::size_t polygon = 0; polygon + 1 < prepared.first_part.size(); ++polygon) {
    const std::uint32_t first = prepared.first_part[polygon],
                        last = prepared.first_part[polygon + 1];
    if (first == last) continue;
    bool sees = false, cuts = false, reaches = false;
    for (std::uint32_t index = first; index < last; ++index) {
      const Part& part = prepared.parts[index];
      sees = sees || sees_area_light(prepared, part, Side::kFront, light) ||
             sees_area_light(prepared, part, Side::kBack, light);
      cuts = cuts || cuts_area_light(prepared, part, light);
      reaches = reaches || reaches_behind(prepared, part, light);
    }
    ++(sees ? facts.facing.facing : facts.facing.away);
    facts.cutting += cuts ? 1 : 0;
    facts.reaching_behind += reaches ? 1 : 0;
  }
}

void count_families(const PreparedScene& prepared, SceneFacts& facts) {
  std::vector<std::uint32_t> family(prepared.geometry.planes.size(), 0);
  // A plane's only polygon, or the sign that there are several.
  constexpr std::uint32_t kNone = 0xffffffffu, kSeveral = 0xfffffffeu;
  std::vector<std::uint32_t> owner(prepared.geometry.planes.size(), kNone);
  for (const Part& part : prepared.parts) {
    ++family[part.plane];
    std::uint32_t& polygon = owner[part.plane];
    if (polygon == kNone) {
      polygon = part.polygon;
    } else if (polygon != part.polygon) {
      polygon = kSeveral;
    }
  }
  // Others are of regions of lights.
  facts.planes = static_cast<std::size_t>(
      std::ranges::count_if(family, [](std::uint32_t parts) { return parts > 0; }));
  if (!family.empty()) facts.largest_family = *std::ranges::max_element(family);
  for (std::size_t polygon = 0; polygon + 1 < prepared.first_part.size(); ++polygon) {
    for (std::uint32_t p = prepared.first_part[polygon]; p < prepared.first_part[polygon + 1];
         ++p) {
      if (owner[prepared.parts[p].plane] != kSeveral) continue;
      ++facts.sharing_plane;
      break;
    }
  }
}

void count_edges(const PreparedScene& prepared, SceneFacts& facts) {
  std::vector<std::uint32_t> uses(prepared.geometry.edges.size(), 0);
  for (PlaneRef edge : prepared.loop_edges) ++uses[edge.index()];
  facts.edges = uses.size();
  facts.shared_edges = static_cast<std::size_t>(std::ranges::count(uses, 2u));
  facts.crowded_edges =
      static_cast<std::size_t>(std::ranges::count_if(uses, [](auto count) { return count > 2; }));
}

void count_components(const PreparedScene& prepared, SceneFacts& facts) {
  for (const Component& component : find_components(prepared)) {
    ++facts.components;
    facts.closed_components += component.is_closed ? 1 : 0;
    facts.convex_components += component.is_convex ? 1 : 0;
    if (!component.is_closed) facts.unpaired.push_back(component.unpaired);
  }
}

}  // namespace

SceneFacts scene_facts(const Scene& scene, const PreparedScene& prepared, double near) {
  SceneFacts facts;
  facts.name = scene.name;
  facts.file = scene.file;
  facts.geometry_digest = geometry_digest(scene);
  facts.numbers = scene.numbers;
  facts.vertices = scene.vertices.size();
  facts.polygons = scene.polygons.size();
  for (const Polygon& polygon : scene.polygons) {
    facts.holes += polygon.holes.size();
    facts.largest_loop = std::max(facts.largest_loop, polygon.loop.size());
    facts.two_sided += scene.is_two_sided(polygon) ? 1 : 0;
    facts.not_casting += polygon.casts ? 0 : 1;
  }
  facts.positions = prepared.geometry.polygon_positions().size();
  facts.parts = prepared.parts.size();
  for (std::size_t polygon = 0; polygon < scene.polygons.size(); ++polygon) {
    facts.dropped += prepared.first_part[polygon] == prepared.first_part[polygon + 1] ? 1 : 0;
  }
  facts.notes = prepared.notes;
  std::set<std::pair<std::uint32_t, Repair>> repaired;
  for (const PreparationNote& note : prepared.notes) {
    if (repaired.emplace(note.polygon, note.repair).second) ++facts.repairs[note.repair];
  }
  count_families(prepared, facts);
  count_edges(prepared, facts);
  count_components(prepared, facts);

  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  facts.low = {kInfinity, kInfinity, kInfinity};
  facts.high = {-kInfinity, -kInfinity, -kInfinity};
  for (const std::array<double, 3>& position : prepared.geometry.polygon_positions()) {
    for (int k = 0; k < 3; ++k) {
      facts.low[k] = std::min(facts.low[k], position[k]);
      facts.high[k] = std::max(facts.high[k], position[k]);
    }
  }
  if (prepared.geometry.polygon_positions().empty()) facts.low = facts.high = {};
  facts.diagonal = std::hypot(facts.high[0] - facts.low[0], facts.high[1] - facts.low[1],
                              facts.high[2] - facts.low[2]);
  facts.step = prepared.geometry.step;
  facts.position_bits = prepared.position_bits;
  facts.direction_bits = prepared.direction_bits;

  facts.intent = find_intent(scene, prepared, {.near = near});
  for (const PreparedLight& light : prepared.lights) {
    const Light& source = scene.lights[light.light];
    LightFacts& one = facts.lights.emplace_back();
    one.id = source.id;
    one.type = source.type;
    one.position = source.position;
    one.corners = source.loop.size();
    facts.has_point = facts.has_point || source.is_point();
    facts.has_directional = facts.has_directional || source.is_directional();
    facts.has_area = facts.has_area || source.has_area();
    if (source.has_area()) {
      count_area_light(prepared, light, one);
    } else {
      one.facing = facing_of(prepared, signs_at_light(prepared, light.point));
      count_contour(prepared, light.point, one);
    }
  }
  return facts;
}

std::string_view repair_name(Repair repair) {
  switch (repair) {
    case Repair::kRepeatedVertices:
      return "repeated vertices: dropped";
    case Repair::kCollinearVertices:
      return "collinear vertices: dropped";
    case Repair::kZeroArea:
      return "zero area: polygon dropped";
    case Repair::kNotPlanar:
      return "not planar: triangulated";
    case Repair::kNotConvex:
      return "not convex: cut into convex parts";
    case Repair::kHoles:
      return "holes: cut into convex parts";
  }
  return "";
}

std::string_view light_type_name(LightType type) {
  switch (type) {
    case LightType::kPoint:
      return "point";
    case LightType::kDirectional:
      return "directional";
    case LightType::kArea:
      return "area";
  }
  return "";
}

}  // namespace gnomon::report
