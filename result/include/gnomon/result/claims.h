// SPDX-License-Identifier: LGPL-3.0-or-later
// What is claimed of a scene: a partition of polygons into classified loops, whoever made it. The
// oracle judges claims, pictures show them. Points are exact rationals in scene units: of a float
// kernel or of a foreign file they are the numbers that it wrote.
#ifndef GNOMON_RESULT_CLAIMS_H
#define GNOMON_RESULT_CLAIMS_H

#include <gmpxx.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/result/classes.h"

namespace gnomon {

using RationalPoint = std::array<mpq_class, 3>;

struct ClaimedFragment {
  LightState state = LightState::kLit;
  bool exact = false;               // the loop claims to be exact, not rounded to doubles
  std::vector<RationalPoint> loop;  // any orientation, not closed (first point not repeated)
  std::string caster;               // polygon id of the witness, empty if none is named
  std::string reason;               // as written, the name of a ShadowReason or not; or empty
};

/// One side of a polygon.
struct ClaimedPolygon {
  std::string id;
  Side side = Side::kFront;
  bool side_given = true;  // false: a foreign file that names no side means the only one
  // As claimed, if claimed exactly; shadow for point lights, penumbra and umbra for area lights.
  std::optional<mpq_class> lit_fraction, shadow_fraction, penumbra_fraction, umbra_fraction;
  std::vector<ClaimedFragment> fragments;
};

struct ClaimedLight {
  std::string id;
  std::optional<LightState> background;  // everything not covered has this class
  Cover cover = Cover::kPartition;       // what the fragments of a side mean together
  // Area lights: umbra is claimed where one caster alone hides all of the light, and nowhere else
  // ("umbra": "per-caster"). Otherwise it may be claimed wherever no light arrives, and need not
  // be.
  bool per_caster_umbra = false;
  std::vector<ClaimedPolygon> polygons;
};

struct Claims {
  std::string name;  // kernel or file, for messages
  std::vector<ClaimedLight> lights;
};

}  // namespace gnomon

#endif  // GNOMON_RESULT_CLAIMS_H
