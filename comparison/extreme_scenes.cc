// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/extreme_scenes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "scene/base/random.h"

namespace gnomon::comparison {

namespace {

using Point = std::array<double, 3>;

/// Writes scenes in doubles.
class Draft {
 public:
  Draft() { scene_.two_sided = true; }

  void polygon(const std::vector<Point>& loop) {
    Polygon polygon;
    polygon.id = std::to_string(scene_.polygons.size());
    for (const Point& corner : loop) {
      polygon.loop.push_back(static_cast<VertexId>(scene_.vertices.size()));
      scene_.vertices.push_back(position(corner));
    }
    scene_.polygons.push_back(std::move(polygon));
  }
  /// [x0, x1] x [y0, y1] at height z.
  void plate(double x0, double y0, double x1, double y1, double z) {
    polygon({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}});
  }
  void box(const Point& a, const Point& b) {
    plate(a[0], a[1], b[0], b[1], a[2]);
    plate(a[0], a[1], b[0], b[1], b[2]);
    for (const int k : {0, 1}) {
      for (const Point& side : {a, b}) {
        const auto corner = [&](bool along, bool up) {
          Point p{0, 0, up ? b[2] : a[2]};
          p[k] = side[k];
          p[1 - k] = along ? b[1 - k] : a[1 - k];
          return p;
        };
        polygon(
            {corner(false, false), corner(true, false), corner(true, true), corner(false, true)});
      }
    }
  }
  void lamp(const Point& at) { light(LightType::kPoint, at); }
  void sun(const Point& to) { light(LightType::kDirectional, to); }
  void panel(const std::vector<Point>& loop) {
    Light& light = scene_.lights.emplace_back();
    light.id = "light" + std::to_string(scene_.lights.size());
    light.type = LightType::kArea;
    for (const Point& corner : loop) light.loop.push_back(position(corner));
  }
  Scene take() { return std::move(scene_); }

 private:
  static Position position(const Point& p) { return {Number(p[0]), Number(p[1]), Number(p[2])}; }
  void light(LightType type, const Point& p) {
    Light& light = scene_.lights.emplace_back();
    light.id = "light" + std::to_string(scene_.lights.size());
    light.type = type;
    light.position = position(p);
  }

