// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/repair.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "gnomon/scene/intent.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/unusable.h"
#include "scene/geometry/box_tree.h"
#include "scene/intent/components.h"
#include "scene/repair/snap.h"

namespace gnomon {

using scene_detail::LocalPoints;
using scene_detail::Vector;

Expected<SnapReport> snap_scene(Scene& scene, const mpq_class& distance) {
  return scene_detail::snap(scene, distance);
}

// ---------------------------------------------------------------------------------------- windows

namespace {

/// A polygon all of whose parts lie in one plane.
struct FlatPolygon {
  std::uint32_t polygon = 0;
  PlaneId plane = 0;
  bool flipped = false;
  long double area = 0;
  scene_detail::Box box;
};

std::vector<FlatPolygon> flat_polygons(const PreparedScene& prepared, const LocalPoints& points) {
  std::vector<FlatPolygon> result;
  for (std::uint32_t p = 0; p + 1 < prepared.first_part.size(); ++p) {
    const std::uint32_t first = prepared.first_part[p], last = prepared.first_part[p + 1];
    if (first == last) continue;
    FlatPolygon flat{p, prepared.parts[first].plane, prepared.parts[first].flipped, 0,
                     scene_detail::Box::empty()};
    bool is_flat = true;
    for (std::uint32_t i = first; i < last; ++i) {
      const Part& part = prepared.parts[i];
      is_flat = is_flat && part.plane == flat.plane;
      flat.area += length_of(points.area_vector(prepared.loop(part)));
      for (const VertexId vertex : prepared.loop(part)) {
        const Vector at = points[vertex];
        for (int k = 0; k < 3; ++k) {
          flat.box.add(k, static_cast<double>(at[k]), static_cast<double>(at[k]));
        }
      }
    }
    if (is_flat) result.push_back(flat);
  }
  // Those of one plane beside each other, the smallest first.
  std::ranges::stable_sort(result, [](const FlatPolygon& a, const FlatPolygon& b) {
    return std::tie(a.plane, a.area) < std::tie(b.plane, b.area);
  });
  return result;
}

bool box_holds(const scene_detail::Box& outer, const scene_detail::Box& inner) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (inner.low[k] < outer.low[k] || inner.high[k] > outer.high[k]) return false;
  }
  return true;
}

/// The polygon with this loop as one hole more can be used.
bool takes_hole(const Scene& scene, const Polygon& polygon, const std::vector<VertexId>& loop) {
  Scene alone;
  alone.numbers = scene.numbers;
  alone.polygons.push_back(polygon);
  alone.polygons[0].holes.push_back(loop);
  // Its own vertices alone, so that preparing it costs little.
  const auto take = [&](std::vector<VertexId>& ring) {
    for (VertexId& vertex : ring) {
      alone.vertices.push_back(scene.vertices[vertex]);
      vertex = static_cast<VertexId>(alone.vertices.size() - 1);
    }
  };
  take(alone.polygons[0].loop);
  for (auto& hole : alone.polygons[0].holes) take(hole);
  const auto problems = unusable_polygons(alone);
  return problems && problems->empty();
}

}  // namespace

Expected<ParentReport> make_holes_of_windows(Scene& scene) {
  auto prepared = prepare(scene);
  if (!prepared) return tl::unexpected(std::move(prepared.error()));
  const std::vector<FlatPolygon> flat = flat_polygons(*prepared, LocalPoints(*prepared));
  ParentReport report;
  for (std::size_t i = 0; i < flat.size(); ++i) {
    bool lies_in_another = false, is_done = false;
    for (std::size_t j = i + 1; j < flat.size() && flat[j].plane == flat[i].plane && !is_done;
         ++j) {
      if (flat[j].flipped != flat[i].flipped || !(flat[j].area > flat[i].area) ||
          !box_holds(flat[j].box, flat[i].box)) {
        continue;
      }
      const Polygon& window = scene.polygons[flat[i].polygon];
      Polygon& wall = scene.polygons[flat[j].polygon];
      lies_in_another = true;
      if (!takes_hole(scene, wall, window.loop)) continue;
      wall.holes.push_back(window.loop);
      report.windows.push_back(window.id);
      report.walls.push_back(wall.id);
      is_done = true;
    }
    if (lies_in_another && !is_done) report.left.push_back(scene.polygons[flat[i].polygon].id);
  }
  return report;
}

// ------------------------------------------------------------------------------------ orientation

