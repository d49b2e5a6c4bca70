// SPDX-License-Identifier: GPL-3.0-or-later
// What one light reaches, for the checker of claims (witness_check.h): how much of a convex piece
// of a polygon casters shadow, and how much they hide part or all of the light from, by cutting the
// piece by their volumes.
//
// Exactness: exact, in rational numbers of scene units. Doubles only put aside what is clearly
// apart.
//
// Threads: under a point or directional light, const members may be called from several at once.
#ifndef GNOMON_ORACLE_JUDGE_LIGHT_VOLUMES_H
#define GNOMON_ORACLE_JUDGE_LIGHT_VOLUMES_H

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/result/classes.h"
#include "oracle/geometry/chart.h"
#include "oracle/geometry/scene_point.h"
#include "oracle/judge/made_once.h"
#include "oracle/judge/witness_pieces.h"
#include "oracle/visibility/area_solids.h"
#include "oracle/visibility/light_index.h"

namespace gnomon::oracle {

/// A half-space on the grid, by a primitive normal if its base is on the grid.
ExactPlane grid_plane(const Geometry& geometry, const space::HalfSpace& half);

class LightVolumes {
 public:
  /// Keeps references to both. `diagonal`: of its box, scene units.
  LightVolumes(const PreparedScene& scene, const PreparedLight& light, double diagonal);
  LightVolumes(const LightVolumes&) = delete;
  LightVolumes& operator=(const LightVolumes&) = delete;

  /// Made when first asked for.
  const Solid& solid(std::uint32_t part) const;
  /// Requires: a point or directional light.
  const LightStanding& standing(std::uint32_t part) const { return standings_[part]; }
  bool is_area() const { return area_.has_value(); }
  /// Requires: an area light.
  AreaSolids& area() { return *area_; }
  bool sees(std::uint32_t part, Side side) const;

  /// What of a piece is not in the shadow of the parts of one caster; or of any, and is inside of
  /// the region. Requires: a point or directional light.
  std::vector<space::Loop> not_shadowed(const Piece& piece,
                                        std::optional<std::uint32_t> caster) const;
  /// The same of several casters together.
  std::vector<space::Loop> not_shadowed_by(const Piece& piece,
                                           std::span<const std::uint32_t> casters) const;
  /// What is strictly in front of one of them is outside of the light's region.
  const std::vector<space::HalfSpace>& outsides() const { return outsides_; }
  /// The same on the grid.
  const std::vector<ExactPlane>& outside_grid_planes() const { return outside_planes_; }
  /// What of a loop is inside of the region; any loop, convex or not, by its area.
  space::Loop inside_region(space::Loop loop) const;
  /// What of a piece one part shadows, along the piece's normal. Requires: as above.
  mpq_class shadowed_by(const Piece& piece, std::uint32_t part) const;
  /// What of loops of a piece in front of the light is in no penumbra volume, or if `all` no umbra
  /// volume, of the parts of one caster, or of any. Requires: an area light.
  std::vector<space::Loop> not_hidden(const Piece& piece, std::vector<space::Loop> loops,
                                      std::optional<std::uint32_t> caster, Side side, bool all);
  /// The piece in front of the light's plane. Requires: an area light.
  std::vector<space::Loop> before_light(const Piece& piece) const;
  /// What of a piece is in a volume and in front of the light; `closed`: also if the receiver lies
  /// in one of its planes. Requires: an area light.
  space::Loop inside(const Piece& piece, const AreaSolids::Volume& volume, bool closed) const;

  /// The area of each class in a piece, along its normal: by one caster alone where it is umbra.
  std::array<mpq_class, 4> areas_of_classes(const Piece& piece, Side side);  // by LightState

  /// Casting parts that may shadow some of a part, in order. Requires: a point or directional
  /// light.
  std::vector<std::uint32_t> overlapping(std::uint32_t part) const {
    return index_->overlapping(part);
  }
  /// The bounds of what a part shadows, and of a volume of area(), on the grid: made when first
  /// asked for.
  const std::vector<ExactPlane>& shadow_planes(std::uint32_t part) const;
  const std::vector<ExactPlane>& planes_of(const AreaSolids::Volume& volume);
  /// shadow_planes() for points in scene units.
  const std::vector<Integers4>& scene_planes(std::uint32_t part) const;
  /// The part's own vertices, and where the light is: at infinity if it is directional. Requires: a
  /// point or directional light.
  const std::vector<Integers4>& scene_loop(std::uint32_t part) const;
  const Integers4& scene_source() const { return *source_; }
  /// shadow_planes() in scene units, and rational.
  const std::vector<space::HalfSpace>& shadow(std::uint32_t part) const;

  bool is_apart(const Piece& piece, const std::vector<space::HalfSpace>& bounds) const {
    return piece.is_apart(bounds, 1e-6 * diagonal_);
  }

 private:
  std::vector<space::Loop> without_shadows(const Piece& piece, std::vector<space::Loop> rest,
                                           std::uint32_t first, std::uint32_t last) const;

  const PreparedScene& scene_;
  const PreparedLight& own_;
  double diagonal_;
  mutable std::vector<MadeOnce<Solid>> solids_;  // by part
  std::vector<LightStanding> standings_;         // by part, without an area
  std::optional<AreaSolids> area_;
  std::vector<ExactPlane> outside_planes_;
  std::vector<space::HalfSpace> outsides_;
  std::optional<LightIndex> index_;                                       // without an area
  mutable std::vector<MadeOnce<std::vector<ExactPlane>>> shadow_planes_;  // by part
  mutable std::vector<MadeOnce<std::vector<Integers4>>> scene_planes_, scene_loops_;  // by part
  std::optional<Integers4> source_;                                       // without an area
  mutable std::vector<MadeOnce<std::vector<space::HalfSpace>>> shadows_;  // by part
  std::unordered_map<const AreaSolids::Volume*, std::vector<ExactPlane>> volume_planes_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_LIGHT_VOLUMES_H