  Scene scene_;
};

template <class Map>
Scene mapped(Scene scene, const Map& map) {
  const auto change = [&](Position& position) {
    const Point p = map(Point{position[0].nearest(), position[1].nearest(), position[2].nearest()});
    position = {Number(p[0]), Number(p[1]), Number(p[2])};
  };
  for (Position& vertex : scene.vertices) change(vertex);
  for (Light& light : scene.lights) {
    if (light.has_area()) {
      for (Position& corner : light.loop) change(corner);
    } else {
      change(light.position);
    }
  }
  return scene;
}

/// Houses that touch, a roof over two of them, a wall with a slab on it, on a floor 24 wide.
Draft houses() {
  Draft draft;
  draft.plate(-12, -12, 12, 12, 0);
  draft.box({-8, -8, 0}, {-3, -2, 5});
  draft.box({-3, -8, 0}, {2, -3, 7});
  draft.box({4, 1, 0}, {9, 8, 3});
  draft.plate(-9, -9, 3, -1, 8);
  draft.box({-8, 4, 0}, {1, 4.5, 4});
  draft.plate(-8, 3, 1, 7, 4);
  return draft;
}

Draft lit_houses() {
  Draft draft = houses();
  draft.lamp({0.7, -11.3, 13.9});
  draft.sun({0.3, -0.5, 0.8});
  return draft;
}

Scene offset(int k) {
  Scene scene = houses().take();
  const double x = std::ldexp(1, k), y = std::ldexp(0.75, k);
  scene = mapped(std::move(scene), [&](const Point& p) { return Point{p[0] + x, p[1] + y, p[2]}; });
  Draft lights;
  lights.lamp({0.7 + x, -11.3 + y, 13.9});
  lights.sun({0.3, -0.5, 0.8});
  scene.lights = lights.take().lights;
  return scene;
}

Scene scale(int k) {
  Scene scene = lit_houses().take();
  return mapped(std::move(scene), [&](const Point& p) {
    return Point{std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
  });
}

Scene slivers(int k) {
  Draft draft = lit_houses();
  const double width = std::ldexp(1, -k);
  // Along (3, 4), so that it is not parallel to anything.
  for (const double height : {9.5, 11.0}) {
    draft.polygon({{-6, -8, height}, {6, 8, height}, {6 - 4 * width, 8 + 3 * width, height}});
  }
  return draft.take();
}

Scene near_parallel(int k) {
  Draft draft = lit_houses();
  const double rise = std::ldexp(1, -k);
  draft.polygon({{-11, 9, 0}, {11, 9, 0}, {11, 11, 2 * rise}, {-11, 11, 2 * rise}});
  draft.polygon({{-11, -11, 9}, {11, -11, 9}, {11, 11, 9}, {-11, 11, 9}});
  draft.polygon({{-10, -11, 9 - 11 * rise},
                 {10, -11, 9 - 11 * rise},
                 {10, 11, 9 + 11 * rise},
                 {-10, 11, 9 + 11 * rise}});
  return draft.take();
}

Scene far_lamp(int k) {
  Draft draft = houses();
  draft.lamp({std::ldexp(9.3, k), std::ldexp(-15.1, k), std::ldexp(24.7, k)});
  return draft.take();
}

Scene near_lamp(int k) {
  Draft draft = houses();
  const double distance = std::ldexp(24, -k);
  draft.lamp({-0.3, -5.1, 7 + distance});  // over the roof of a house
  draft.lamp({6.5 + distance, 1 - distance, 3});
  return draft.take();
}

Scene low_lamp(int k) {
  Draft draft = houses();
  draft.lamp({0.7, -11.3, std::ldexp(9, -k)});
  return draft.take();
}

Scene grazing_sun(int k) {
  Draft draft = houses();
  draft.sun({0.3, -0.5, std::ldexp(1, -k)});
  draft.sun({std::ldexp(1, -k), -0.5, 0.8});
  return draft.take();
}

Scene gap(int k) {
  Draft draft = lit_houses();
  draft.plate(-11, 9, 11, 11, std::ldexp(1, -k));
  draft.plate(4, 1, 9, 8, 3 + std::ldexp(1, -k));
  return draft.take();
}

/// By the angle of 5, 12, 13, in doubles, so that what was coplanar is so to some digits.
Scene rotated(int k) {
  Scene scene = lit_houses().take();
  for (int i = 0; i < k; ++i) {
    const int u = i % 3, v = (i + 1) % 3;
    scene = mapped(std::move(scene), [&](Point p) {
      const double a = p[u], b = p[v];
      p[u] = (12 * a - 5 * b) / 13;
      p[v] = (5 * a + 12 * b) / 13;
      return p;
    });
  }
  return scene;
}

Scene detail(int k) {
  Draft draft = lit_houses();
  const double size = std::ldexp(1, -k);
  draft.box({5, 2, 3}, {5 + size, 2 + size, 3 + size});
  draft.box({-11, -11, 0}, {-11 + size, -11 + 2 * size, size});
  return draft.take();
}

/// Polygons with one corner among the houses and the others far from them.
Scene mixed(int k) {
  Draft draft = lit_houses();
  const double far = std::ldexp(1, k);
  draft.polygon({{-11, -11, 0}, {19 * far, -11, 0}, {7 * far, 23 * far, 0}});
  draft.polygon({{-9, -9, 9}, {20 * far, 3, 9 + far}, {7 * far, 20 * far, 5}});
  draft.polygon({{5, -10, 0}, {5, -10, 6}, {5 - 2 * far, -10 + 13 * far, 6}});
  return draft.take();
}

Scene tiles(int k) {
  Draft draft = lit_houses();
  const int columns = 1 << ((k + 1) / 2), rows = 1 << (k / 2);
  const double width = 20.0 / columns, depth = 20.0 / rows;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < rows; ++j) {
      // Between neighbours there is an edge, a gap, or nothing in common.
      const double shrink = (i + j) % 3 == 0 ? 0 : 0.0625 * std::min(width, depth);
      draft.plate(-10 + i * width, -10 + j * depth, -10 + (i + 1) * width - shrink,
                  -10 + (j + 1) * depth - shrink, 9);
    }
  }
  return draft.take();
}

