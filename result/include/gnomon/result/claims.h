// SPDX-License-Identifier: LGPL-3.0-or-later
// What is claimed of a scene: a partition of polygons into classified loops, whoever made it. The
// oracle judges claims, pictures show them. Points are exact rationals in scene units: of a float
// kernel or of a foreign file they are the numbers that it wrote.
#ifndef GNOMON_RESULT_CLAIMS_H
#define GNOMON_RESULT_CLAIMS_H

#include <gmpxx.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "gnomon/result/classes.h"

namespace gnomon {

using RationalPoint = std::array<mpq_class, 3>;

using RationalLoop = std::vector<RationalPoint>;

/// A region of a polygon's side: a loop without its holes.
struct ClaimedShape {
  bool exact = false;  // the loops claim to be exact, not rounded to doubles
  RationalLoop loop;   // any orientation, not closed (first point not repeated)
  std::vector<RationalLoop> holes;
  bool operator==(const ClaimedShape&) const = default;
};

struct ClaimedFragment : ClaimedShape {
  LightState state = LightState::kLit;
  std::string caster;  // polygon id of the witness, empty if none is named
  /// Polygon ids of several that are the witness together; else empty.
  std::vector<std::string> casters;
  std::string reason;  // as written, the name of a ShadowReason or not; or empty
  /// Cover::kOverlay: of the fragments that hold a point, those of the highest level tell its
  /// class.
  std::uint64_t level = 0;
  bool operator==(const ClaimedFragment&) const = default;
};

/// How much of a side is lit, where it is not told where.
struct ClaimedShare {
  double lower = 0, upper = 1;      // bounds of the lit share; equal ones are a rounded share
  std::optional<LightState> whole;  // the class of all of the side, if it has one
  bool operator==(const ClaimedShare&) const = default;
};

/// The share of one class as a file tells it that says how much of a side has it, and not where.
struct ToldShare {
  LightState state = LightState::kLit;
  mpq_class value;     // of the polygon; `is_area`: scene units squared
  mpq_class rounding;  // how far off the truth may be, by the digits written; 0 of a fraction "p/q"
  bool is_area = false;  // else a fraction
  /// The file has numbers with all digits of a double: they came so out of a computation, and
  /// nobody claims the last digits of any of them.
  bool is_double = false;
  std::string text;  // as written
  bool operator==(const ToldShare&) const = default;
};

/// One side of a polygon.
struct ClaimedPolygon {
  std::string id;
  Side side = Side::kFront;
  bool side_given = true;  // false: a foreign file that names no side means the only one
  // As claimed, if claimed exactly; shadow for point lights, penumbra and umbra for area lights.
  std::optional<mpq_class> lit_fraction, shadow_fraction, penumbra_fraction, umbra_fraction;
  std::vector<ClaimedFragment> fragments;
  ClaimedShare share;  // ClaimedTerms::shares_alone, of a method without fragments
  /// Of a file: there are no fragments, and these shares are all that is claimed.
  std::vector<ToldShare> told;
  bool operator==(const ClaimedPolygon&) const = default;
};

/// How the fragments of a light are meant.
struct ClaimedTerms {
  std::optional<LightState> background;  // everything not covered has this class
  /// Only membership in these classes is told: what no fragment covers, or one of another class, is
  /// in none of them.
  std::optional<std::vector<LightState>> listed;
  Cover cover = Cover::kPartition;
  /// Area lights: umbra is claimed where one caster alone hides all of the light, and nowhere else
  /// ("umbra": "per-caster"). Otherwise it may be claimed wherever no light arrives, and need not
  /// be.
  bool per_caster_umbra = false;
  /// There are no fragments, and every side claims how much of it has a class: by ClaimedPolygon's
  /// `told`, or, of point and directional lights, by its `share` and exact fractions if there are
  /// any.
  bool shares_alone = false;
  /// kLights: fragments name what hides the light, and every side is listed. Else they name
  /// nothing, and sides that no light reaches may be missing; of kOverlay, what lies on a side that
  /// this light does not reach tells of other lights alone.
  Block block = Block::kLights;
  bool operator==(const ClaimedTerms&) const = default;
};

struct ClaimedLight : ClaimedTerms {
  std::string id;
  std::vector<ClaimedPolygon> polygons;
  std::string piece_of;     // id of the area light that this light is a piece of, or empty
  RationalLoop piece_loop;  // of such a piece, counter-clockwise seen from its front
  bool operator==(const ClaimedLight&) const = default;
};

/// A region of a polygon's side and what several lights do to it.
struct SharedFragment : ClaimedShape {
  std::vector<std::string> lit_by, penumbra_of;  // Block::kCombined: ids of lights
  // Block::kOverlay.
  std::uint64_t level = 0;
  std::vector<std::string> dark_for;  // ids of lights
  std::optional<std::size_t> on;      // the fragment of the same side that it was cut from
  bool operator==(const SharedFragment&) const = default;
};

struct SharedPolygon {
  std::string id;
  Side side = Side::kFront;
  bool side_given = true;
  std::vector<SharedFragment> fragments;
  bool operator==(const SharedPolygon&) const = default;
};

struct Claims {
  std::string name;  // kernel or file, for messages
  std::vector<ClaimedLight> lights;
  /// What is told of several lights at once; none: nothing is. shared_claims.h has it light by
  /// light.
  std::optional<std::vector<SharedPolygon>> combined, overlay;
  /// What is wrong whatever the scene looks like, in sentences: each fails the claims.
  std::vector<std::string> problems;

  /// Whoever claims it.
  bool same_as(const Claims& other) const {
    return lights == other.lights && combined == other.combined && overlay == other.overlay &&
           problems == other.problems;
  }
};

}  // namespace gnomon

#endif  // GNOMON_RESULT_CLAIMS_H
