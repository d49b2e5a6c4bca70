// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/point_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "oracle/geometry/chart.h"
#include "oracle/geometry/convex_loop.h"
#include "oracle/visibility/light_index.h"
#include "oracle/visibility/outside_planes.h"

namespace gnomon::oracle {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// All rays below are off by at most a few units of 2^-53 in each component of size at most 1: a
// cross product by less than 16, its dot product with a third ray by less than 3 * 16 + 3 * 8 + 4
// of them.
constexpr double kRayBound = 0x1p-45;

}  // namespace

struct PointRegions::Data {
  struct PartData {
    std::vector<Integers3> loop;
    ExactPlane plane;               // oriented to the light
    std::vector<ExactPlane> edges;  // through the light and each edge, inside positive
    Side facing = Side::kOn;        // of the loop's own orientation
    bool receives = false, casts = false;
    // Doubles, for the cull alone.
    std::vector<Vector> positions, rays, edge_normals;
    Vector normal{};
    double offset_bound = 0;
  };

  const PreparedScene& scene;
  const PreparedLight& light;
  std::vector<PartData> parts;
  std::optional<LightIndex> index;  // of all that casts

  Data(const PreparedScene& prepared, const PreparedLight& prepared_light)
      : scene(prepared), light(prepared_light) {}

  void read_part(std::size_t index);
  void approximate();
  bool certainly_apart(const PartData& receiver, const PartData& caster) const;
};

void PointRegions::Data::read_part(std::size_t index) {
  const Part& part = scene.parts[index];
  PartData& data = parts[index];
  for (VertexId vertex : scene.loop(part)) {
    data.loop.push_back({scene.geometry.grid.at(vertex, 0), scene.geometry.grid.at(vertex, 1),
                         scene.geometry.grid.at(vertex, 2)});
  }
  data.plane = plane_of(data.loop);
  const Integers3& at = light.point.grid;
  const mpz_class height =
      light.point.directional ? oracle::dot(data.plane.normal, at) : value_at(data.plane, at);
  data.facing = side_of(sign_of(height));
  if (data.facing == Side::kOn) return;
  const bool shows_side = data.facing == Side::kFront || part.two_sided;
  data.receives = shows_side;
  data.casts = shows_side && (part.casts || light.is_eye);
  if (data.facing == Side::kBack) data.plane = opposite(data.plane);
  const std::size_t size = data.loop.size();
  for (std::size_t i = 0; i < size; ++i) {
    const Integers3 &a = data.loop[i], &b = data.loop[(i + 1) % size];
    ExactPlane edge;
    edge.normal = light.point.directional ? oracle::cross(at, minus(b, a))
                                          : oracle::cross(minus(a, at), minus(b, at));
    edge.offset = oracle::dot(edge.normal, a);
    reduce(edge);
    // The polygon lies on one side of it; its vertices say on which.
    for (const Integers3& vertex : data.loop) {
      const int sign = sgn(value_at(edge, vertex));
      if (sign < 0) edge = opposite(edge);
      if (sign != 0) break;
    }
    data.edges.push_back(std::move(edge));
  }
}

// Positions relative to the light's place (point) or to the middle of the scene (directional),
// exactly subtracted on the grid, then scaled by one power of two and rounded once.
void PointRegions::Data::approximate() {
  const bool directional = light.point.directional;
  Integers3 centre;
  if (directional) {
    if (!parts.empty() && !parts[0].loop.empty()) centre = parts[0].loop[0];
  } else {
    centre = light.point.grid;
  }
  std::size_t bits = 1;
  for (const PartData& part : parts) {
    for (const Integers3& vertex : part.loop) {
      for (int k = 0; k < 3; ++k) {
        const mpz_class difference = vertex[k] - centre[k];
        bits = std::max(bits, mpz_sizeinbase(difference.get_mpz_t(), 2));
      }
    }
  }
  const auto scaled = [](const mpz_class& value, std::size_t shift) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
    const long power = exponent - static_cast<long>(shift);
    return power < -1060 ? 0.0 : std::ldexp(mantissa, static_cast<int>(power));
  };
  // An orthonormal frame across the direction of a directional light.
  Vector u{}, v{};
  if (directional) {
    std::size_t size = 1;
    for (const mpz_class& component : light.point.grid) {
      size = std::max(size, mpz_sizeinbase(component.get_mpz_t(), 2));
    }
    Vector d;
    for (int k = 0; k < 3; ++k) d[k] = scaled(light.point.grid[k], size);
    int smallest = 0;
    for (int k = 1; k < 3; ++k) {
      if (std::fabs(d[k]) < std::fabs(d[smallest])) smallest = k;
    }
    Vector helper{};
    helper[smallest] = 1;
    u = cross(d, helper);
    const double u_length = std::sqrt(dot(u, u));
    for (double& component : u) component /= u_length;
    v = cross(d, u);
    const double v_length = std::sqrt(dot(v, v));
    for (double& component : v) component /= v_length;
  }
  for (PartData& part : parts) {
    for (const Integers3& vertex : part.loop) {
      Vector position;
      for (int k = 0; k < 3; ++k) {
        position[k] = scaled(mpz_class(vertex[k] - centre[k]), bits) / 2;
      }
      part.positions.push_back(position);
      // Directional: dots with the frame, at most sqrt(3) / 2 in size.
      part.rays.push_back(directional ? Vector{dot(u, position), dot(v, position), 1.0} : position);
    }
    if (!part.casts && !part.receives) continue;
    std::size_t size = 1;
    for (const mpz_class& component : part.plane.normal) {
      size = std::max(size, mpz_sizeinbase(component.get_mpz_t(), 2));
    }
    for (int k = 0; k < 3; ++k) part.normal[k] = scaled(part.plane.normal[k], size);
    const std::size_t count = part.rays.size();
    for (std::size_t i = 0; i < count; ++i) {
      Vector normal = cross(part.rays[i], part.rays[(i + 1) % count]);
      // Turned inward by the vertex that is most clearly on one side.
      double most = 0;
      for (const Vector& ray : part.rays) {
        const double value = dot(normal, ray);
        if (std::fabs(value) > std::fabs(most)) most = value;
      }
      if (std::fabs(most) <= kRayBound) continue;  // too thin to say
      if (most < 0) normal = {-normal[0], -normal[1], -normal[2]};
      part.edge_normals.push_back(normal);
    }
  }
}

