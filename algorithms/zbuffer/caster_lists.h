// SPDX-License-Identifier: LGPL-3.0-or-later
// Which parts may shadow a part: those that face the light and are left when balls around parts,
// and then the sides of whole loops, have been asked. A list is made when its part is first seen.
#ifndef GNOMON_ALGORITHMS_ZBUFFER_CASTER_LISTS_H
#define GNOMON_ALGORITHMS_ZBUFFER_CASTER_LISTS_H

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/part_balls.h"

namespace gnomon {

template <ImageSpaceModel Space>
class CasterLists {
 public:
  CasterLists(ImageScene<Space>& scene, const PartBalls& balls)
      : scene_(scene), balls_(balls), lists_(scene.light_count()) {
    for (std::size_t l = 0; l < lists_.size(); ++l) {
      const std::vector<Part>& parts = scene.scene().parts;
      lists_[l].of_part.resize(parts.size());
      for (std::uint32_t p = 0; p < parts.size(); ++p) {
        if (parts[p].casts && scene.facing_light(p, l).valid()) lists_[l].casters.push_back(p);
      }
    }
  }

  /// Requires: the part faces the light.
  const std::vector<std::uint32_t>& of(std::uint32_t part, std::size_t l) {
    std::optional<std::vector<std::uint32_t>>& list = lists_[l].of_part[part];
    if (!list) {
      list.emplace();
      for (const std::uint32_t caster : lists_[l].casters) {
        if (may_shadow(caster, part, l)) list->push_back(caster);
      }
    }
    return *list;
  }

 private:
  struct OfLight {
    std::vector<std::uint32_t> casters;
    std::vector<std::optional<std::vector<std::uint32_t>>> of_part;
  };

  bool may_shadow(std::uint32_t caster, std::uint32_t part, std::size_t l) {
    const PlaneRef own = scene_.facing_light(part, l), other = scene_.facing_light(caster, l);
    // Coplanar parts do not shadow each other.
    if (own.same_plane(other) || balls_.are_apart(scene_.light_point(l), caster, part) ||
        !reaches(caster, own, Side::kFront) || !reaches(part, other, Side::kBack)) {
      return false;
    }
    const std::size_t edges = scene_.scene().parts[caster].count;
    for (std::size_t k = 0; k < edges; ++k) {
      if (!reaches(part, scene_.shadow_plane(caster, k, l), Side::kFront)) return false;
    }
    return true;
  }
  /// Is a vertex of the part on that side?
  bool reaches(std::uint32_t part, PlaneRef plane, Side side) {
    return std::ranges::any_of(scene_.scene().loop(scene_.scene().parts[part]), [&](VertexId v) {
      return scene_.space().side_of_vertex(plane, v) == side;
    });
  }

  ImageScene<Space>& scene_;
  const PartBalls& balls_;
  std::vector<OfLight> lists_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ZBUFFER_CASTER_LISTS_H
