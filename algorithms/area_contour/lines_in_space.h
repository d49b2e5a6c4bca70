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
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "algorithms/area_contour/exact_lines.h"
#include "algorithms/shadow_volumes/touching_planes.h"
#include "kernel/concept/kernel_concept.h"
#include "kernel/implicit/plane_provenance.h"
#include "kernel/numbers/double_double.h"

namespace gnomon::area_contour {

/// Values of planes at the corners of one receiver, those of a plane found at once. Of a receiver
/// with very many lines they are forgotten now and then, rather than that memory grows.
class CornerValues {
 public:
  template <class Vertex>
  void begin(const std::vector<Corner<Vertex>>& corners) {
    vertices_.clear();
    for (const Corner<Vertex>& corner : corners) vertices_.push_back(corner.vertex.source);
    forget();
  }
  template <class Space>
  const DoubleDouble& at(const Space& space, std::uint32_t plane, std::uint32_t corner) {
    if (rows_.size() == kMost && !rows_.contains(plane)) forget();
    const auto [row, is_new] = rows_.try_emplace(plane, static_cast<std::uint32_t>(values_.size()));
    if (is_new) {
      values_.resize(values_.size() + vertices_.size());
      space.values_at(plane, vertices_, std::span(values_).subspan(row->second));
    }
    return values_[row->second + corner];
  }

 private:
  using Rows = std::unordered_map<std::uint32_t, std::uint32_t>;  // of planes: where values begin
  static constexpr std::size_t kMost = 4096;                      // planes

  void forget() {
    if (rows_.empty()) return;
    values_.clear();
    // To clear a table takes as long as it is large, which few receivers need.
    constexpr std::size_t kLarge = 256;
    if (rows_.bucket_count() > kLarge) {
      rows_ = Rows();  // {} would leave the table as large
    } else {
      rows_.clear();
    }
  }

  std::vector<VertexId> vertices_;
  Rows rows_;
  std::vector<DoubleDouble> values_;
};

template <VolumeSpaceModel Space>
class LinesInSpace final : public ExactLines {
 public:
  using Vertex = typename Space::Vertex;

  /// `corners`: those of the receiver in the order of its chart, which may be that of `loop`
  /// reversed. `values`: to work with. All must outlive it.
  LinesInSpace(Space& space, const LoopView<Vertex>& loop,
               const std::vector<Corner<Vertex>>& corners, const ReceiverChart& chart,
               CornerValues& values)
      : ExactLines(chart), space_(space), loop_(loop), corners_(corners), values_(values) {
    values_.begin(corners);
    // Doubles that say nothing: the corner is the point.
    nowhere_.bound = std::numeric_limits<float>::infinity();
  }

  bool is_known_same(const OutlineLine& a, const OutlineLine& b) override {
    return name_of(a.plane) == name_of(b.plane) || share_vertices(a.plane, b.plane);
  }
  double distance_of(const OutlineLine& line, std::uint32_t corner) override {
    return std::fabs(space_.value_at(line.plane, corners_[corner].vertex.source));
  }
  Side side_of_meet(const OutlineLine& line, const OutlineLine& a, const OutlineLine& b) override {
    return space_.side_of_plane(line.plane,
                                Corner<Vertex>{a.plane, nowhere_, b.plane, loop_.support});
  }

 protected:
  DoubleDouble value_at(const OutlineLine& line, std::uint32_t corner) override {
    const DoubleDouble& value = values_.at(space_, line.plane.index(), corner);
    return line.plane.flipped() ? -value : value;
  }
  Side exact_side_at_border(const OutlineLine& line, const OutlineLine& a,
                            std::uint32_t corner) override {
    const auto n = static_cast<std::uint32_t>(corners_.size());
    // Edge i of the loop runs from its corner i to the next one.
    const std::uint32_t edge = chart().reversed ? n - 1 - corner : corner;
    return space_.side_of_plane(
        line.plane, Corner<Vertex>{loop_.edges[edge], nowhere_, a.plane, loop_.support});
  }
  Ball exact_place_on(const OutlineLine& line, const OutlineLine& by) override {
    const Corner<Vertex> corner{line.plane, nowhere_, by.plane, loop_.support};
    const std::array<Ball, 3> point = space_.offset(corners_[0].vertex.source, corner);
    return Ball(line.b) * point[chart().u()] - Ball(line.a) * point[chart().v()];
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

  /// Whether two planes go through the same two vertices of the receiver's plane: those of an edge
  /// of a caster that stands on it, mostly.
  bool share_vertices(PlaneRef a, PlaneRef b) {
    if (b.index() < space_.edges().planes) std::swap(a, b);
    const VolumePlaneSource& source = space_.source_of(b);
    if (source.is_explicit()) return false;
    int shared = 0;
    for (const VertexId v : source.vertices) {
      const Vertex vertex = space_.input_vertex(v);
      const Corner<Vertex> corner = lone_corner(vertex);
      if (space_.side_of_plane(PlaneRef(loop_.support), corner) == Side::kOn &&
          space_.side_of_plane(a, corner) == Side::kOn) {
        ++shared;
      }
    }
    return shared == 2;
  }

  Space& space_;
  LoopView<Vertex> loop_;
  const std::vector<Corner<Vertex>>& corners_;
  CornerValues& values_;
  Vertex nowhere_;
};

}  // namespace gnomon::area_contour

#endif  // GNOMON_ALGORITHMS_AREA_CONTOUR_LINES_IN_SPACE_H
