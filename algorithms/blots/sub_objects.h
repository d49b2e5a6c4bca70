// SPDX-License-Identifier: LGPL-3.0-or-later
// The sub-objects of a cell of light space: of each convex solid the faces that face the light, of
// what is in no solid each polygon by itself (Crow 1977, second class).
#ifndef GNOMON_ALGORITHMS_BLOTS_SUB_OBJECTS_H
#define GNOMON_ALGORITHMS_BLOTS_SUB_OBJECTS_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/blots/convex_solids.h"
#include "algorithms/partition/chart_box.h"
#include "algorithms/two_pass/list_clipping.h"

namespace gnomon {

struct SubObject {
  std::uint32_t first = 0, count = 0;          // of its faces
  std::uint32_t solid = SolidsOfLight::kNone;  // else a polygon by itself
  bool casts = false;
  ChartBox box;
};

/// Whether a box holds another one, as far as bounds of both can tell.
inline bool holds(const ChartBox& outer, const ChartBox& inner) {
  return outer.low[0] <= inner.low[0] && outer.low[1] <= inner.low[1] &&
         inner.high[0] <= outer.high[0] && inner.high[1] <= outer.high[1];
}

/// A box of two.
inline ChartBox joined(ChartBox box, const ChartBox& other) {
  for (std::size_t k = 0; k < 2; ++k) {
    box.low[k] = std::min(box.low[k], other.low[k]);
    box.high[k] = std::max(box.high[k], other.high[k]);
  }
  return box;
}

struct SubObjects {
  std::vector<ListPiece> faces;  // of one sub-object after another
  std::vector<SubObject> all;

  std::span<const ListPiece> faces_of(const SubObject& object) const {
    return {faces.data() + object.first, object.count};
  }

  /// In the order of their first faces. `casts(face)`: whether a face casts a shadow; of a solid
  /// all do.
  template <class Casts>
  void gather(std::span<const ListPiece> pieces, const SolidsOfLight& solids, const Casts& casts) {
    faces.clear();
    all.clear();
    // By the first face of the solid.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> of_solids;
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      const std::uint32_t solid = solids.solid_of(pieces[i].loop.part);
      if (solid != SolidsOfLight::kNone) of_solids.emplace_back(solid, i);
    }
    std::ranges::sort(of_solids);
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      const std::uint32_t solid = solids.solid_of(pieces[i].loop.part);
      SubObject object{static_cast<std::uint32_t>(faces.size()), 1, SolidsOfLight::kNone,
                       casts(pieces[i]), pieces[i].box};
      if (solid == SolidsOfLight::kNone) {
        faces.push_back(pieces[i]);
        all.push_back(object);
        continue;
      }
      auto own = std::ranges::lower_bound(of_solids, std::pair(solid, std::uint32_t{0}));
      if (own->second != i) continue;  // its sub-object is there
      object.count = 0;
      for (; own != of_solids.end() && own->first == solid; ++own) {
        const ListPiece& face = pieces[own->second];
        faces.push_back(face);
        ++object.count;
        object.box = joined(object.box, face.box);
      }
      // One face alone is its own outline.
      if (object.count > 1) object.solid = solid;
      all.push_back(object);
    }
  }
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BLOTS_SUB_OBJECTS_H
