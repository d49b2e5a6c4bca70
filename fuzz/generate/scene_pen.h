// SPDX-License-Identifier: GPL-3.0-or-later
// Writes small scenes: integer coordinates in, and one rule that says what an integer means (a
// power of two, or a decimal), so that one shape can be had at every scale and as either kind of
// number.
#ifndef GNOMON_FUZZ_GENERATE_SCENE_PEN_H
#define GNOMON_FUZZ_GENERATE_SCENE_PEN_H

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/scene/scene.h"
#include "scene/base/vectors.h"

namespace gnomon::fuzz {

using Triple = std::array<std::int64_t, 3>;

Triple operator+(const Triple& a, const Triple& b);
Triple operator-(const Triple& a, const Triple& b);
Triple operator*(std::int64_t factor, const Triple& a);

class ScenePen {
 public:
  /// An integer n means n * 2^exponent.
  explicit ScenePen(int exponent = 0) : exponent_(exponent) {}
  /// An integer n means n * 10^exponent, and the scene's numbers are decimals.
  static ScenePen decimal(int exponent);

  /// Flags of the polygons that follow.
  ScenePen& two_sided(bool value) {
    two_sided_ = value;
    return *this;
  }
  ScenePen& casts(bool value) {
    casts_ = value;
    return *this;
  }
  /// The id is the polygon's index.
  ScenePen& polygon(const std::vector<Triple>& loop);
  ScenePen& polygon_at(const std::vector<Position>& loop);
  /// Six outward faces, or inward ones.
  ScenePen& box(const Triple& low, const Triple& high, bool inward = false);
  ScenePen& lamp(const Triple& position);
  ScenePen& lamp_at(Position position);
  ScenePen& sun(const Triple& to_light);
  ScenePen& sun_at(Position to_light);
  /// An area light; it emits to the side from which the loop is counter-clockwise.
  ScenePen& panel(const std::vector<Triple>& loop);

  Number number(std::int64_t value) const;
  Position position(const Triple& value) const;
  Scene take() { return std::move(scene_); }
  const Scene& scene() const { return scene_; }

 private:
  ScenePen& light(LightType type, Position position);

  Scene scene_;
  int exponent_;
  bool two_sided_ = false, casts_ = true;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_GENERATE_SCENE_PEN_H
