// SPDX-License-Identifier: LGPL-3.0-or-later
// Cones and flaps of the command line, as planes of lights by three points each.
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "gnomon/scene/light_arguments.h"
#include "scene/base/text_file.h"
#include "scene/base/vectors.h"
#include "scene/files/argument_parts.h"

namespace gnomon {

namespace {

using Vector = std::array<mpq_class, 3>;

Vector from_to(const Position& from, const Position& to) {
  Vector result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = to[k].exact() - from[k].exact();
  return result;
}

int turn_of(const Vector& a, const Vector& b, const Vector& c) { return sgn(dot(a, cross(b, c))); }

Expected<std::vector<Position>> parse_cone(const std::string& text, NumberMeaning meaning) {
  const auto count = std::count(text.begin(), text.end(), ':') + 1;
  if (count < 3) {
    return fail(ErrorCode::kUsage, "--cone: fewer than three points", "x,y,z:x,y,z:x,y,z");
  }
  std::vector<Position> points;
  std::string_view rest = text;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    auto point = parse_position(take_until(rest, ':'), meaning, "--cone");
    if (!point) return tl::unexpected(std::move(point.error()));
    points.push_back(*std::move(point));
  }
  return points;
}

/// The planes through a point light and the edges of a polygon, turned to its inside.
Expected<void> add_cone(Light& light, const std::vector<Position>& polygon) {
  std::vector<Vector> rays;
  for (const Position& point : polygon) rays.push_back(from_to(light.position, point));
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = i + 1 < polygon.size() ? i + 1 : 0;
    bool left = false, right = false;
    for (const Vector& ray : rays) {
      const int turn = turn_of(rays[i], rays[next], ray);
      left = left || turn > 0;
      right = right || turn < 0;
    }
    if (left == right) {
      return fail(ErrorCode::kGeometry,
                  "--cone: seen from light '" + light.id + "' it is " +
                      (left ? "not convex" : "no polygon, its points lie in a plane with it"),
                  "the corners of a convex polygon, in their order");
    }
    light.region.push_back({light.position, polygon[left ? i : next], polygon[left ? next : i]});
  }
  return {};
}

/// Two different coordinates of the scene along an axis, in order, so that a plane needs no finer
/// or larger grid than the scene does.
std::pair<Number, Number> extent_along(const Scene& scene, std::size_t axis) {
  Number low, high;
  for (std::size_t i = 0; i < scene.vertices.size(); ++i) {
    const Number& own = scene.vertices[i][axis];
    if (i == 0 || own.nearest() < low.nearest()) low = own;
    if (i == 0 || own.nearest() > high.nearest()) high = own;
  }
  if (low.nearest() < high.nearest()) return {low, high};
  const Number other = low.is_zero() ? Number(1.0) : Number(0.0);
  return low.nearest() < other.nearest() ? std::pair(low, other) : std::pair(other, low);
}

RegionPlane plane_across(const Scene& scene, std::size_t axis, const Number& at, bool above) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto [u_low, u_high] = extent_along(scene, u);
  const auto [v_low, v_high] = extent_along(scene, v);
  Position corner, along_u, along_v;
  corner[axis] = along_u[axis] = along_v[axis] = at;
  corner[u] = along_v[u] = u_low;
  corner[v] = along_u[v] = v_low;
  along_u[u] = u_high;
  along_v[v] = v_high;
  return above ? RegionPlane{corner, along_u, along_v} : RegionPlane{corner, along_v, along_u};
}

/// The planes of "z:0:3"; either number may be missing.
Expected<std::vector<RegionPlane>> parse_flap(const Scene& scene, const std::string& text) {
  const auto wrong = [&] {
    return fail(ErrorCode::kUsage, "--flap: " + quoted_text(text) + " is no slab",
                "x, y or z, and two heights, one of which may be missing: z:0:3");
  };
  std::string_view rest = text;
  const std::string_view name = trimmed(take_until(rest, ':'));
  const std::size_t axis = std::string_view("xyz").find(name);
  if (name.size() != 1 || axis == std::string_view::npos ||
      std::count(text.begin(), text.end(), ':') != 2) {
    return wrong();
  }
  std::vector<RegionPlane> planes;
  std::array<mpq_class, 2> heights;
  for (const bool above : {true, false}) {
    const std::string_view part = trimmed(take_until(rest, ':'));
    if (part.empty()) continue;
    auto height = Number::parse(part, scene.numbers);
    if (!height) {
      height.error().what = "--flap: " + height.error().what;
      return tl::unexpected(std::move(height.error()));
    }
    heights[above ? 0 : 1] = height->exact();
    planes.push_back(plane_across(scene, axis, *height, above));
  }
  if (planes.empty()) return wrong();
  if (planes.size() == 2 && heights[0] >= heights[1]) {
    return fail(ErrorCode::kUsage, "--flap: " + quoted_text(text) + " is upside down",
                "the lower height first");
  }
  return planes;
}

}  // namespace

Expected<void> add_regions(Scene& scene, const RegionArguments& arguments) {
  if (arguments.none()) return {};
  std::vector<std::vector<Position>> cones;
  for (const std::string& text : arguments.cones) {
    auto cone = parse_cone(text, scene.numbers);
    if (!cone) return tl::unexpected(std::move(cone.error()));
    cones.push_back(*std::move(cone));
  }
  std::vector<RegionPlane> planes;
  for (const std::string& text : arguments.flaps) {
    auto flap = parse_flap(scene, text);
    if (!flap) return tl::unexpected(std::move(flap.error()));
    planes.insert(planes.end(), flap->begin(), flap->end());
  }
  bool points = false, some = false;
  for (Light& light : scene.lights) {
    if (light.has_area()) continue;
    some = true;
    light.region.insert(light.region.end(), planes.begin(), planes.end());
    if (!light.is_point()) continue;
    points = true;
    for (const std::vector<Position>& cone : cones) {
      if (auto added = add_cone(light, cone); !added) return added;
    }
  }
  if (!cones.empty() && !points) {
    return fail(ErrorCode::kUsage, "--cone: there is no point light", "one, or --flap");
  }
  if (some) return {};
  return fail(ErrorCode::kUsage, "--flap: there is no point or directional light",
              "at least one of them");
}

}  // namespace gnomon
