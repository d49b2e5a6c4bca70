// SPDX-License-Identifier: LGPL-3.0-or-later
// How a space takes over planes that its forks have added, so that several threads may make the
// planes of one space: each adds planes to a fork of its own, and the space takes these over in an
// order that does not depend on threads.
#ifndef GNOMON_KERNEL_CONCEPT_PLANE_TAKEOVER_H
#define GNOMON_KERNEL_CONCEPT_PLANE_TAKEOVER_H

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "gnomon/kernel/orientation.h"

namespace gnomon {

/// The numbers that planes of a fork have in the space that has taken them over.
struct PlaneShift {
  std::uint32_t first = 0;  // support planes and edges, below it, keep theirs
  std::uint32_t by = 0;

  /// Requires: a valid plane.
  PlaneRef operator()(PlaneRef plane) const {
    return plane.index() < first ? plane : PlaneRef(plane.index() + by, plane.flipped());
  }
};

/// A volume space that takes planes over.
///  - take_planes(fork) adds the planes that were added to a fork, in their order, and tells their
///    numbers here. Requires: the fork had released all planes (mark 0) before these were added.
///  - reserve_planes(more) makes room for so many more.
///  - share_planes(): forks that are made from now on have those that are there in common.
template <class S>
concept TakesPlanes = S::kParallel && requires(S& space, S fork, std::size_t more) {
  { space.take_planes(std::move(fork)) } -> std::same_as<PlaneShift>;
  space.reserve_planes(more);
  space.share_planes();
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_CONCEPT_PLANE_TAKEOVER_H
