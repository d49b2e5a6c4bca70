// SPDX-License-Identifier: LGPL-3.0-or-later
// A closed surface that grows face by face, all of its vertices shared and none of them inside
// another face's edge, until it has exactly as many polygons as are asked for.
#ifndef GNOMON_SCENE_GENERATE_CLOSED_SURFACE_H
#define GNOMON_SCENE_GENERATE_CLOSED_SURFACE_H

#include <cstddef>
#include <string>
#include <vector>

#include "scene/generate/scene_maker.h"

namespace gnomon::scene_detail {

class ClosedSurface {
 public:
  using Loop = std::vector<Int3>;

  /// A convex face, counter-clockwise seen from outside.
  void add(Loop loop) { faces_.push_back(std::move(loop)); }
  /// Four-sided faces between two rings of as many corners; each runs along `first`, then over to
  /// `second` and back, counter-clockwise seen from outside. Requires: each is planar.
  void join(const Loop& first, const Loop& second);
  std::size_t size() const { return faces_.size(); }
  /// Cuts four-sided faces along a diagonal, the first ones first, until there are so many.
  /// Requires: there are enough of them.
  void cut_until(std::size_t polygons);
  /// Writes the faces as id.0, id.1, ...
  void write(SceneMaker& maker, const std::string& id) const;

 private:
  std::vector<Loop> faces_;
};

/// The ring of the corners, each times `scale`, at height z.
ClosedSurface::Loop ring_of(const ClosedSurface::Loop& corners, std::int64_t scale, std::int64_t z);
ClosedSurface::Loop reversed(ClosedSurface::Loop loop);

/// The surface of cubes on the grid, `scale` long, by their corners nearest to the origin: a square
/// for each side that no other cube covers. Requires: no cube is there twice.
ClosedSurface surface_of_cubes(const std::vector<Int3>& cubes, std::int64_t scale);

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_GENERATE_CLOSED_SURFACE_H
