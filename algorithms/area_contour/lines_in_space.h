// SPDX-License-Identifier: LGPL-3.0-or-later
// What the bounds of a union leave open about lines of a receiver, from the kernel: a point of two
// lines is the corner in which their planes and the receiver's meet, and a third plane has it on
// one side.
//
// Exactness: that of the space's decisions. Degree: 9, or as the light's cut vertices have it.
#ifndef GNOMON_ALGORITHMS_AREA_CONTOUR_LINES_IN_SPACE_H
#define GNOMON_ALGORITHMS_AREA_CONTOUR_LINES_IN_SPACE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "algorithms/area_contour/outline_union.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/implicit/plane_provenance.h"

namespace gnomon::area_contour {

template <VolumeSpaceModel Space>
class LinesInSpace final : public ExactLines {
 public:
  using Vertex = typename Space::Vertex;

  /// `corners`: those of the receiver in the order of its chart, which may be that of `loop`
  /// reversed. All must outlive it.
  LinesInSpace(Space& space, const LoopView<Vertex>& loop,
               const std::vector<Corner<Vertex>>& corners, const ReceiverChart& chart)
      : space_(space), loop_(loop), corners_(corners), chart_(chart) {
    // Doubles that say nothing: the corner is the point.
    nowhere_.bound = std::numeric_limits<float>::infinity();
  }

  bool is_known_same(const OutlineLine& a, const OutlineLine& b) override {
    return name_of(a.plane) == name_of(b.plane);
  }
  Side side_of_corner(const OutlineLine& line, std::uint32_t corner) override {
    return space_.side_of_plane(line.plane, corners_[corner]);
  }
  double distance_of(const OutlineLine& line, std::uint32_t corner) override {
    return std::fabs(space_.value_at(line.plane, corners_[corner].vertex.source));
  }
  Side side_of_meet(const OutlineLine& line, const OutlineLine& a, const OutlineLine& b) override {
    return space_.side_of_plane(line.plane,
                                Corner<Vertex>{a.plane, nowhere_, b.plane, loop_.support});
  }
  Side side_at_border(const OutlineLine& line, const OutlineLine& a,
                      std::uint32_t corner) override {
    const auto n = static_cast<std::uint32_t>(corners_.size());
    // Edge i of the loop runs from its corner i to the next one.
    const std::uint32_t edge = chart_.reversed ? n - 1 - corner : corner;
    return space_.side_of_plane(
        line.plane, Corner<Vertex>{loop_.edges[edge], nowhere_, a.plane, loop_.support});
  }
  Ball place_on(const OutlineLine& line, const OutlineLine& by) override {
    const Corner<Vertex> corner{line.plane, nowhere_, by.plane, loop_.support};
    const std::array<Ball, 3> point = space_.offset(corners_[0].vertex.source, corner);
    return Ball(line.b) * point[chart_.u()] - Ball(line.a) * point[chart_.v()];
  }

 private:
  /// What a line is known by: planes through three input vertices by the three, others by their
  /// number.
  std::array<std::uint32_t, 3> name_of(PlaneRef plane) const {
    constexpr std::uint32_t kSupport = 0xffffffffu, kAdded = 0xfffffffdu;  // no vertices
    const std::uint32_t number = plane.index();
    if (number < space_.edges().planes) return {number, kSupport, kSupport};
    const VolumePlaneSource& source = space_.source_of(plane);
    if (source.is_explicit()) return {number, kAdded, kAdded};
    std::array<std::uint32_t, 3> points = source.vertices;
    std::ranges::sort(points);
    return points;
  }

  Space& space_;
  LoopView<Vertex> loop_;
  const std::vector<Corner<Vertex>>& corners_;
  const ReceiverChart& chart_;
  Vertex nowhere_;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_LINES_IN_SPACE_H
