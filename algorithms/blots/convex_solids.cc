// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/blots/convex_solids.h"

#include <utility>

#include "gnomon/algorithms/components.h"

namespace gnomon {

std::vector<std::vector<std::uint32_t>> convex_solids(const PreparedScene& scene, bool all_cast) {
  std::vector<std::vector<std::uint32_t>> solids;
  for (Component& component : find_components(scene)) {
    const auto serves = [&](std::uint32_t part) {
      return (all_cast || scene.parts[part].casts) && !scene.parts[part].two_sided;
    };
    if (component.is_convex && std::ranges::all_of(component.parts, serves)) {
      solids.push_back(std::move(component.parts));
    }
  }
  return solids;
}

std::vector<EdgeId> contour_of(const PreparedScene& scene, std::span<const std::uint32_t> faces) {
  std::vector<EdgeId> all;
  for (const std::uint32_t part : faces) {
    for (const PlaneRef edge : scene.edges(scene.parts[part])) all.push_back(edge.index());
  }
  std::ranges::sort(all);
  std::vector<EdgeId> contour;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool shared =
        (i > 0 && all[i - 1] == all[i]) || (i + 1 < all.size() && all[i + 1] == all[i]);
    if (!shared) contour.push_back(all[i]);
  }
  return contour;
}

}  // namespace gnomon