bool PointRegions::Data::certainly_apart(const PartData& receiver, const PartData& caster) const {
  const auto outside = [](const Vector& normal, const std::vector<Vector>& rays) {
    for (const Vector& ray : rays) {
      if (dot(normal, ray) >= -kRayBound) return false;
    }
    return true;
  };
  for (const Vector& normal : caster.edge_normals) {
    if (outside(normal, receiver.rays)) return true;
  }
  for (const Vector& normal : receiver.edge_normals) {
    if (outside(normal, caster.rays)) return true;
  }
  // The caster wholly behind the receiver's plane, or the receiver wholly in front of the caster's.
  const auto beyond = [](const Vector& normal, const Vector& base,
                         const std::vector<Vector>& positions, double sign) {
    for (const Vector& position : positions) {
      const Vector difference{position[0] - base[0], position[1] - base[1], position[2] - base[2]};
      if (sign * dot(normal, difference) <= kRayBound) return false;
    }
    return true;
  };
  return beyond(receiver.normal, receiver.positions[0], caster.positions, -1) ||
         beyond(caster.normal, caster.positions[0], receiver.positions, 1);
}

PointRegions::PointRegions(const PreparedScene& scene, const PreparedLight& light)
    : data_(std::make_unique<Data>(scene, light)) {
  data_->parts.resize(scene.parts.size());
  for (std::size_t i = 0; i < scene.parts.size(); ++i) data_->read_part(i);
  data_->approximate();
  std::vector<std::uint32_t> casters;
  for (std::uint32_t i = 0; i < data_->parts.size(); ++i) {
    if (data_->parts[i].casts) casters.push_back(i);
  }
  data_->index.emplace(scene, light, casters);
}

PointRegions::~PointRegions() = default;
PointRegions::PointRegions(PointRegions&&) noexcept = default;

Side PointRegions::lit_side(std::uint32_t part) const {
  return data_->parts[part].receives ? data_->parts[part].facing : Side::kOn;
}

bool PointRegions::light_in_plane(std::uint32_t part) const {
  return data_->parts[part].facing == Side::kOn;
}

bool PointRegions::casts(std::uint32_t part) const { return data_->parts[part].casts; }

std::vector<std::uint32_t> PointRegions::casters_near(std::uint32_t receiver) const {
  const Data::PartData& own = data_->parts[receiver];
  std::vector<std::uint32_t> casters = data_->index->overlapping(receiver);
  std::erase_if(casters, [&](std::uint32_t caster) {
    return caster == receiver || data_->certainly_apart(own, data_->parts[caster]);
  });
  return casters;
}

std::vector<ExactPlane> PointRegions::shadow_planes(std::uint32_t caster) const {
  const Data::PartData& own = data_->parts[caster];
  std::vector<ExactPlane> planes{opposite(own.plane)};
  planes.insert(planes.end(), own.edges.begin(), own.edges.end());
  return planes;
}

std::vector<ExactPlane> PointRegions::outsides() const {
  return outside_planes(data_->scene.geometry, data_->light);
}

std::vector<ShadowPiece> PointRegions::shadows_on(std::uint32_t receiver) const {
  const Data::PartData& own = data_->parts[receiver];
  const Chart chart(own.plane);
  const ConvexLoop whole = loop_in_chart(chart, own.loop);
  std::vector<ShadowPiece> pieces;
  ConvexLoop loop, workspace;
  for (const std::uint32_t i : casters_near(receiver)) {
    const Data::PartData& caster = data_->parts[i];
    loop = whole;
    bool some = clip(loop, chart.trace(opposite(caster.plane)), workspace);
    for (std::size_t e = 0; some && e < caster.edges.size(); ++e) {
      some = clip(loop, chart.trace(caster.edges[e]), workspace);
    }
    if (some) pieces.push_back({i, std::move(loop.vertices)});
    loop = {};
  }
  for (const ExactPlane& outside : outsides()) {
    loop = whole;
    if (clip(loop, chart.trace(outside), workspace)) {
      pieces.push_back({ShadowPiece::kOutsideRegion, std::move(loop.vertices)});
    }
    loop = {};
  }
  return pieces;
}

}  // namespace gnomon::oracle
