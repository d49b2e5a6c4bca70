// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/generate/closed_surface.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>

namespace gnomon::scene_detail {

void ClosedSurface::join(const Loop& first, const Loop& second) {
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::size_t next = (i + 1) % first.size();
    add({first[i], first[next], second[next], second[i]});
  }
}

void ClosedSurface::cut_until(std::size_t polygons) {
  std::vector<Loop> faces;
  std::size_t to_cut = polygons - faces_.size();
  for (Loop& face : faces_) {
    if (to_cut > 0 && face.size() == 4) {
      faces.push_back({face[0], face[1], face[2]});
      face.erase(face.begin() + 1);
      --to_cut;
    }
    faces.push_back(std::move(face));
  }
  faces_ = std::move(faces);
}

void ClosedSurface::write(SceneMaker& maker, const std::string& id) const {
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    maker.face(id + "." + std::to_string(i), faces_[i]);
  }
}

ClosedSurface::Loop ring_of(const ClosedSurface::Loop& corners, std::int64_t scale,
                            std::int64_t z) {
  ClosedSurface::Loop ring;
  ring.reserve(corners.size());
  for (const Int3& corner : corners) ring.push_back({scale * corner.x, scale * corner.y, z});
  return ring;
}

ClosedSurface::Loop reversed(ClosedSurface::Loop loop) {
  std::ranges::reverse(loop);
  return loop;
}

ClosedSurface surface_of_cubes(const std::vector<Int3>& cubes, std::int64_t scale) {
  const auto key = [](Int3 p) { return std::tuple(p.x, p.y, p.z); };
  std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t>> filled;
  for (const Int3& cube : cubes) filled.insert(key(cube));
  // Two directions of a side whose cross product points out of the cube.
  const std::array<Int3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  ClosedSurface surface;
  for (const Int3& cube : cubes) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Int3 out = axes[k], u = axes[(k + 1) % 3], v = axes[(k + 2) % 3];
      const auto side = [&](Int3 corner) {
        return ClosedSurface::Loop{scale * corner, scale * (corner + u), scale * (corner + u + v),
                                   scale * (corner + v)};
      };
      if (!filled.contains(key(cube + out))) surface.add(side(cube + out));
      if (!filled.contains(key(cube - out))) surface.add(reversed(side(cube)));
    }
  }
  return surface;
}

}  // namespace gnomon::scene_detail
