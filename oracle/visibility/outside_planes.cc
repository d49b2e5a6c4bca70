// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/visibility/outside_planes.h"

#include <utility>

namespace gnomon::oracle {

std::vector<ExactPlane> outside_planes(const Geometry& geometry, const PreparedLight& light) {
  std::vector<ExactPlane> planes;
  for (const PlaneRef inside : light.region) {
    const SupportTriple& triple = geometry.planes[inside.index()];
    std::vector<Integers3> loop;
    for (const VertexId vertex : {triple.a, triple.b, triple.c}) {
      loop.push_back(
          {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1), geometry.grid.at(vertex, 2)});
    }
    ExactPlane plane = plane_of(loop);
    planes.push_back(inside.flipped() ? std::move(plane) : opposite(plane));
  }
  return planes;
}

}  // namespace gnomon::oracle
