// SPDX-License-Identifier: GPL-3.0-or-later
// From parts back to the polygons of the file: every input polygon once for each side that faces or
// sees the light, or once with its front if none does, with the shares of its parts added up. The
// result says which sides these are and why a part is dark; nothing of that is decided here again.
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
#include <string>
#include <vector>

#include "gnomon/algorithms/deep_umbra.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/sign.h"
#include "gnomon/result/classes.h"
#include "gnomon/scene/prepare.h"
#include "report/sides/part_weights.h"

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
  const ExactFractions* exact = nullptr;  // where computed and `reason` is not set
  bool area_light = false;
  ShadowReason reason = ShadowReason::kNone;

  bool sees() const { return reason == ShadowReason::kNone; }
};

struct ClassifiedSide : Shares {  // of the polygon
  std::uint32_t polygon = 0;
  Side side = Side::kFront;
  bool area_light = false;
  std::vector<PartSide> parts;                // none if the polygon was dropped
  ShadowReason reason = ShadowReason::kNone;  // set if all parts share it
  bool coplanar = true;                       // all parts lie in one plane
  // If computed, and coplanar or all of one class; those of the light's classes.
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
/// The same for who asks for many polygons or lights.
std::vector<ClassifiedSide> polygon_sides(const PreparedScene& scene, const LightResult& light,
                                          std::uint32_t polygon, bool exact,
                                          const PartWeights& weights);
/// The shares of one side alone: those of polygon_sides() where it lists the side, else all of it
/// is in shadow (umbra). Requires: the polygon was not dropped.
Shares side_shares(const PreparedScene& scene, const LightResult& light, std::uint32_t polygon,
                   Side side, const PartWeights& weights);

/// The same of all polygons under one light, in order of polygons. It points into the light's
/// result.
std::vector<ClassifiedSide> classified_sides(const PreparedScene& scene, const LightResult& light,
                                             bool exact);
/// The same under each light of a result, computed once for all who read it.
using SidesByLight = std::vector<std::vector<ClassifiedSide>>;
SidesByLight classified_sides(const PreparedScene& scene, const ShadowResult& result, bool exact);

/// The exact share of one part. Requires: `exact_fractions` were asked for.
mpq_class exact_share(const PartSide& part, LightState state);

/// The share of a side of several parts to far more digits than a double has, in whatever planes
/// they lie. Requires: `exact_fractions` were asked for.
mpq_class precise_share(const PreparedScene& scene, const ClassifiedSide& side, LightState state);
/// Bounds of the share of a side that is in the deep umbra of its area light. `bounds`: of the
/// parts of the same LightResult, one for each.
Interval deep_umbra_share(const PreparedScene& scene, const LightResult& light,
                          const ClassifiedSide& side, std::span<const DeepUmbraBounds> bounds);

/// The ids of the polygons that parts are of, each once, in the order of parts.
std::vector<std::string> caster_ids(const Scene& scene, const PreparedScene& prepared,
                                    std::span<const std::uint32_t> parts);

/// The id of a result's light; a piece of a light is named by its number: "panel/0".
std::string light_name(const Scene& scene, const PreparedScene& prepared, const LightResult& light);

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