Scene nested(int k) {
  Draft draft;
  draft.plate(-12, -12, 12, 12, 0);
  for (int i = 1; i <= k; ++i) {
    const double a = 8.0 * i / k;
    draft.box({-a, -a, 0}, {a, a, a});
  }
  draft.lamp({0.7, -11.3, 13.9});
  draft.sun({0.3, -0.5, 0.8});
  return draft.take();
}

Scene fan(int k) {
  Draft draft;
  draft.plate(-20, -20, 20, 20, 0);
  const int count = 1 << k;
  for (int i = 0; i < count; ++i) {
    const auto at = [&](double turn) {
      const double angle = 2 * std::numbers::pi * (i + turn) / count;
      return Point{1 + 2 * std::cos(angle), 0.5 + 2 * std::sin(angle), 6 + (3 * i % 8 - 4) / 9.0};
    };
    draft.polygon({{1, 0.5, 6}, at(0), at(0.8)});
  }
  draft.sun({0.3, -0.5, 0.8});
  return draft.take();
}

Scene many_lights(int k) {
  Draft draft = houses();
  for (int i = 0; i < k; ++i) {
    const double angle = 2 * std::numbers::pi * i / k;
    draft.lamp({10.3 * std::cos(angle), 10.3 * std::sin(angle), 13.9});
  }
  return draft.take();
}

/// Coordinates of so many random bits, as exact numbers where they are no doubles.
Scene bits(int k) {
  Scene scene;
  scene.numbers = NumberMeaning::kDecimal;
  scene.two_sided = true;
  Random random(static_cast<std::uint64_t>(k));
  const auto coordinate = [&](int low, int high) {
    mpz_class mantissa = 0;
    for (int i = 0; i < k; i += 32) {
      mantissa = (mantissa << 32) + mpz_class(static_cast<unsigned long>(random.next() >> 32));
    }
    mpz_class range = mpz_class(high - low) << k, value;
    mpz_fdiv_q_2exp(value.get_mpz_t(), mpz_class(mantissa * range).get_mpz_t(),
                    static_cast<mp_bitcnt_t>((k + 31) / 32 * 32));
    return Number::from_dyadic(value + (mpz_class(low) << k), -k);
  };
  const auto point = [&](int low, int high) {
    return Position{coordinate(-8, 8), coordinate(-8, 8), coordinate(low, high)};
  };
  for (int i = 0; i < 24; ++i) {
    Polygon polygon;
    polygon.id = std::to_string(i);
    for (int j = 0; j < 3; ++j) {
      polygon.loop.push_back(static_cast<VertexId>(scene.vertices.size()));
      scene.vertices.push_back(point(0, 4));
    }
    scene.polygons.push_back(std::move(polygon));
  }
  Light& lamp = scene.lights.emplace_back();
  lamp.id = "lamp";
  lamp.position = point(9, 12);
  return scene;
}

Scene area_light(int k) {
  Draft draft = houses();
  const double size = std::ldexp(1, k), z = 13.9;  // at 0, where doubles have room for it
  draft.panel({{0, 0, z}, {0, size, z}, {size, size, z}, {size, 0, z}});
  return draft.take();
}

