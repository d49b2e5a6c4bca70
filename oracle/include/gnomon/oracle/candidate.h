// SPDX-License-Identifier: GPL-3.0-or-later
// What the oracle judges: a partition of polygons into classified loops, whoever made it. Points
// are exact rationals in scene units: of a float kernel or of a foreign file they are the numbers
// it wrote.
#ifndef GNOMON_ORACLE_CANDIDATE_H
#define GNOMON_ORACLE_CANDIDATE_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::oracle {

using ExactPoint = std::array<mpq_class, 3>;

enum class ShadeClass : std::uint8_t { kLit, kShadow, kPenumbra, kUmbra };
enum class PolygonSide : std::uint8_t { kFront, kBack };

struct CandidateFragment {
  ShadeClass shade = ShadeClass::kLit;
  bool exact = false;            // the loop claims to be exact, not rounded to doubles
  std::vector<ExactPoint> loop;  // any orientation, not closed (first point not repeated)
  std::string caster;            // polygon id of the witness, empty if none is named
  std::string reason;            // "faces-away", "light-in-plane", "behind-light", or empty
};

struct CandidatePolygon {
  std::string id;
  PolygonSide side = PolygonSide::kFront;
  bool side_given = true;  // false: a foreign file that names no side means the only one
  // As claimed, if claimed exactly; shadow for point lights, penumbra and umbra for area lights.
  std::optional<mpq_class> lit_fraction, shadow_fraction, penumbra_fraction, umbra_fraction;
  std::vector<CandidateFragment> fragments;
};

struct CandidateLight {
  std::string id;
  std::optional<ShadeClass> background;  // everything not covered has this class
  // Area lights: umbra is claimed where one caster alone hides all of the light, and nowhere else
  // ("umbra": "per-caster"). Otherwise it may be claimed wherever no light arrives, and need not
  // be.
  bool per_caster_umbra = false;
  std::vector<CandidatePolygon> polygons;
};

struct Candidate {
  std::string name;  // kernel or file, for messages
  std::vector<CandidateLight> lights;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_CANDIDATE_H
