// SPDX-License-Identifier: LGPL-3.0-or-later
// The volumes that a target of `basic` is tested against: all that are alive, in the order in which
// they were inserted.
#ifndef GNOMON_ALGORITHMS_BASIC_ALL_VOLUMES_H
#define GNOMON_ALGORITHMS_BASIC_ALL_VOLUMES_H

#include <algorithm>
#include <span>
#include <vector>

#include "algorithms/basic/volume_list.h"

namespace gnomon {

template <LightSpaceModel Space>
class AllVolumes {
 public:
  using Loop = LoopView<typename Space::Vertex>;

  AllVolumes(LightScene<Space>&, VolumeList<Space>& volumes) : volumes_(volumes) {}

  /// Where in light space a loop is: nothing that helps here.
  struct Place {};
  Place find(const Loop&) { return {}; }
  /// The living volumes. Valid until the next call of any function.
  std::span<const VolumeId> at(const Place&) {
    std::erase_if(alive_, [&](VolumeId id) { return !volumes_.is_alive(id); });
    return alive_;
  }
  void count_target(std::size_t) const {}
  void insert(VolumeId id, const Place&) { alive_.push_back(id); }
  std::uint64_t subtract(const Loop& target, std::span<const VolumeId> volumes,
                         ClassifiedLoops<typename Space::Vertex>& output) {
    return volumes_.subtract(target, volumes, output);
  }
  void count(WorkCounts&) const {}
  std::uint64_t vanished() const { return 0; }

 private:
  VolumeList<Space>& volumes_;
  std::vector<VolumeId> alive_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BASIC_ALL_VOLUMES_H
