// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/generate/scene_pen.h"

#include <utility>

namespace gnomon::fuzz {

Triple operator+(const Triple& a, const Triple& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Triple operator-(const Triple& a, const Triple& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Triple operator*(std::int64_t factor, const Triple& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

ScenePen ScenePen::decimal(int exponent) {
  ScenePen pen(exponent);
  pen.scene_.numbers = NumberMeaning::kDecimal;
  return pen;
}

Number ScenePen::number(std::int64_t value) const {
  const mpz_class mantissa(static_cast<long>(value));
  return scene_.numbers == NumberMeaning::kDecimal ? Number::from_decimal(mantissa, exponent_)
                                                   : Number::from_dyadic(mantissa, exponent_);
}

Position ScenePen::position(const Triple& value) const {
  return {number(value[0]), number(value[1]), number(value[2])};
}

ScenePen& ScenePen::polygon(const std::vector<Triple>& loop) {
  std::vector<Position> positions;
  for (const Triple& vertex : loop) positions.push_back(position(vertex));
  return polygon_at(positions);
}

ScenePen& ScenePen::polygon_at(const std::vector<Position>& loop) {
  Polygon polygon;
  polygon.id = std::to_string(scene_.polygons.size());
  for (const Position& vertex : loop) {
    polygon.loop.push_back(static_cast<VertexId>(scene_.vertices.size()));
    scene_.vertices.push_back(vertex);
  }
  if (two_sided_) polygon.two_sided = true;
  polygon.casts = casts_;
  scene_.polygons.push_back(std::move(polygon));
  return *this;
}

ScenePen& ScenePen::box(const Triple& low, const Triple& high, bool inward) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    for (const bool top : {false, true}) {
      const auto corner = [&](bool at_u, bool at_v) {
        Triple p;
        p[k] = top ? high[k] : low[k];
        p[u] = at_u ? high[u] : low[u];
        p[v] = at_v ? high[v] : low[v];
        return p;
      };
      // u x v = k: counter-clockwise in (u, v) has its front towards +k.
      if (top != inward) {
        polygon(
            {corner(false, false), corner(true, false), corner(true, true), corner(false, true)});
      } else {
        polygon(
            {corner(false, false), corner(false, true), corner(true, true), corner(true, false)});
      }
    }
  }
  return *this;
}

ScenePen& ScenePen::light(LightType type, Position position) {
  Light light;
  light.id = (type == LightType::kPoint ? "lamp" : "sun") + std::to_string(scene_.lights.size());
  light.type = type;
  light.position = std::move(position);
  scene_.lights.push_back(std::move(light));
  return *this;
}

ScenePen& ScenePen::lamp(const Triple& at) { return light(LightType::kPoint, position(at)); }
ScenePen& ScenePen::lamp_at(Position at) { return light(LightType::kPoint, std::move(at)); }
ScenePen& ScenePen::sun(const Triple& to) { return light(LightType::kDirectional, position(to)); }
ScenePen& ScenePen::sun_at(Position to) { return light(LightType::kDirectional, std::move(to)); }
ScenePen& ScenePen::panel(const std::vector<Triple>& loop) {
  Light light;
  light.id = "panel" + std::to_string(scene_.lights.size());
  light.type = LightType::kArea;
  for (const Triple& corner : loop) light.loop.push_back(position(corner));
  scene_.lights.push_back(std::move(light));
  return *this;
}

}  // namespace gnomon::fuzz
