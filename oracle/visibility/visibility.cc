// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/visibility.h"

#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "oracle/geometry/space_loop.h"

namespace gnomon::oracle {

namespace {

using space::cross;
using space::dot;
using space::minus;

using Vector = RationalPoint;

enum class Place { kOutside, kBoundary, kInside };

}  // namespace

struct VisibilityTest::Data {
  struct Caster {
    std::vector<Vector> loop;    // scene units
    Vector normal;               // of the first corner, from the loop's front
    std::vector<Vector> inward;  // per edge: in the plane, towards the inside
    bool two_sided = false, may_cast = false;
  };
  /// What is not of the light.
  struct Parts {
    const Geometry* geometry = nullptr;
    std::array<mpq_class, 3> origin;
    mpq_class step;
    std::vector<Caster> parts;
    std::vector<std::uint32_t> all;
  };
  struct State {
    bool casts = false, receives = false;
  };

  std::shared_ptr<const Parts> scene;
  bool directional = false;
  Vector light;
  std::vector<State> states;  // of parts
  /// Of the light's region: what is in front is outside.
  struct Outside {
    Vector base, normal;
    bool holds(const Caster& polygon) const {
      for (const Vector& vertex : polygon.loop) {
        if (dot(normal, minus(vertex, base)) != 0) return false;
      }
      return true;
    }
  };
  std::vector<Outside> outsides;

  Data(std::shared_ptr<const Parts> parts, const PreparedLight& prepared_light);

  static Place place(const Caster& caster, const Vector& point) {
    Place result = Place::kInside;
    for (std::size_t i = 0; i < caster.loop.size(); ++i) {
      const mpq_class side = dot(caster.inward[i], minus(point, caster.loop[i]));
      if (side < 0) return Place::kOutside;
      if (side == 0) result = Place::kBoundary;
    }
    return result;
  }
};

namespace {

Vector in_scene(const RationalPoint& origin, const mpq_class& step,
                const std::array<mpz_class, 3>& grid) {
  Vector result;
  for (int k = 0; k < 3; ++k) result[k] = origin[k] + step * grid[k];
  return result;
}

}  // namespace

VisibilityTest::Data::Data(std::shared_ptr<const Parts> parts, const PreparedLight& prepared_light)
    : scene(std::move(parts)), directional(prepared_light.point.directional) {
  if (directional) {
    for (int k = 0; k < 3; ++k) light[k] = prepared_light.point.grid[k];
  } else {
    light = in_scene(scene->origin, scene->step, prepared_light.point.grid);
  }
  for (const Caster& caster : scene->parts) {
    const mpq_class height =
        directional ? dot(caster.normal, light) : dot(caster.normal, minus(light, caster.loop[0]));
    State& state = states.emplace_back();
    state.receives = height > 0 || (height < 0 && caster.two_sided);
    state.casts = state.receives && (caster.may_cast || prepared_light.is_eye);
  }
  for (const PlaneRef plane : prepared_light.region) {
    const SupportTriple& triple = scene->geometry->planes[plane.index()];
    std::array<Vector, 3> corners;
    const std::array<VertexId, 3> vertices{triple.a, triple.b, triple.c};
    for (std::size_t i = 0; i < 3; ++i) {
      const GridPositions& grid = scene->geometry->grid;
      corners[i] =
          in_scene(scene->origin, scene->step,
                   {grid.at(vertices[i], 0), grid.at(vertices[i], 1), grid.at(vertices[i], 2)});
    }
    if (!plane.flipped()) std::swap(corners[1], corners[2]);
    outsides.push_back(
        {corners[0], cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]))});
  }
}

VisibilityTest::VisibilityTest(const PreparedScene& scene, const PreparedLight& light) {
  const Geometry& geometry = scene.geometry;
  auto parts = std::make_shared<Data::Parts>();
  parts->geometry = &geometry;
  parts->origin = geometry.origin;
  parts->step = geometry.step;
  for (const Part& part : scene.parts) {
    Data::Caster caster;
    for (VertexId vertex : scene.loop(part)) {
      caster.loop.push_back(in_scene(
          geometry.origin, geometry.step,
          {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1), geometry.grid.at(vertex, 2)}));
    }
    const std::size_t size = caster.loop.size();
    caster.normal =
        cross(minus(caster.loop[1], caster.loop[0]), minus(caster.loop[2], caster.loop[0]));
    for (std::size_t i = 0; i < size; ++i) {
      caster.inward.push_back(
          cross(caster.normal, minus(caster.loop[(i + 1) % size], caster.loop[i])));
    }
    caster.two_sided = part.two_sided;
    caster.may_cast = part.casts;
    parts->parts.push_back(std::move(caster));
  }
  parts->all.resize(parts->parts.size());
  std::iota(parts->all.begin(), parts->all.end(), 0u);
  data_ = std::make_unique<Data>(std::move(parts), light);
}

VisibilityTest::VisibilityTest(const VisibilityTest& other, const PreparedLight& light)
    : data_(std::make_unique<Data>(other.data_->scene, light)) {}

VisibilityTest::~VisibilityTest() = default;
VisibilityTest::VisibilityTest(VisibilityTest&&) noexcept = default;

PointVisibility VisibilityTest::at(std::uint32_t receiver, const RationalPoint& point) const {
  return at(receiver, point, data_->scene->all);
}

PointVisibility VisibilityTest::at(std::uint32_t receiver, const RationalPoint& point,
                                   std::span<const std::uint32_t> casters) const {
  PointVisibility result;
  const Data::Caster& own = data_->scene->parts[receiver];
  if (!data_->states[receiver].receives) {
    result.visibility = Visibility::kShadow;
    return result;
  }
  for (const Data::Outside& outside : data_->outsides) {
    const mpq_class height = dot(outside.normal, minus(point, outside.base));
    if (height > 0) return {Visibility::kShadow, std::nullopt};
    if (height == 0 && !outside.holds(own)) result.visibility = Visibility::kBoundary;
  }
  const Vector to_light = data_->directional ? data_->light : minus(data_->light, point);
  for (const std::uint32_t i : casters) {
    const Data::Caster& caster = data_->scene->parts[i];
    if (i == receiver || !data_->states[i].casts) continue;
    // point + t to_light meets the plane where height + t rise = 0.
    const mpq_class height = dot(caster.normal, minus(point, caster.loop[0]));
    const mpq_class rise = dot(caster.normal, to_light);  // not 0 unless the point is in the plane
    if (height == 0) {
      // The segment starts in the caster's plane and leaves it at once, so it does not meet the
      // caster; but next to this point it may. Not so if the two are coplanar.
      bool coplanar = true;
      for (const Vector& vertex : own.loop) {
        coplanar = coplanar && dot(caster.normal, minus(vertex, caster.loop[0])) == 0;
      }
      if (coplanar || Data::place(caster, point) == Place::kOutside) continue;
      result = {Visibility::kBoundary, i};
      continue;
    }
    if (rise == 0) continue;
    const mpq_class t = -height / rise;
    if (t <= 0 || (!data_->directional && t >= 1)) continue;
    Vector meeting;
    for (int k = 0; k < 3; ++k) meeting[k] = point[k] + t * to_light[k];
    switch (Data::place(caster, meeting)) {
      case Place::kInside:
        return {Visibility::kShadow, i};
      case Place::kBoundary:
        result = {Visibility::kBoundary, i};
        break;
      case Place::kOutside:
        break;
    }
  }
  return result;
}

}  // namespace gnomon::oracle
