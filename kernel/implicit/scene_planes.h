// SPDX-License-Identifier: LGPL-3.0-or-later
// Support planes and vertices of loops in space, as the filter of kernel `plane` sees them: in
// doubles of size 1 with proven bounds. Which side is which, implicit_scene_space.h decides.
//
// Guarantee: every bound is proven (SceneBounds); what doubles cannot hold has an infinite one.
#ifndef GNOMON_KERNEL_IMPLICIT_SCENE_PLANES_H
#define GNOMON_KERNEL_IMPLICIT_SCENE_PLANES_H

#include <array>
#include <cstdint>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "kernel/implicit/filter_bounds.h"
#include "kernel/signs/ball.h"
#include "kernel/signs/corner.h"

namespace gnomon {

class ScenePlanes {
 public:
  /// Doubles in grid units times 2^-b, so that every coordinate is in [0, 1]; `error` bounds the
  /// distance of each to the true coordinate (infinite: the doubles say nothing).
  struct Vertex {
    std::array<double, 3> x{};
    double error = 0;
    VertexId source = kMadeVertex;
  };

  explicit ScenePlanes(const Geometry& geometry);

  const Geometry& geometry() const { return *geometry_; }
  SceneEdges edges() const { return {static_cast<std::uint32_t>(geometry_->planes.size())}; }
  Vertex input_vertex(VertexId v) const;
  /// Where the edge from `from` to `to`, which has the two ends strictly on different sides of
  /// `plane`, meets it. Only the doubles are computed; the vertex is the corner that the caller
  /// puts it in.
  Vertex crossing(PlaneRef plane, PlaneRef edge, bool leaving, const Corner<Vertex>& from,
                  const Corner<Vertex>& to) const;

  /// In scene units, for heuristics only.
  std::array<double, 3> approximate(const Vertex& vertex) const {
    std::array<double, 3> point;
    for (int k = 0; k < 3; ++k) point[k] = origin_[k] + scale_ * vertex.x[k];
    return point;
  }
  /// Enclosures of n and d of a support plane for positions in grid units times 2^-b, up to a
  /// common positive factor; of infinite radius where doubles cannot hold it.
  std::array<Ball, 4> plane_enclosure(PlaneId plane) const;

 protected:
  struct FilteredPlane {
    std::array<double, 3> n{};  // |n_k| < 1
    double d = 0;               // |d| < 3
    bool usable = false;

    double value(const std::array<double, 3>& x) const {
      return n[0] * x[0] + n[1] * x[1] + n[2] * x[2] - d;
    }
  };
  const FilteredPlane& filtered(PlaneId plane) const { return planes_[plane]; }
  unsigned grid_bits() const { return bits_; }

 private:
  FilteredPlane make_filtered(PlaneId plane) const;

  const Geometry* geometry_;
  std::vector<FilteredPlane> planes_;
  std::array<double, 3> origin_{};
  double scale_ = 1;
  unsigned bits_;
};

}  // namespace gnomon

#endif  // GNOMON_KERNEL_IMPLICIT_SCENE_PLANES_H
