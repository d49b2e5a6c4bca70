// SPDX-License-Identifier: LGPL-3.0-or-later
// The fragments of a method of object space at the samples of a picture: which lights reach the
// point that is seen, as the fragment that holds it says.
//
// Exactness: where the result has exact loops, the point is computed in rationals and its place in
// a loop is decided exactly. A point on the border of two fragments is taken to be in the first of
// them: where the two have different classes it lies on a border of light and shadow, which says
// nothing of either. On rounded kernels everything is rounded, and a point that no fragment holds
// is in the one that it is nearest to.
#ifndef GNOMON_ALGORITHMS_RUN_SAMPLED_FRAGMENTS_H
#define GNOMON_ALGORITHMS_RUN_SAMPLED_FRAGMENTS_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <vector>

#include "gnomon/algorithms/pixels.h"
#include "gnomon/algorithms/shadow_result.h"

namespace gnomon {

class SampledFragments {
 public:
  /// `result`: with points, on exact kernels also exact ones; of the lights of a picture, in order.
  SampledFragments(const PreparedScene& scene, const ImageFrame& frame, const ShadowResult& result);

  /// The lights that reach the point of a part that a sample sees, as bits. Requires: the ray meets
  /// the part's plane.
  std::uint64_t lights_at(std::uint32_t part, ImageSample sample);

 private:
  using Exact = std::array<mpq_class, 3>;
  /// A point that is seen: as a rational one (exact results), and near it in doubles.
  struct Seen {
    Exact exact;
    std::array<double, 3> nearest{};
  };
  struct PlaneOf {
    Exact normal;  // of the part's front, scene units
    mpq_class at_eye;
    std::array<double, 3> nearest_normal{};
    double nearest_at_eye = 0;
    int x = 0, y = 1;  // coordinates in which a loop of the front turns left
    bool made = false;
  };

  const PlaneOf& plane_of(std::uint32_t part);
  Seen point_at(const PlaneOf& plane, ImageSample sample) const;
  bool reaches(const LightResult& light, const PartResult& of, const PlaneOf& plane,
               const Seen& seen) const;
  /// The least of the distances to the lines of the edges, positive inside; rounded.
  double depth_in(const LightResult& light, const Fragment& fragment, const PlaneOf& plane,
                  bool back, const Seen& seen) const;
  bool holds(const LightResult& light, const Fragment& fragment, const PlaneOf& plane, bool back,
             const Seen& seen) const;

  const PreparedScene& scene_;
  const ImageFrame& frame_;
  const ShadowResult& result_;
  Exact eye_;
  std::vector<PlaneOf> planes_;  // a part each
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_SAMPLED_FRAGMENTS_H
