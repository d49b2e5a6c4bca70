// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/visibility.h"

#include <array>
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
    bool casts = false;
    bool receives = false;
  };

  bool directional = false;
  Vector light;
  std::vector<Caster> parts;

  Place place(const Caster& caster, const Vector& point) const {
    Place result = Place::kInside;
    for (std::size_t i = 0; i < caster.loop.size(); ++i) {
      const mpq_class side = dot(caster.inward[i], minus(point, caster.loop[i]));
      if (side < 0) return Place::kOutside;
      if (side == 0) result = Place::kBoundary;
    }
    return result;
  }
};

VisibilityTest::VisibilityTest(const PreparedScene& scene, const PreparedLight& light)
    : data_(std::make_unique<Data>()) {
  const Geometry& geometry = scene.geometry;
  const auto in_scene = [&](const std::array<mpz_class, 3>& grid) {
    Vector result;
    for (int k = 0; k < 3; ++k) result[k] = geometry.origin[k] + geometry.step * grid[k];
    return result;
  };
  data_->directional = light.point.directional;
  if (data_->directional) {
    for (int k = 0; k < 3; ++k) data_->light[k] = light.point.grid[k];
  } else {
    data_->light = in_scene(light.point.grid);
  }
  for (const Part& part : scene.parts) {
    Data::Caster caster;
    for (VertexId vertex : scene.loop(part)) {
      caster.loop.push_back(in_scene(
          {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1), geometry.grid.at(vertex, 2)}));
    }
    const std::size_t size = caster.loop.size();
    caster.normal =
        cross(minus(caster.loop[1], caster.loop[0]), minus(caster.loop[2], caster.loop[0]));
    for (std::size_t i = 0; i < size; ++i) {
      caster.inward.push_back(
          cross(caster.normal, minus(caster.loop[(i + 1) % size], caster.loop[i])));
    }
    const mpq_class height = data_->directional
                                 ? dot(caster.normal, data_->light)
                                 : dot(caster.normal, minus(data_->light, caster.loop[0]));
    caster.receives = height > 0 || (height < 0 && part.two_sided);
    caster.casts = caster.receives && part.casts;
    all_.push_back(static_cast<std::uint32_t>(data_->parts.size()));
    data_->parts.push_back(std::move(caster));
  }
}

VisibilityTest::~VisibilityTest() = default;
VisibilityTest::VisibilityTest(VisibilityTest&&) noexcept = default;

PointVisibility VisibilityTest::at(std::uint32_t receiver, const RationalPoint& point) const {
  return among(all_, receiver, point);
}

PointVisibility VisibilityTest::among(std::span<const std::uint32_t> casters,
                                      std::uint32_t receiver, const RationalPoint& point) const {
  PointVisibility result;
  const Data::Caster& own = data_->parts[receiver];
  if (!own.receives) {
    result.visibility = Visibility::kShadow;
    return result;
  }
  const Vector to_light = data_->directional ? data_->light : minus(data_->light, point);
  for (const std::uint32_t i : casters) {
    const Data::Caster& caster = data_->parts[i];
    if (i == receiver || !caster.casts) continue;
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
      if (coplanar || data_->place(caster, point) == Place::kOutside) continue;
      result = {Visibility::kBoundary, i};
      continue;
    }
    if (rise == 0) continue;
    const mpq_class t = -height / rise;
    if (t <= 0 || (!data_->directional && t >= 1)) continue;
    Vector meeting;
    for (int k = 0; k < 3; ++k) meeting[k] = point[k] + t * to_light[k];
    switch (data_->place(caster, meeting)) {
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