constexpr std::array<ExtremeAxis, 19> kAxes = {{
    {"offset", "the scene, 24 wide, away from the origin by", "2^k", 0, 60, 3, offset},
    {"scale-up", "every length times", "2^k", 0, 1000, 50, scale},
    {"scale-down", "every length times", "2^-k", 0, 1000, 50, [](int k) { return scale(-k); }},
    {"slivers", "triangles 20 long and wide", "5 * 2^-k", 0, 50, 3, slivers},
    {"near-parallel", "planes that cross at an angle of", "2^-k", 0, 60, 3, near_parallel},
    {"far-lamp", "a lamp away by", "30 * 2^k", 0, 1000, 50, far_lamp},
    {"near-lamp", "lamps away from a roof and an edge by", "24 * 2^-k", 0, 50, 3, near_lamp},
    {"low-lamp", "a lamp over the floor's plane by", "9 * 2^-k", 0, 60, 3, low_lamp},
    {"grazing-sun", "a sun over the plane of floor and walls by", "2^-k", 0, 60, 3, grazing_sun},
    {"gap", "a plate over floor and roof by", "2^-k", 0, 60, 3, gap},
    {"rotation", "turns of the scene, in doubles", "k", 0, 12, 1, rotated, false},
    {"detail", "boxes of a size of", "2^-k", 0, 48, 3, detail},
    {"mixed", "polygons from 20 wide among the houses to", "20 * 2^k", 0, 60, 3, mixed},
    {"tiles", "plates of one plane, as many as", "2^k", 0, 11, 1, tiles},
    {"nested", "boxes in each other, as many as", "k", 1, 24, 2, nested},
    {"fan", "triangles that meet in one point, as many as", "2^k", 1, 9, 1, fan},
    {"lights", "lamps", "k", 1, 33, 8, many_lights},
    {"bits", "bits of a coordinate behind the point", "k", 1, 1000, 111, bits, false},
    {"area-light", "an area light of a size of", "2^k", -60, 20, 5, area_light, false},
}};

}  // namespace

std::span<const ExtremeAxis> extreme_axes() { return kAxes; }

const ExtremeAxis* axis_by_name(std::string_view name) {
  const auto* const found = std::ranges::find(kAxes, name, &ExtremeAxis::name);
  return found == kAxes.end() ? nullptr : found;
}

Scene extreme_scene(const ExtremeAxis& axis, int step, bool sheared) {
  Scene scene = axis.make(step);
  scene.name = extreme_name(axis, step, sheared);
  if (sheared && axis.shears) shear(scene);
  return scene;
}

void shear(Scene& scene) {
  const auto move = [](Position& p) {
    const double x = p[0].nearest(), y = p[1].nearest(), z = p[2].nearest();
    p = {Number(x + z / 8), Number(y + x / 4), Number(z + y / 16)};
  };
  for (Position& vertex : scene.vertices) move(vertex);
  for (Light& light : scene.lights) {
    if (!light.has_area()) move(light.position);
    for (Position& corner : light.loop) move(corner);
  }
}

std::string extreme_name(const ExtremeAxis& axis, int step, bool sheared) {
  return std::string(kExtremePrefix) + std::string(axis.name) + ':' + std::to_string(step) +
         (sheared ? ":sheared" : "");
}

Expected<Scene> extreme_by_name(std::string_view name) {
  const auto wrong = [&] {
    return fail(ErrorCode::kUsage, "'" + std::string(name) + "': no such scene",
                "extreme:AXIS:STEP or extreme:AXIS:STEP:sheared, of 'gnomon extremes --list'");
  };
  std::string_view rest = name.substr(std::min(name.size(), kExtremePrefix.size()));
  const std::string_view axis_name = rest.substr(0, rest.find(':'));
  const ExtremeAxis* const axis = axis_by_name(axis_name);
  if (axis == nullptr || axis_name.size() == rest.size()) return wrong();
  rest.remove_prefix(axis_name.size() + 1);
  const std::string_view digits = rest.substr(0, rest.find(':'));
  rest.remove_prefix(digits.size());
  int step = 0;
  const auto [stop, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), step);
  if (failure != std::errc() || stop != digits.data() + digits.size() || step < axis->first ||
      step > axis->last || !(rest.empty() || rest == ":sheared")) {
    return wrong();
  }
  return extreme_scene(*axis, step, !rest.empty());
}

}  // namespace gnomon::comparison
