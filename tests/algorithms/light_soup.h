// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes by hand with an area light, and what points of their sides see of it by brute force: every
// caster and the definition, in rationals, for one point of the light at a time.
#ifndef GNOMON_TESTS_ALGORITHMS_LIGHT_SOUP_H
#define GNOMON_TESTS_ALGORITHMS_LIGHT_SOUP_H

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "scene/base/random.h"

namespace gnomon::test {

using ExactPoint3 = std::array<mpq_class, 3>;
using Triple = std::array<double, 3>;

inline ExactPoint3 minus(const ExactPoint3& a, const ExactPoint3& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
inline ExactPoint3 cross_of(const ExactPoint3& a, const ExactPoint3& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}
inline mpq_class dot_of(const ExactPoint3& a, const ExactPoint3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline ExactPoint3 exactly(const Triple& p) {
  return {mpq_class(p[0]), mpq_class(p[1]), mpq_class(p[2])};
}

class LightSceneBuilder {
 public:
  LightSceneBuilder& polygon(const std::vector<Triple>& loop, bool two_sided = false) {
    Polygon polygon;
    polygon.id = "p" + std::to_string(scene_.polygons.size());
    polygon.two_sided = two_sided;
    for (const Triple& p : loop) {
      polygon.loop.push_back(static_cast<VertexId>(scene_.vertices.size()));
      scene_.vertices.push_back(position(p));
    }
    scene_.polygons.push_back(polygon);
    return *this;
  }
  LightSceneBuilder& area(const std::vector<Triple>& loop) {
    Light light;
    light.id = "l" + std::to_string(scene_.lights.size());
    light.type = LightType::kArea;
    for (const Triple& p : loop) light.loop.push_back(position(p));
    scene_.lights.push_back(light);
    return *this;
  }
  LightSceneBuilder& light(LightType type, const Triple& p) {
    Light light;
    light.id = "l" + std::to_string(scene_.lights.size());
    light.type = type;
    light.position = position(p);
    scene_.lights.push_back(light);
    return *this;
  }
  PreparedScene build() const {
    auto prepared = prepare(scene_);
    if (!prepared) throw std::runtime_error(to_string(prepared.error()));
    return *std::move(prepared);
  }

 private:
  static Position position(const Triple& p) { return {Number(p[0]), Number(p[1]), Number(p[2])}; }
  Scene scene_;
};

/// Of the scene's first light, an area light. Scene units.
struct BruteView {
  struct Face {
    std::vector<ExactPoint3> loop;
    ExactPoint3 normal;
    bool two_sided, casts;
  };
  explicit BruteView(const PreparedScene& scene) {
    const Geometry& g = scene.geometry;
    const auto at = [&](const std::array<mpz_class, 3>& p) {
      ExactPoint3 result;
      for (std::size_t k = 0; k < 3; ++k) result[k] = g.origin[k] + g.step * p[k];
      return result;
    };
    for (const Part& part : scene.parts) {
      Face face{{}, {}, part.two_sided, part.casts};
      for (const VertexId v : scene.loop(part)) {
        face.loop.push_back(at({g.grid.at(v, 0), g.grid.at(v, 1), g.grid.at(v, 2)}));
      }
      face.normal = cross_of(minus(face.loop[1], face.loop[0]), minus(face.loop[2], face.loop[0]));
      faces.push_back(std::move(face));
    }
    for (const auto& p : scene.lights[0].area_loop) light.push_back(at(p));
    if (!light.empty()) {
      light_normal = cross_of(minus(light[1], light[0]), minus(light[2], light[0]));
    }
  }
  static int height(const ExactPoint3& normal, const ExactPoint3& base, const ExactPoint3& p) {
    return sgn(dot_of(normal, minus(p, base)));
  }
  /// 1: inside, 0: on the border, -1: outside. Of a point of the plane.
  static int place(const std::vector<ExactPoint3>& loop, const ExactPoint3& normal,
                   const ExactPoint3& p) {
    int result = 1;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const ExactPoint3& a = loop[i];
      const ExactPoint3& b = loop[(i + 1) % loop.size()];
      result = std::min(result, sgn(dot_of(cross_of(normal, minus(b, a)), minus(p, a))));
    }
    return result;
  }
  /// 1: visible, -1: hidden, 0: on a border.
  int sees(std::uint32_t part, Side side, const ExactPoint3& p, const ExactPoint3& a) const {
    const int own = static_cast<int>(side) * height(faces[part].normal, p, a);
    if (own <= 0) return own;
    if (height(light_normal, light[0], p) <= 0) return -1;
    int result = 1;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
      const Face& face = faces[i];
      if (!face.casts) continue;
      const mpq_class at_p = dot_of(face.normal, minus(p, face.loop[0]));
      const mpq_class at_a = dot_of(face.normal, minus(a, face.loop[0]));
      if (sgn(at_p) * sgn(at_a) >= 0) continue;
      if (sgn(at_a) < 0 && !face.two_sided) continue;
      const mpq_class t = at_p / (at_p - at_a);
      ExactPoint3 meet;
      for (std::size_t k = 0; k < 3; ++k) meet[k] = p[k] + t * (a[k] - p[k]);
      const int where = place(face.loop, face.normal, meet);
      if (where > 0) return -1;
      if (where == 0) result = 0;
    }
    return result;
  }
  std::vector<Face> faces;
  std::vector<ExactPoint3> light;
  ExactPoint3 light_normal;
};

inline ExactPoint3 mix(const std::vector<ExactPoint3>& loop, Random& random, int steps) {
  ExactPoint3 sum;
  mpq_class total;
  for (const ExactPoint3& p : loop) {
    const mpq_class weight(static_cast<long>(random.below(static_cast<std::uint64_t>(steps))));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weight * p[k];
    total += weight;
  }
  if (sgn(total) == 0) return loop[0];
  for (mpq_class& c : sum) c /= total;
  return sum;
}

/// Random triangles and parallelograms on a lattice with a light among them.
inline PreparedScene soup(Random& random, int polygons, int size, double scale = 1,
                          LightType type = LightType::kArea) {
  LightSceneBuilder builder;
  const auto triple = [&] {
    return Triple{scale * static_cast<double>(random.between(0, size)),
                  scale * static_cast<double>(random.between(0, size)),
                  scale * static_cast<double>(random.between(0, size))};
  };
  const auto loop = [&]() -> std::vector<Triple> {
    for (;;) {
      const Triple a = triple(), b = triple(), c = triple();
      const ExactPoint3 n = cross_of(minus(exactly(b), exactly(a)), minus(exactly(c), exactly(a)));
      if (sgn(n[0]) == 0 && sgn(n[1]) == 0 && sgn(n[2]) == 0) continue;
      if (random.chance(1, 2)) return {a, b, c};
      return {a, b, {b[0] + c[0] - a[0], b[1] + c[1] - a[1], b[2] + c[2] - a[2]}, c};
    }
  };
  switch (type) {
    case LightType::kArea:
      builder.area(loop());
      break;
    case LightType::kPoint:
      builder.light(type, triple());
      break;
    case LightType::kDirectional: {
      Triple to_light = triple();
      to_light[random.below(3)] -= scale * (size + 1);
      builder.light(type, to_light);
      break;
    }
  }
  for (int i = 0; i < polygons; ++i) builder.polygon(loop(), random.chance(1, 2));
  return builder.build();
}

/// Closed tetrahedra, faces outwards, on a lattice under a light that looks down, over a floor:
/// casters that share edges and corners.
inline PreparedScene solids(Random& random, int count, int size) {
  LightSceneBuilder builder;
  const double s = size;
  builder.polygon({{-s, -s, 0}, {2 * s, -s, 0}, {2 * s, 2 * s, 0}, {-s, 2 * s, 0}});
  builder.area({{0, 0, 2 * s}, {0, s, 2 * s}, {s, s, 2 * s}, {s, 0, 2 * s}});
  for (int made = 0; made < count;) {
    std::array<Triple, 4> v;
    for (Triple& p : v) {
      for (double& c : p) c = static_cast<double>(random.between(0, size));
    }
    const auto volume = [](const Triple& a, const Triple& b, const Triple& c, const Triple& d) {
      const ExactPoint3 base = exactly(a);
      return sgn(dot_of(cross_of(minus(exactly(b), base), minus(exactly(c), base)),
                        minus(exactly(d), base)));
    };
    const int sign = volume(v[0], v[1], v[2], v[3]);
    if (sign == 0) continue;
    if (sign < 0) std::swap(v[0], v[1]);
    // The fourth is in front of the other three: that face turns round to look outwards.
    builder.polygon({v[0], v[2], v[1]});
    builder.polygon({v[0], v[1], v[3]});
    builder.polygon({v[1], v[2], v[3]});
    builder.polygon({v[2], v[0], v[3]});
    ++made;
  }
  return builder.build();
}

/// The same of boxes on a lattice whose faces are cut into rectangles, so that these meet in
/// T-junctions at the boxes' edges and on their faces. Boxes may touch and cross each other.
inline PreparedScene divided_boxes(Random& random, int count, int size) {
  LightSceneBuilder builder;
  const double s = size;
  builder.polygon({{-s, -s, 0}, {2 * s, -s, 0}, {2 * s, 2 * s, 0}, {-s, 2 * s, 0}});
  builder.area({{0, 0, 2 * s}, {0, s, 2 * s}, {s, s, 2 * s}, {s, 0, 2 * s}});
  for (int made = 0; made < count; ++made) {
    Triple low, high;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = random.between(0, size - 1);
      low[k] = static_cast<double>(a);
      high[k] = static_cast<double>(random.between(a + 1, size));
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (const bool at_high : {false, true}) {
        struct Rectangle {
          Triple low, high;
        };
        std::vector<Rectangle> rectangles{{low, high}};
        for (std::int64_t cuts = random.between(0, 2); cuts > 0; --cuts) {
          const std::size_t which = random.below(rectangles.size());
          const std::size_t along = random.chance(1, 2) ? u : v;
          Rectangle second = rectangles[which];
          const double middle = second.low[along] + (second.high[along] - second.low[along]) / 2;
          rectangles[which].high[along] = second.low[along] = middle;
          rectangles.push_back(second);
        }
        for (const Rectangle& r : rectangles) {
          const double level = at_high ? high[axis] : low[axis];
          const auto corner = [&](double x, double y) {
            Triple p;
            p[axis] = level;
            p[u] = x;
            p[v] = y;
            return p;
          };
          std::vector<Triple> loop{corner(r.low[u], r.low[v]), corner(r.high[u], r.low[v]),
                                   corner(r.high[u], r.high[v]), corner(r.low[u], r.high[v])};
          if (!at_high) std::reverse(loop.begin(), loop.end());
          builder.polygon(loop);
        }
      }
    }
  }
  return builder.build();
}

}  // namespace gnomon::test

#endif  // GNOMON_TESTS_ALGORITHMS_LIGHT_SOUP_H
