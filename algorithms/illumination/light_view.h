// SPDX-License-Identifier: LGPL-3.0-or-later
// LightView holds what all points that look at one light share: the casters that can hide any of
// it, their planes, and the affine chart of an area light's plane in which everything is decided.
//
// Chart: the point a0 + s e1 + t e2 of the light's plane is (s, t), homogeneous (s w, t w, w) with
// w > 0; a plane cuts the chart in a line (l1, l2, l3), whose value l1 s + l2 t + l3 is the plane's
// up to a positive factor. a0 is the light's first vertex, e1 and e2 its edges there, so that the
// light runs counter-clockwise in the chart, seen from its front.
#ifndef GNOMON_ALGORITHMS_ILLUMINATION_LIGHT_VIEW_H
#define GNOMON_ALGORITHMS_ILLUMINATION_LIGHT_VIEW_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/illumination/apex.h"
#include "algorithms/illumination/light_shaft.h"
#include "algorithms/partition/box_tree.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// SignCounts counts decisions. Each call counts its own, and its caller adds them up.
struct SignCounts {
  std::uint64_t all = 0, exact = 0;
};

class LightView {
 public:
  /// A caster, and which of its sides can hide light: those that have some of the light in front.
  struct Caster {
    std::uint32_t part = 0;
    bool front = false, back = false;
    bool cuts = false;  // its plane cuts the light, whether or not both sides count
  };
  struct ExactPlane {
    ExactVector normal;
    mpz_class offset;  // value: normal . x - offset
  };

  /// Keeps a reference to the scene. `light`: any type; the chart is of area lights only.
  LightView(const PreparedScene& scene, std::uint32_t light);

  const PreparedScene& scene() const { return scene_; }
  const PreparedLight& light() const { return scene_.lights[light_]; }
  const std::vector<Caster>& casters() const { return casters_; }

  // --- Planes of parts, in the orientation of Geometry::planes ---
  ExactPlane exact_plane(PlaneId plane) const;
  BallVector normal(PlaneId plane) const;
  Sign side_of(PlaneId plane, const Apex& apex, SignCounts& counts) const;

  // --- The plane through an edge (from its a to its b) and an apex: normal (b - a) x (p - a) ---
  BallVector edge_normal(EdgeId edge, const Apex& apex) const;
  ExactPlane exact_edge_plane(EdgeId edge, const Apex& apex) const;
  /// Tells on which side of that plane a point is.
  Sign side_of_edge_plane(EdgeId edge, const Apex& apex, const Apex& point,
                          SignCounts& counts) const;
  const PairPoint& pairs(VertexId vertex) const { return pairs_[vertex]; }
  ExactVector grid_point(VertexId vertex) const;

  // --- Area lights: the chart ---
  std::uint32_t corners() const { return static_cast<std::uint32_t>(corners_.size()); }
  /// Homogeneous chart coordinates of corner i.
  const ExactVector& corner(std::uint32_t i) const { return corners_[i]; }
  const std::array<Ball, 2>& near_corner(std::uint32_t i) const { return near_corners_[i]; }
  /// The lines of the light's edges, the light in front.
  const ExactVector& edge_line(std::uint32_t i) const { return edge_lines_[i]; }
  const std::array<Ball, 3>& near_edge_line(std::uint32_t i) const { return near_edge_lines_[i]; }
  ExactVector line_of(const ExactPlane& plane) const;
  /// From the plane's normal and a point x of it, given as a0 - x.
  std::array<Ball, 3> line_of(const BallVector& normal, const BallVector& to_origin) const;
  /// The light's first point, or a directional one's direction times a power of two, at most 1.
  const PairPoint& origin_pairs() const { return light_pairs_[0]; }
  const ExactVector& origin() const { return light_grid_[0]; }
  const ExactVector& axis(int i) const { return axes_[static_cast<std::size_t>(i)]; }
  const BallVector& near_axis(int i) const { return near_axes_[static_cast<std::size_t>(i)]; }
  /// Tells on which side of the light's plane an apex is; kPositive: in front.
  Sign side_of_light(const Apex& apex, SignCounts& counts) const;
  /// Whether some, or all, of the light is strictly in front of, or behind, a plane.
  struct Sides {
    bool front = false, back = false;
  };
  Sides sides_of(PlaneId plane) const;

  /// Appends the indices, in casters(), of all casters that may hide something from the apex; those
  /// that look large from there come first. `receiver`, if not kNoPlane: the plane of the receiver,
  /// which looks to its front (or to its back, if `back`).
  static constexpr PlaneId kNoPlane = 0xffffffffu;
  void find_casters(const Apex& apex, PlaneId receiver, bool back,
                    std::vector<std::uint32_t>& found) const;
  /// Appends those that may hide something from any point of the convex hull of the apexes.
  void find_casters(std::span<const Apex> apexes, PlaneId receiver, bool back,
                    std::vector<std::uint32_t>& found) const;

 private:
  void make_chart();
  void find_sides();
  LightShaft shaft_of(const Apex& apex, PlaneId receiver, bool back) const;
  void add_planes(LightShaft& shaft, PlaneId receiver, bool back) const;

  const PreparedScene& scene_;
  std::uint32_t light_;
  VertexPairs pairs_;
  std::vector<Caster> casters_;
  BoxTree tree_;  // of casters, by number in casters_
  std::vector<ExactVector> light_grid_;
  std::vector<PairPoint> light_pairs_;
  std::array<ExactVector, 2> axes_;
  std::array<BallVector, 2> near_axes_;
  ExactPlane light_plane_;
  BallVector light_normal_;
  std::vector<ExactVector> corners_, edge_lines_;
  std::vector<std::array<Ball, 2>> near_corners_;
  std::vector<std::array<Ball, 3>> near_edge_lines_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ILLUMINATION_LIGHT_VIEW_H
