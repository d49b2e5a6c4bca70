// SPDX-License-Identifier: GPL-3.0-or-later
// The coplanar parts of one polygon in the frame of their plane, and what casters hide from them as
// intersections of half-planes there: made of exact integers, each number rounded once. The checker
// of claims (witness_check.h) decides with them whatever is farther from a border than their error,
// and rounded claims altogether.
#ifndef GNOMON_ORACLE_JUDGE_FAMILY_SHADES_H
#define GNOMON_ORACLE_JUDGE_FAMILY_SHADES_H

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"
#include "oracle/geometry/planar_loop.h"
#include "oracle/geometry/plane_frame.h"
#include "oracle/judge/light_volumes.h"

namespace gnomon::oracle {

/// A half-space on the plane: all of it, none of it, or what is inside of a line.
struct FlatHalf {
  enum class Kind { kAll, kNone, kLine };
  Kind kind = Kind::kAll;
  PlanarLine line;
};
PlanarLoop cut(const PlanarLoop& loop, const FlatHalf& half);

/// What of the plane one caster hides: what is inside of all lines.
struct Shade {
  std::uint32_t part = 0;  // that casts
  std::vector<PlanarLine> lines;
  std::vector<std::size_t> bounds;  // of each line: which of the caster's planes it is of
  PlanarBox box;                    // of what is inside, around the family, and a margin
  /// All of the loop is outside, by more than the lines' error.
  bool is_apart(const PlanarLoop& loop, long double error) const;
};

/// Shades, found by their boxes.
class Shades {
 public:
  void add(Shade shade);
  /// In order of their parts.
  std::vector<const Shade*> near(const PlanarBox& box);
  const std::vector<Shade>& all() const { return shades_; }

 private:
  std::vector<Shade> shades_;
  // By the left end of their boxes, with the greatest right end of all up to each.
  std::vector<std::uint32_t> order_;
  std::vector<long double> reach_;
};

class FamilyShades {
 public:
  /// `parts`: coplanar, of one polygon. Keeps references.
  FamilyShades(const PreparedScene& scene, LightVolumes& light,
               std::span<const std::uint32_t> parts, Side side);
  FamilyShades(const FamilyShades&) = delete;
  FamilyShades& operator=(const FamilyShades&) = delete;

  const PlaneFrame& frame() const { return frame_; }
  /// Counter-clockwise, in order of the parts.
  const std::vector<PlanarLoop>& loops() const { return loops_; }
  const std::vector<std::vector<PlanarLine>>& lines() const { return lines_; }
  long double area() const { return area_; }
  /// Distance from 0 of a coordinate of the family.
  long double greatest() const { return greatest_; }
  /// Of a value of a line that was made of planes at a point of the family.
  long double error() const { return error_; }

  /// What is in shadow, or in penumbra under an area light.
  Shades& partly();
  /// What is in umbra. Requires: an area light.
  Shades& wholly();
  /// The planes of the light's region, outside in front.
  const std::vector<FlatHalf>& outsides();
  /// What is inside, around the family; with its borders.
  PlanarLoop region_of(const Shade& shade) const;
  /// Requires: an area light.
  const FlatHalf& before_light();

 private:
  FlatHalf half_of(const ExactPlane& plane, bool closed) const;
  void add_shade(Shades& shades, std::uint32_t part, const std::vector<ExactPlane>& planes,
                 bool closed);
  void add_volumes(Shades& shades, bool all);

  const PreparedScene& scene_;
  LightVolumes& light_;
  std::vector<std::uint32_t> parts_;
  Side side_;
  PlaneFrame frame_;
  std::vector<PlanarLoop> loops_;
  std::vector<std::vector<PlanarLine>> lines_;
  PlanarLoop surroundings_;
  long double area_ = 0, greatest_ = 0, error_ = 0;
  std::optional<Shades> partly_, wholly_;
  std::optional<FlatHalf> before_light_;
  std::optional<std::vector<FlatHalf>> outsides_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_FAMILY_SHADES_H
