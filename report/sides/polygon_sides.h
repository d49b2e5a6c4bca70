// SPDX-License-Identifier: GPL-3.0-or-later
// From parts back to the polygons of the file: every input polygon once for each side that faces or
// sees the light, or once with its front if none does, with the shares of its parts added up.
//
// Exactness: shares of coplanar parts are weighted by exact areas and summed as rationals; for a
// polygon whose parts lie in several planes (areas are then square roots) the sum is a certified
// enclosure.
#ifndef GNOMON_REPORT_SIDES_POLYGON_SIDES_H
#define GNOMON_REPORT_SIDES_POLYGON_SIDES_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "gnomon/algorithms/deep_umbra.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::report {

/// Fractions of an area. Under a point or directional light it is lit or in shadow, under an area
/// light lit, penumbra or umbra; the other classes are 0.
struct Shares {
  Interval lit, shadow, penumbra, umbra;
};

/// A part as seen from one side of its polygon. If `reason` is set, the part is entirely in shadow
/// (umbra) there; else `result` holds its fragments.
struct PartSide : Shares {  // of the part
  const PartResult* result = nullptr;
  const AreaFractions* area_fractions = nullptr;  // area lights, where `reason` is not set
  bool area_light = false;
  ShadowReason reason = ShadowReason::kNone;
};

struct ClassifiedSide : Shares {  // of the polygon
  std::uint32_t polygon = 0;
  Side side = Side::kFront;
  bool area_light = false;
  std::vector<PartSide> parts;                // none if the polygon was dropped
  ShadowReason reason = ShadowReason::kNone;  // set if all parts share it
  bool coplanar = true;                       // all parts lie in one plane
  mpq_class area;                             // scene units squared, far closer than a double
  // If coplanar and computed; those of the light's classes.
  std::optional<mpq_class> exact_lit, exact_shadow, exact_penumbra, exact_umbra;
};

/// The classes that a light of that kind knows, in the order of files.
std::span<const LightState> light_states(bool area_light);
/// One class of them.
const Interval& share_of(const Shares& shares, LightState state);
const std::optional<mpq_class>& exact_share_of(const ClassifiedSide& side, LightState state);

/// The sides of one polygon that face or see the light, front before back; empty if it was dropped.
/// `exact`: the parts carry exact fractions.
std::vector<ClassifiedSide> polygon_sides(const PreparedScene& scene, const LightResult& light,
                                          std::uint32_t polygon, bool exact);

/// The exact share of one part, as far as `exact_fractions` were asked for.
mpq_class exact_share(const PartSide& part, LightState state);

/// Twice the part's area vector on the scene's grid, in the orientation of its own front.
std::array<mpz_class, 3> doubled_area_vector(const PreparedScene& scene, const Part& part);
/// The sign of the part's own plane at a point or directional light: positive if its front faces
/// it.
Sign sign_at_light(const PreparedScene& scene, const Part& part, const LightPoint& light);
/// The part receives with that side, and sees the area light: some of the light is in front of the
/// side's plane, and some of the part in front of the light's.
bool sees_area_light(const PreparedScene& scene, const Part& part, Side side,
                     const PreparedLight& light);
/// The part's plane has some of the area light strictly on either side.
bool cuts_area_light(const PreparedScene& scene, const Part& part, const PreparedLight& light);
/// The area light's plane has some of the part strictly on either side.
bool reaches_behind(const PreparedScene& scene, const Part& part, const PreparedLight& light);
/// Bounds of the part's area in scene units squared; [0, infinity] beyond the range of doubles.
Interval part_area(const PreparedScene& scene, const Part& part);

/// The double nearest to the part's area, scene units squared.
double nearest_area(const PreparedScene& scene, const Part& part);
/// The area of a polygon's parts, to far more digits than a double has.
mpq_class precise_area(const PreparedScene& scene, std::uint32_t polygon);
/// Area in scene units squared of all sides of parts that face or see one of the lights, once a
/// light.
double facing_area(const PreparedScene& scene, const std::vector<std::uint32_t>& lights);

/// Bounds of the share of a side that is in the deep umbra of its area light. `bounds`: of the
/// parts of the same LightResult, one for each.
Interval deep_umbra_share(const PreparedScene& scene, const LightResult& light,
                          const ClassifiedSide& side, std::span<const DeepUmbraBounds> bounds);

/// "faces-away", "light-in-plane", "behind-light"; empty for kNone.
std::string_view reason_name(ShadowReason reason);
std::string_view state_name(LightState state);
std::string_view side_name(Side side);

/// How many polygons have a side that faces the light, or sees an area light, of those that were
/// not dropped.
struct FacingShare {
  std::uint64_t facing = 0, away = 0, in_plane = 0;
  double away_share() const {
    const double all = static_cast<double>(facing + away + in_plane);
    return all > 0 ? static_cast<double>(away + in_plane) / all : 0;
  }
};
FacingShare facing_share(const PreparedScene& scene, const LightResult& light);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_SIDES_POLYGON_SIDES_H