namespace {

void reverse_polygon(Scene& scene, std::uint32_t polygon, std::set<std::uint32_t>& reversed) {
  // The first vertex stays the first.
  auto& loop = scene.polygons[polygon].loop;
  std::reverse(loop.begin() + 1, loop.end());
  if (!reversed.erase(polygon)) reversed.insert(polygon);
}

/// Makes the faces of mixed components look one way, from face to face across edges that only two
/// of them have.
void make_consistent(Scene& scene, const scene_detail::Components& components,
                     std::set<std::uint32_t>& reversed) {
  std::vector<std::vector<scene_detail::HalfEdge>> of_edge, of_polygon(scene.polygons.size());
  for (const scene_detail::HalfEdge& half : components.half_edges) {
    if (of_edge.size() <= half.edge) of_edge.resize(half.edge + 1);
    of_edge[half.edge].push_back(half);
    of_polygon[half.polygon].push_back(half);
  }
  std::vector<std::uint8_t> seen(scene.polygons.size(), 0), turned(scene.polygons.size(), 0);
  for (const ClosedComponent& component : components.closed) {
    if (component.orientation != ComponentOrientation::kMixed) continue;
    for (const std::uint32_t start : component.polygons) {
      if (seen[start] != 0) continue;
      std::vector<std::uint32_t> open{start};
      seen[start] = 1;
      while (!open.empty()) {
        const std::uint32_t polygon = open.back();
        open.pop_back();
        for (const scene_detail::HalfEdge& half : of_polygon[polygon]) {
          if (of_edge[half.edge].size() != 2) continue;
          for (const scene_detail::HalfEdge& other : of_edge[half.edge]) {
            if (seen[other.polygon] != 0) continue;
            seen[other.polygon] = 1;
            // Neighbours that look one way run along their edge against each other.
            turned[other.polygon] =
                turned[polygon] ^ static_cast<std::uint8_t>(other.flipped == half.flipped);
            open.push_back(other.polygon);
          }
        }
      }
    }
    for (const std::uint32_t polygon : component.polygons) {
      if (turned[polygon] != 0) reverse_polygon(scene, polygon, reversed);
    }
  }
}

}  // namespace

Expected<OrientReport> orient_closed(Scene& scene) {
  std::set<std::uint32_t> reversed;
  {
    auto prepared = prepare(scene);
    if (!prepared) return tl::unexpected(std::move(prepared.error()));
    make_consistent(scene, scene_detail::find_components(scene, *prepared, LocalPoints(*prepared)),
                    reversed);
  }
  // Twice: whether one is a cavity depends on which way the others look.
  Intent intent;
  for (int pass = 0; pass < 2; ++pass) {
    auto prepared = prepare(scene);
    if (!prepared) return tl::unexpected(std::move(prepared.error()));
    intent = find_intent(scene, *prepared);
    for (ClosedComponent& component : intent.closed) {
      const bool looks_inwards = component.orientation == ComponentOrientation::kInwards;
      if (!looks_inwards && component.orientation != ComponentOrientation::kOutwards) continue;
      const bool is_meant_inwards = !component.lights_inside.empty() || component.is_cavity;
      if (looks_inwards == is_meant_inwards) continue;
      for (const std::uint32_t polygon : component.polygons) {
        reverse_polygon(scene, polygon, reversed);
      }
      component.orientation =
          is_meant_inwards ? ComponentOrientation::kInwards : ComponentOrientation::kOutwards;
    }
  }
  OrientReport report;
  for (const std::uint32_t polygon : reversed)
    report.reversed.push_back(scene.polygons[polygon].id);
  report.components = intent.closed.size();
  for (const ClosedComponent& component : intent.closed) {
    report.inwards += component.orientation == ComponentOrientation::kInwards ? 1 : 0;
    report.left += component.orientation == ComponentOrientation::kMixed ? 1 : 0;
  }
  return report;
}

// ------------------------------------------------------------------------------------------ extra

void note_change(Scene& scene, const std::string& change) {
  // "extra" may hold anything. Its text stays as it is, and changes come after what there is.
  std::string& extra = scene.extra;
  const std::string list = "\"changes\": [" + change + "]";
  constexpr std::string_view kMark = "\"changes\": [";
  if (extra.empty()) {
    extra = "{" + list + "}";
  } else if (const std::size_t at = extra.rfind(kMark);
             at != std::string::npos && extra.ends_with("]}")) {
    extra.insert(extra.size() - 2, ", " + change);
  } else if (extra.starts_with('{') && extra.find(kMark) == std::string::npos) {
    const std::size_t end = extra.rfind('}');
    const bool is_empty = extra.find_first_not_of(" \t\r\n", 1) == end;
    extra.insert(end, (is_empty ? "" : ", ") + list);
  } else {
    extra = "{\"before\": " + extra + ", " + list + "}";
  }
}

}  // namespace gnomon
