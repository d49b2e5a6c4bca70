// SPDX-License-Identifier: GPL-3.0-or-later
// How parts stand to lights, decided exactly from the prepared scene alone: for facts that are told
// before anything is classified. Whoever has a result reads sides and reasons from it.
#ifndef GNOMON_REPORT_FACTS_FACING_H
#define GNOMON_REPORT_FACTS_FACING_H

#include <cstdint>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::report {

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
/// Area in scene units squared of all sides of parts that face or see one of the lights, once a
/// light.
double facing_area(const PreparedScene& scene, const std::vector<std::uint32_t>& lights);
/// The same as a share of the square over the scene's box, for ratios: where areas in scene units
/// overflow or underflow, these do not.
double relative_facing_area(const PreparedScene& scene, const std::vector<std::uint32_t>& lights);
double relative_area(const PreparedScene& scene, const Part& part);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_FACTS_FACING_H
