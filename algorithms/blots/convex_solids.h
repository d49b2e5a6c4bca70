// SPDX-License-Identifier: LGPL-3.0-or-later
// The convex sub-objects of a scene (Crow 1977, second class): closed convex solids, and what of
// one a light sees. The faces that face the light tile the solid's outline; the edges between them
// and the others, the contour edges, bound it.
//
// Exactness: which components are closed and convex is decided in integers; which faces face is the
// kernel's. No other arithmetic.
#ifndef GNOMON_ALGORITHMS_BLOTS_CONVEX_SOLIDS_H
#define GNOMON_ALGORITHMS_BLOTS_CONVEX_SOLIDS_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/partition/import_export.h"
#include "algorithms/partition/loop_store.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// The parts of each solid: a closed convex component all of whose parts cast and are one-sided.
/// `all_cast`: parts count as casting that cast no shadow, too.
std::vector<std::vector<std::uint32_t>> convex_solids(const PreparedScene& scene, bool all_cast);

/// The edges that bound those `faces` of a convex solid that face a light: each belongs to one of
/// them alone. Ascending.
std::vector<EdgeId> contour_of(const PreparedScene& scene, std::span<const std::uint32_t> faces);

/// The solids that one light sees from outside, two of whose faces at least face it; of others each
/// face is a sub-object by itself. A light inside a solid sees none of its faces.
struct SolidsOfLight {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  struct Face {
    std::uint32_t part = 0;
    std::vector<PlaneRef> planes;  // of its edges and the light, inside in front
  };
  struct Solid {
    std::vector<Face> faces;             // those that face the light
    std::vector<std::uint32_t> outline;  // numbers of the contour edges' planes, ascending
    bool is_in_outline(PlaneRef plane) const {
      return std::ranges::binary_search(outline, plane.index());
    }
  };
  std::vector<Solid> solids;
  std::vector<std::uint32_t> of_part;  // its solid, or kNone; empty: there is no solid

  std::uint32_t solid_of(std::uint32_t part) const {
    return of_part.empty() ? kNone : of_part[part];
  }
};

/// `items`: parts that take part, and where in `loops` each is (`part`, `first`, `count`), as a
/// loop of light space whose edges have their shadow planes. One-sided parts are there as they are
/// in the scene, so that their edges have the same numbers.
template <class Item, class Vertex>
SolidsOfLight solids_of_light(const PreparedScene& scene,
                              std::span<const std::vector<std::uint32_t>> solids,
                              const FacingParts& facing, std::span<const Item> items,
                              const LoopStore<Vertex>& loops) {
  SolidsOfLight result;
  result.of_part.assign(scene.parts.size(), SolidsOfLight::kNone);
  std::vector<const Item*> item_of(scene.parts.size(), nullptr);
  for (const Item& item : items) item_of[item.part] = &item;
  std::vector<std::uint32_t> faces;
  for (const std::vector<std::uint32_t>& parts : solids) {
    faces.clear();
    for (const std::uint32_t part : parts) {
      if (facing.facing[part].faces()) faces.push_back(part);
    }
    const auto is_there = [&](std::uint32_t part) { return item_of[part] != nullptr; };
    if (faces.size() < 2 || !std::ranges::all_of(faces, is_there)) continue;
    const std::vector<EdgeId> contour = contour_of(scene, faces);
    SolidsOfLight::Solid solid;
    for (const std::uint32_t part : faces) {
      const auto edges = scene.edges(scene.parts[part]);
      SolidsOfLight::Face face{part, {}};
      for (std::uint32_t k = 0; k < item_of[part]->count; ++k) {
        face.planes.push_back(loops.edge(item_of[part]->first + k));
        if (std::ranges::binary_search(contour, edges[k].index())) {
          solid.outline.push_back(face.planes.back().index());
        }
      }
      solid.faces.push_back(std::move(face));
      result.of_part[part] = static_cast<std::uint32_t>(result.solids.size());
    }
    std::ranges::sort(solid.outline);
    result.solids.push_back(std::move(solid));
  }
  return result;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BLOTS_CONVEX_SOLIDS_H
