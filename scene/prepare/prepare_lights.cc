// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/prepare/prepare_lights.h"

#include <fmt/format.h>

#include <cmath>

#include "gnomon/scene/rational_text.h"
#include "scene/geometry/loop_geometry.h"

namespace gnomon::scene_detail {
namespace {

using Point = Vec3<mpz_class>;

class LightMaker {
 public:
  LightMaker(const Scene& scene, const ExactGrid& grid, PreparedScene& out)
      : scene_(scene), grid_(grid), out_(out) {}

  std::optional<Error> add_directional(std::uint32_t index) {
    const Light& light = scene_.lights[index];
    PreparedLight result = begun(index);
    result.point.directional = true;
    result.point.nearest = nearest(light.position);
    result.point.grid = primitive_direction(light.position);
    unsigned bits = 0;
    for (const mpz_class& c : result.point.grid) {
      if (c != 0) bits = std::max(bits, static_cast<unsigned>(mpz_sizeinbase(c.get_mpz_t(), 2)));
    }
    if (bits == 0) return error_at(index, "to_light", "to_light is the zero vector", "a direction");
    out_.direction_bits = std::max(out_.direction_bits, bits);
    out_.lights.push_back(std::move(result));
    return std::nullopt;
  }

  void add_point(std::uint32_t index, std::size_t grid_point) {
    const Light& light = scene_.lights[index];
    PreparedLight result = begun(index);
    result.point.nearest = nearest(light.position);
    result.point.grid = at(grid_point);
    result.is_eye = light.is_eye;
    out_.lights.push_back(std::move(result));
  }

  std::optional<Error> add_area(std::uint32_t index, std::size_t first) {
    const Light& light = scene_.lights[index];
    std::vector<std::size_t> kept;  // indices into light.loop
    std::vector<Point> loop;
    for (std::size_t i = 0; i < light.loop.size(); ++i) {
      const auto p = at(first + i);
      kept.push_back(i);
      loop.push_back({p[0], p[1], p[2]});
    }
    drop_needless(kept, loop);
    if (loop.size() < 3) {
      return error_at(index, "loop", "the area light's vertices lie on one line",
                      "a convex planar polygon of positive area");
    }
    const Point area = area_vector(loop);
    if (area.is_zero()) {
      return error_at(index, "loop", "the area light's loop crosses itself",
                      "a convex planar polygon of positive area");
    }
    if (!lies_in_plane(loop, loop[0], area)) return not_planar(index, kept, loop);
    if (!is_convex(loop, area)) {
      return error_at(index, "loop", "the area light is not convex",
                      "a convex planar polygon; cut it into convex lights");
    }
    if (kept.size() != light.loop.size()) {
      const std::size_t dropped = light.loop.size() - kept.size();
      out_.light_notes.push_back({index, fmt::format("{} repeated or collinear {} dropped", dropped,
                                                     dropped == 1 ? "vertex" : "vertices")});
    }
    PreparedLight result = begun(index);
    for (Point& p : loop)
      result.area_loop.push_back({std::move(p.x), std::move(p.y), std::move(p.z)});
    out_.lights.push_back(std::move(result));
    return std::nullopt;
  }

 private:
  PreparedLight begun(std::uint32_t index) const {
    PreparedLight light;
    light.light = index;
    light.type = scene_.lights[index].type;
    return light;
  }
  static std::array<double, 3> nearest(const Position& p) {
    return {p[0].nearest(), p[1].nearest(), p[2].nearest()};
  }
  std::array<mpz_class, 3> at(std::size_t p) const {
    return {grid_.at(p, 0), grid_.at(p, 1), grid_.at(p, 2)};
  }

  Error error_at(std::uint32_t index, const char* member, const std::string& what,
                 std::string expected) const {
    Error error;
    error.code = ErrorCode::kGeometry;
    error.where.file = scene_.file;
    error.where.pointer = fmt::format("/lights/{}/{}", index, member);
    error.what = fmt::format("light '{}': {}", scene_.lights[index].id, what);
    error.expected = std::move(expected);
    return error;
  }

  /// Says how far the worst vertex is from the plane of the first three, and where it would lie in
  /// it.
  Error not_planar(std::uint32_t index, const std::vector<std::size_t>& kept,
                   const std::vector<Point>& loop) const {
    const Point normal = cross(loop[1] - loop[0], loop[2] - loop[0]);
    std::size_t worst = 0;
    mpz_class worst_value = 0;
    for (std::size_t i = 3; i < loop.size(); ++i) {
      const mpz_class value = dot(normal, loop[i] - loop[0]);
      if (abs(value) > abs(worst_value)) {
        worst = i;
        worst_value = value;
      }
    }
    mpq_class square(worst_value * worst_value, dot(normal, normal));
    square.canonicalize();
    square *= out_.geometry.step * out_.geometry.step;
    const int axis = projection_axis(normal);
    const auto k = static_cast<std::size_t>(axis);
    // Along the axis the plane is reached at loop[worst] - value / normal[axis].
    mpq_class move(worst_value, normal[axis]);
    move.canonicalize();
    const mpq_class target =
        out_.geometry.origin[k] + out_.geometry.step * (mpq_class(loop[worst][axis]) - move);
    return error_at(
        index, "loop",
        fmt::format(
            "the area light is not exactly planar: vertex {} is {:.3g} scene units off the plane "
            "of its first three",
            kept[worst], std::sqrt(square.get_d())),
        fmt::format("an exactly planar polygon; setting {} of vertex {} to {} flattens it, or give "
                    "the light "
                    "as triangles",
                    "xyz"[axis], kept[worst], text_for_people(target)));
  }

  const Scene& scene_;
  const ExactGrid& grid_;
  PreparedScene& out_;
};

}  // namespace

// Lights have few vertices, so simply start over.
void drop_needless(std::vector<std::size_t>& kept, std::vector<Point>& loop) {
  for (std::size_t i = 0; loop.size() >= 3 && i < loop.size();) {
    const std::size_t n = loop.size();
    const Point& p = loop[(i + n - 1) % n];
    const Point& q = loop[(i + 1) % n];
    if (!cross(loop[i] - p, q - loop[i]).is_zero()) {
      ++i;
      continue;
    }
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
}

std::optional<Error> prepare_lights(const Scene& scene, const ExactGrid& grid, std::size_t first,
                                    PreparedScene& out) {
  LightMaker maker(scene, grid, out);
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    std::optional<Error> error;
    switch (scene.lights[i].type) {
      case LightType::kPoint:
        maker.add_point(i, first++);
        break;
      case LightType::kDirectional:
        error = maker.add_directional(i);
        break;
      case LightType::kArea:
        error = maker.add_area(i, first);
        first += scene.lights[i].loop.size();
        break;
    }
    if (error) return error;
  }
  return std::nullopt;
}

}  // namespace gnomon::scene_detail
