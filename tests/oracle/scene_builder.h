// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes by hand and by chance for the oracle's tests, and candidates made from the oracle's own
// regions: each lit piece is cut by the lines of every shadow, one after the other.
#ifndef GNOMON_TESTS_ORACLE_SCENE_BUILDER_H
#define GNOMON_TESTS_ORACLE_SCENE_BUILDER_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/oracle/exact_answer.h"
#include "gnomon/oracle/verdict.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::oracle {

using Triple = std::array<double, 3>;

struct BuiltScene {
  Scene scene;
  PreparedScene prepared;
};

class SceneBuilder {
 public:
  SceneBuilder& polygon(const std::string& id, const std::vector<Triple>& loop,
                        bool two_sided = false, bool casts = true);
  /// Axis-parallel box, six outward quads "<id>.0" .. "<id>.5".
  SceneBuilder& box(const std::string& id, Triple low, Triple high);
  SceneBuilder& point(const std::string& id, Triple position);
  SceneBuilder& sun(const std::string& id, Triple to_light);
  /// Emits to the side from which the loop is counter-clockwise.
  SceneBuilder& area(const std::string& id, const std::vector<Triple>& loop);
  /// Throws std::runtime_error if the scene cannot be prepared.
  BuiltScene build() const;

 private:
  Scene scene_;
};

/// splitmix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// Uniform enough in [low, high].
  int integer(int low, int high);

 private:
  std::uint64_t state_;
};

/// Random triangles and quads on a small lattice: full of touching, crossing and coplanar ones.
BuiltScene lattice_soup(std::uint64_t seed, int polygons, int size);

/// The same under a square or triangular area light of that lattice, which in general crosses,
/// touches and shares features with them.
BuiltScene lattice_area_soup(std::uint64_t seed, int polygons, int size);

/// Classes of area lights are claimed per caster.
Claims exact_candidate(const ExactAnswer& answer);
RationalPoint at(double x, double y, double z);

/// A square of 16 by 16 at height 0, and under area lights the light above its middle, which faces
/// down.
extern const std::vector<Triple> kFloor, kPanel;
/// An exact fragment at height z.
ClaimedFragment rectangle(LightState state, double x0, double y0, double x1, double y1,
                          double z = 0);
/// The first fragment of that class of a polygon under the first light. Throws std::runtime_error
/// if there is none.
ClaimedFragment& fragment_of(Claims& claims, std::size_t polygon, LightState state);

/// What the oracle says of them; fails the test if it refuses to.
Report certified(const BuiltScene& built, const Claims& claims, const CertifyOptions& options = {});
/// The first violation that the checker of claims finds; empty if there is none.
std::string first_finding(const BuiltScene& built, const Claims& claims);

}  // namespace gnomon::oracle

#endif  // GNOMON_TESTS_ORACLE_SCENE_BUILDER_H
