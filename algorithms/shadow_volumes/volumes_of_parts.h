// SPDX-License-Identifier: LGPL-3.0-or-later
// The shadow volumes of all parts of a scene under one light, on one thread or on several.
//
// Threads make the volumes of blocks of parts, each block with a fork of the space that has no
// planes of volumes yet. The space then takes the blocks over in the order of parts, so that
// volumes and planes have the numbers that one thread would give them.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_VOLUMES_OF_PARTS_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_VOLUMES_OF_PARTS_H

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "algorithms/partition/import_export.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/rules.h"
#include "algorithms/shadow_volumes/shadow_volume.h"
#include "gnomon/kernel/stage_counts.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/concept/plane_takeover.h"

namespace gnomon {

/// The support plane of a part, turned so that its front is the given side's.
inline PlaneRef plane_of_side(const Part& part, Side side) {
  return PlaneRef(part.plane, part.flipped != (side == Side::kBack));
}

/// The volumes of both sides of a part, for one shape of the light.
template <VolumeSpaceModel Space, class SpaceOfLoops>
void add_part_volumes(VolumeBuilder<Space>& builder, const SpaceOfLoops& space,
                      const PreparedScene& scene, std::uint32_t index,
                      const LightShape<typename Space::Vertex>& light,
                      LoopStore<typename Space::Vertex>& loops, VolumeStore& store) {
  const Part& part = scene.parts[index];
  const auto loop = part_loop(space, scene, index, loops);
  builder.add(loop, plane_of_side(part, Side::kFront), false, light, store);
  if (part.two_sided) builder.add(loop, plane_of_side(part, Side::kBack), true, light, store);
}

struct VolumesOfParts {
  VolumeStore store;
  std::vector<std::uint32_t> first;  // of each part, its first volume; then the number of volumes
  StageCounts stages;                // of forks, which the space has not counted
};

/// Parts of a block; several blocks a thread even out what they cost.
inline constexpr std::uint32_t kPartsOfABlock = 512;

/// Adds the volumes of parts [begin, end) that cast.
template <VolumeSpaceModel Space, class Casts>
void add_volumes_of_parts(Space& space, const Rules& rules, const PreparedScene& scene,
                          const LightShape<typename Space::Vertex>& light, const Casts& casts,
                          std::uint32_t begin, std::uint32_t end, VolumesOfParts& made) {
  VolumeBuilder<Space> builder(space, rules);
  LoopStore<typename Space::Vertex> loops;
  for (std::uint32_t i = begin; i < end; ++i) {
    made.first.push_back(static_cast<std::uint32_t>(made.store.size()));
    if (casts(scene.parts[i])) {
      add_part_volumes(builder, space, scene, i, light, loops, made.store);
    }
  }
}

/// Makes the volumes of all parts that `casts(part)`, block by block on the threads of the arena
/// that the caller is in.
template <TakesPlanes Space, class Casts>
VolumesOfParts make_volumes_in_blocks(Space& space, const Rules& rules, const PreparedScene& scene,
                                      const LightShape<typename Space::Vertex>& light,
                                      const Casts& casts) {
  struct Block {
    std::optional<Space> space;
    VolumesOfParts made;
  };
  const auto parts = static_cast<std::uint32_t>(scene.parts.size());
  std::vector<Block> blocks((parts + kPartsOfABlock - 1) / kPartsOfABlock);
  Space empty = space.fork();
  empty.release_planes(0);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
    Block& block = blocks[i];
    block.space.emplace(empty.fork());
    const auto begin = static_cast<std::uint32_t>(i) * kPartsOfABlock;
    add_volumes_of_parts(*block.space, rules, scene, light, casts, begin,
                         std::min(parts, begin + kPartsOfABlock), block.made);
  });
  std::size_t volumes = 0, planes = 0, own_planes = 0;
  for (const Block& block : blocks) {
    volumes += block.made.store.size();
    planes += block.made.store.plane_count();
    own_planes += block.space->plane_mark();
  }
  VolumesOfParts all;
  all.first.reserve(parts + std::size_t{1});
  all.store.reserve_more(volumes, planes);
  space.reserve_planes(own_planes);
  for (Block& block : blocks) {
    for (const std::uint32_t first : block.made.first) {
      all.first.push_back(static_cast<std::uint32_t>(all.store.size()) + first);
    }
    all.stages += block.space->stage_counts();
    all.store.append(block.made.store, space.take_planes(*std::move(block.space)));
    block = {};
  }
  return all;
}

/// Makes the volumes of all parts that `casts(part)`, and adds their planes to `space`. `jobs`
/// other than 1: on the threads of the arena that the caller is in. Requires: the loop of `light`
/// has no planes but support planes and input edges.
template <VolumeSpaceModel Space, class Casts>
VolumesOfParts make_volumes_of_parts(Space& space, const Rules& rules, const PreparedScene& scene,
                                     const LightShape<typename Space::Vertex>& light,
                                     const Casts& casts, unsigned jobs) {
  VolumesOfParts made;
  const auto parts = static_cast<std::uint32_t>(scene.parts.size());
  const auto on_one_thread = [&] {
    made.first.reserve(parts + std::size_t{1});
    const std::uint32_t before = space.plane_mark();
    for (std::uint32_t begin = 0; begin < parts; begin += kPartsOfABlock) {
      add_volumes_of_parts(space, rules, scene, light, casts, begin,
                           std::min(parts, begin + kPartsOfABlock), made);
      if (begin > 0) continue;
      // The first parts tell how many planes there will be, about: a list that is moved while it
      // grows takes twice its memory.
      if constexpr (TakesPlanes<Space>) {
        space.reserve_planes((space.plane_mark() - before) * std::size_t{parts} / kPartsOfABlock);
      }
    }
  };
  if constexpr (TakesPlanes<Space>) {
    if (jobs != 1 && parts > kPartsOfABlock) {
      made = make_volumes_in_blocks(space, rules, scene, light, casts);
    } else {
      on_one_thread();
    }
  } else {
    on_one_thread();
  }
  made.first.push_back(static_cast<std::uint32_t>(made.store.size()));
  return made;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_VOLUMES_OF_PARTS_H
