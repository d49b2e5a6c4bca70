// SPDX-License-Identifier: LGPL-3.0-or-later
// Back-to-front order of a scene from an eye point by the scene BSP (Fuchs, Kedem & Naylor 1980),
// for pictures: later pieces may be painted over earlier ones. The order is exact (kernel `plane`),
// the coordinates of cut vertices are rounded.
#ifndef GNOMON_ALGORITHMS_PAINTERS_ORDER_H
#define GNOMON_ALGORITHMS_PAINTERS_ORDER_H

#include <array>
#include <cstdint>
#include <vector>

#include "gnomon/scene/prepare.h"

namespace gnomon {

/// A convex piece of a part.
struct OrderedPiece {
  std::uint32_t part = 0;
  std::vector<std::array<double, 3>> loop;  // scene units
};

/// Every part of the scene, cut where the order needs it, farthest first. Pieces of one plane are
/// adjacent; they do not hide each other (coplanar overlap: in order of parts).
std::vector<OrderedPiece> back_to_front(const PreparedScene& scene,
                                        const std::array<double, 3>& eye);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PAINTERS_ORDER_H
