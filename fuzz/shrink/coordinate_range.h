// SPDX-License-Identifier: GPL-3.0-or-later
// The range that a scene's coordinates have on each axis, and 0: where shrinking may put them.
#ifndef GNOMON_FUZZ_SHRINK_COORDINATE_RANGE_H
#define GNOMON_FUZZ_SHRINK_COORDINATE_RANGE_H

#include <gmpxx.h>

#include <array>

#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

class CoordinateRange {
 public:
  explicit CoordinateRange(const Scene& scene);
  /// Whether all positions of a scene are within the range of positions, and the directions of its
  /// lights within that of directions. Directions have no length: 1 is always within.
  bool holds(const Scene& scene) const;

 private:
  struct Bounds {
    std::array<mpq_class, 3> low, high;  // low <= 0 <= high
    void add(const Position& position);
    bool hold(const Position& position) const;
  };
  Bounds positions_, directions_;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_SHRINK_COORDINATE_RANGE_H
