// SPDX-License-Identifier: LGPL-3.0-or-later
// The volumes of a light as the search has them, from those of a space whose planes have doubles.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_LIGHT_VOLUMES_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_LIGHT_VOLUMES_H

#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/area_contour/receiver_chart.h"
#include "algorithms/area_contour/volume_search.h"
#include "algorithms/partition/box.h"
#include "algorithms/partition/import_export.h"
#include "algorithms/shadow_volumes/caster_tree.h"
#include "algorithms/shadow_volumes/light_geometry.h"
#include "algorithms/shadow_volumes/light_in_space.h"
#include "algorithms/shadow_volumes/shadow_volume.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon::area_contour {

/// A space whose planes have doubles with proven bounds, and tell what they were made from.
template <class Space>
concept HasPlaneDoubles = requires(const Space& space, PlaneRef plane) {
  space.load(plane).n;
  space.source_of(plane);
};

template <class Space>
PlaneDoubles doubles_of(const Space& space, PlaneRef plane) {
  const auto loaded = space.load(plane);
  return {loaded.n, loaded.d, plane, nullptr};
}

/// The volumes of a light for the search. `jobs`: as LightVolumes::finish() has it.
template <VolumeSpaceModel Space>
LightVolumes light_volumes(const Space& space, const LightGeometry& geometry,
                           const CasterTree& tree, const LightInSpace<Space>& light,
                           unsigned jobs) {
  const PreparedScene& scene = light.scene();
  const auto parts = static_cast<std::uint32_t>(scene.parts.size());
  std::vector<Box> boxes;
  boxes.reserve(parts + std::size_t{light.shell_count()});
  for (std::uint32_t part = 0; part < parts; ++part) boxes.push_back(tree.box(part));
  for (std::uint32_t shell = parts; shell < parts + light.shell_count(); ++shell) {
    Box box;
    for (const std::uint32_t part : light.shell(shell).parts) box.add(boxes[part]);
    boxes.push_back(box);
  }
  Box box;
  std::vector<Point3> corners;
  double bound = 0;
  for (const VertexId vertex : geometry.faces[light.number()].loop) {
    corners.push_back(grid_fraction(geometry.geometry.grid, vertex));
    box.add(corners.back());
    bound = static_cast<double>(space.input_vertex(vertex).bound);  // all have the same
  }
  LightVolumes result(std::move(boxes), box, std::move(corners), bound);
  const VolumeStore& store = light.volumes();
  const auto add_umbras = [&](std::uint32_t part, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      result.add_umbra(i, part, scene.parts[part].plane, store[i].umbra_count);
    }
  };
  for (std::uint32_t part = 0; part < parts; ++part) {
    if (light.shell_of(part) != ShellCasters::kNone) continue;
    for (auto [i, end] = light.volumes_of(part); i < end; ++i) {
      result.add(i, part, store[i].penumbra_count);
      add_umbras(part, i, i + 1);
    }
  }
  for (std::uint32_t shell = parts; shell < parts + light.shell_count(); ++shell) {
    const auto [begin, end] = light.volumes_of(shell);
    if (begin == end) continue;
    result.add(begin, shell, store[begin].penumbra_count);
    for (const std::uint32_t part : light.shell(shell).parts) {
      const auto [first, last] = light.volumes_of(part);
      add_umbras(part, first, last);
    }
  }
  result.finish(jobs, [&](std::uint32_t volume, bool umbra, std::vector<PlaneDoubles>& planes) {
    planes.clear();
    const ShadowVolume& own = store[volume];
    for (const PlaneRef plane : umbra ? store.umbra(own) : store.penumbra(own)) {
      planes.push_back(doubles_of(space, plane));
    }
  });
  return result;
}

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_LIGHT_VOLUMES_H
