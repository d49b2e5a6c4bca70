// SPDX-License-Identifier: LGPL-3.0-or-later
// The shadow volumes of all casters of a scene under one light, on one thread or on several.
//
// Threads make the volumes of blocks of casters, each block with a fork of the space that has no
// planes of volumes yet. The space then takes the blocks over in the order of casters, so that
// volumes and planes have the numbers that one thread would give them.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_VOLUMES_OF_CASTERS_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_VOLUMES_OF_CASTERS_H

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
#include "algorithms/shadow_volumes/shell_volume.h"
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
                      LoopStore<typename Space::Vertex>& loops, VolumeStore& store,
                      VolumesWanted wanted = VolumesWanted::kBoth) {
  const Part& part = scene.parts[index];
  const auto loop = part_loop(space, scene, index, loops);
  builder.add(loop, plane_of_side(part, Side::kFront), false, light, store, wanted);
  if (part.two_sided) {
    builder.add(loop, plane_of_side(part, Side::kBack), true, light, store, wanted);
  }
}

struct VolumesOfCasters {
  VolumeStore store;
  std::vector<std::uint32_t> first;  // of each caster, its first volume; then the number of volumes
  StageCounts stages;                // of forks, which the space has not counted
};

/// Makes volumes of one caster after another with one space.
template <VolumeSpaceModel Space>
struct VolumeTools {
  VolumeTools(Space& own, const Rules& rules) : space(own), builder(own, rules), shells(own) {}
  Space& space;
  VolumeBuilder<Space> builder;
  ShellBuilder<Space> shells;
  LoopStore<typename Space::Vertex> loops;
};

/// Casters of a block; several blocks a thread even out what they cost.
inline constexpr std::uint32_t kCastersOfABlock = 512;
/// Room for so many planes is made for each caster of the other kind.
inline constexpr std::size_t kPlanesOfOthers = 12;

/// Adds the volumes of casters [begin, end), as add(tools, caster, store) does.
template <VolumeSpaceModel Space, class Add>
void add_volumes_of_casters(Space& space, const Rules& rules, const Add& add, std::uint32_t begin,
                            std::uint32_t end, VolumesOfCasters& made) {
  VolumeTools<Space> tools(space, rules);
  for (std::uint32_t i = begin; i < end; ++i) {
    made.first.push_back(static_cast<std::uint32_t>(made.store.size()));
    add(tools, i, made.store);
  }
}

/// Makes the volumes of all casters, block by block on the threads of the arena that the caller is
/// in.
template <TakesPlanes Space, class Add>
VolumesOfCasters make_volumes_in_blocks(Space& space, const Rules& rules, std::uint32_t casters,
                                        const Add& add) {
  struct Block {
    std::optional<Space> space;
    VolumesOfCasters made;
  };
  std::vector<Block> blocks((casters + kCastersOfABlock - 1) / kCastersOfABlock);
  Space empty = space.fork();
  empty.release_planes(0);
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
    Block& block = blocks[i];
    block.space.emplace(empty.fork());
    const auto begin = static_cast<std::uint32_t>(i) * kCastersOfABlock;
    add_volumes_of_casters(*block.space, rules, add, begin,
                           std::min(casters, begin + kCastersOfABlock), block.made);
  });
  std::size_t volumes = 0, planes = 0, own_planes = 0;
  for (const Block& block : blocks) {
    volumes += block.made.store.size();
    planes += block.made.store.plane_count();
    own_planes += block.space->plane_mark();
  }
  VolumesOfCasters all;
  all.first.reserve(casters + std::size_t{1});
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

/// Makes the volumes of casters [0, casters), those of each by add(tools, caster, store), and adds
/// their planes to `space`. Casters before and from `others` on are of two kinds. `jobs` other than
/// 1: on the threads of the arena that the caller is in. Requires: planes go through input
/// vertices.
template <VolumeSpaceModel Space, class Add>
VolumesOfCasters make_volumes(Space& space, const Rules& rules, std::uint32_t casters,
                              std::uint32_t others, const Add& add, unsigned jobs) {
  VolumesOfCasters made;
  const auto on_this_thread = [&](std::uint32_t first, std::uint32_t last) {
    const std::uint32_t before = space.plane_mark();
    for (std::uint32_t begin = first; begin < last; begin += kCastersOfABlock) {
      add_volumes_of_casters(space, rules, add, begin, std::min(last, begin + kCastersOfABlock),
                             made);
      if (begin > first) continue;
      // The first ones tell how many planes there will be, about: a list that is moved while it
      // grows takes twice its memory, and room to spare takes none.
      if constexpr (TakesPlanes<Space>) {
        space.reserve_planes((space.plane_mark() - before) * std::size_t{last - first} /
                                 kCastersOfABlock +
                             kPlanesOfOthers * (casters - last));
      }
    }
  };
  const auto on_one_thread = [&] {
    made.first.reserve(casters + std::size_t{1});
    on_this_thread(0, others);
    on_this_thread(others, casters);
  };
  if constexpr (TakesPlanes<Space>) {
    if (jobs != 1 && casters > kCastersOfABlock) {
      made = make_volumes_in_blocks(space, rules, casters, add);
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

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_VOLUMES_OF_CASTERS_H
