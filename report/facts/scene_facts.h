// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene holds, and which precision it needs: everything that `gnomon info` prints, as
// values. All of it is exact; sizes in scene units are the nearest doubles.
#ifndef GNOMON_REPORT_FACTS_SCENE_FACTS_H
#define GNOMON_REPORT_FACTS_SCENE_FACTS_H

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "gnomon/algorithms/components.h"
#include "gnomon/kernel/precision_plan.h"
#include "gnomon/scene/intent.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/scene.h"
#include "report/sides/polygon_sides.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

struct LightFacts {
  std::string id;
  LightType type = LightType::kPoint;
  Position position;                // or to_light
  std::size_t corners = 0;          // of an area light
  FacingShare facing;               // polygons that face it, or see an area light
  std::size_t cutting = 0;          // polygons whose plane cuts the area light
  std::size_t reaching_behind = 0;  // polygons that the area light's plane cuts
  // Of a point or directional light (gnomon/algorithms/facing_chain.h).
  std::size_t contour_edges = 0;  // with their multiplicity
  std::size_t contour_loops = 0;
  double contour_share = 0;  // for each edge of a polygon that faces and casts
};

struct SceneFacts {
  std::string name, file, geometry_digest;
  NumberMeaning numbers = NumberMeaning::kDouble;
  // As read.
  std::size_t vertices = 0, polygons = 0, holes = 0, largest_loop = 0;
  std::size_t two_sided = 0, not_casting = 0;
  // As prepared.
  std::size_t positions = 0;  // distinct, of those used
  std::size_t parts = 0, dropped = 0;
  std::map<Repair, std::size_t> repairs;  // polygons each was done to
  std::vector<PreparationNote> notes;
  std::size_t planes = 0;          // coplanar families
  std::size_t sharing_plane = 0;   // polygons with a part in a plane of another polygon
  std::size_t largest_family = 0;  // parts
  std::size_t edges = 0, shared_edges = 0, crowded_edges = 0;  // of two parts; of more
  std::size_t components = 0, closed_components = 0, convex_components = 0;
  std::vector<UnpairedEdge> unpaired;  // of each component that is not closed, the first
  std::array<double, 3> low{}, high{};
  double diagonal = 0;
  mpq_class step;
  unsigned position_bits = 0, direction_bits = 0;
  bool has_directional = false, has_point = false, has_area = false;
  std::vector<LightFacts> lights;
  std::vector<LeftOutPolygon> left_out;  // when the scene was read
  Intent intent;
};

/// `near`: scene units, or 0 (intent.h).
SceneFacts scene_facts(const Scene& scene, const PreparedScene& prepared, double near = 0);

/// "ID in line 7 (why)".
std::string left_out_polygon(const LeftOutPolygon& polygon);

/// What was done to a polygon: "zero area: dropped", "not planar: triangulated", ...
std::string_view repair_name(Repair repair);
std::string_view light_type_name(LightType type);

/// For people, at most 100 columns; all notes if `all_notes`, else the first few of each kind.
std::string facts_text(const Scene& scene, const PreparedScene& prepared, const SceneFacts& facts,
                       bool all_notes);
/// For programs: stable.
void write_facts_json(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                      const SceneFacts& facts);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_FACTS_SCENE_FACTS_H
