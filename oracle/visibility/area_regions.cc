// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/area_regions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "oracle/geometry/chart.h"
#include "oracle/geometry/convex_loop.h"

namespace gnomon::oracle {

namespace {

using Points = std::vector<HomogeneousPoint>;
using Vector = std::array<double, 3>;

// A plane's value at a point in doubles: coordinates and coefficients at most 1 in size and off by
// at most 2^-50 each, the offset at most 4 (beyond that the sign is clear) and off by 2^-50, three
// products and three sums: less than 2^-46 in all.
constexpr double kNearBound = 0x1p-44;

void reduce(HomogeneousPoint& point) {
  mpz_class common = gcd(point.xyz[0], point.xyz[1]);
  common = gcd(common, point.xyz[2]);
  common = gcd(common, point.w);
  if (common <= 1) return;
  for (mpz_class& coordinate : point.xyz) coordinate /= common;
  point.w /= common;
}

/// What of a convex polygon in space is in front of or on a plane; empty without area in front.
Points front_of(const Points& loop, const ExactPlane& plane) {
  std::vector<mpz_class> values;
  bool front = false, back = false;
  for (const HomogeneousPoint& point : loop) {
    values.push_back(value_at(plane, point));
    front = front || values.back() > 0;
    back = back || values.back() < 0;
  }
  if (!front) return {};
  if (!back) return loop;
  Points result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    if (values[i] >= 0) result.push_back(loop[i]);
    if (sgn(values[i]) * sgn(values[j]) >= 0) continue;
    // Weights of opposite signs make the value 0; turned so that w stays positive.
    const mpz_class &a = values[i], &b = values[j];
    HomogeneousPoint crossing;
    for (int k = 0; k < 3; ++k) crossing.xyz[k] = a * loop[j].xyz[k] - b * loop[i].xyz[k];
    crossing.w = a * loop[j].w - b * loop[i].w;
    if (crossing.w < 0) {
      for (mpz_class& coordinate : crossing.xyz) coordinate = -coordinate;
      crossing.w = -crossing.w;
    }
    reduce(crossing);
    result.push_back(std::move(crossing));
  }
  return result;
}

Points as_points(const std::vector<Integers3>& loop) {
  Points result;
  for (const Integers3& point : loop) result.push_back({point, 1});
  return result;
}

/// w_a w_b (b - a): a positive multiple of the difference.
Integers3 difference(const HomogeneousPoint& a, const HomogeneousPoint& b) {
  Integers3 result;
  for (int k = 0; k < 3; ++k) result[k] = b.xyz[k] * a.w - a.xyz[k] * b.w;
  return result;
}

/// The plane through a point with a normal; nothing if the normal is zero.
std::optional<ExactPlane> plane_at(const HomogeneousPoint& point, Integers3 normal) {
  if (normal[0] == 0 && normal[1] == 0 && normal[2] == 0) return std::nullopt;
  ExactPlane plane;
  plane.offset = dot(normal, point.xyz);
  for (int k = 0; k < 3; ++k) plane.normal[k] = normal[k] * point.w;
  oracle::reduce(plane);
  return plane;
}

struct Sides {
  bool positive = false, negative = false;
};

Sides sides_of(const ExactPlane& plane, const Points& points) {
  Sides result;
  for (const HomogeneousPoint& point : points) {
    const int sign = sgn(value_at(plane, point));
    result.positive = result.positive || sign > 0;
    result.negative = result.negative || sign < 0;
  }
  return result;
}

bool same(const ExactPlane& a, const ExactPlane& b) {
  return a.normal == b.normal && a.offset == b.offset;
}

/// A plane in doubles, for the cull alone: normal . x - offset, scaled.
struct NearPlane {
  Vector normal{};
  double offset = 0;

  double at(const Vector& point) const {
    return normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2] - offset;
  }
};

/// An intersection of half-spaces, positive inside.
struct Volume {
  bool empty = true;
  std::vector<ExactPlane> planes;
  std::vector<NearPlane> near;
};

/// Planes through an edge of one and a vertex of the other that have `caster` on their positive and
/// `light` on their other side.
void add_separating_planes(const Points& edges_of, const Points& vertices_of, const Points& caster,
                           const Points& light, std::vector<ExactPlane>& planes) {
  for (std::size_t i = 0; i < edges_of.size(); ++i) {
    const HomogeneousPoint& from = edges_of[i];
    const Integers3 edge = difference(from, edges_of[(i + 1) % edges_of.size()]);
    for (const HomogeneousPoint& vertex : vertices_of) {
      std::optional<ExactPlane> plane = plane_at(from, cross(edge, difference(from, vertex)));
      if (!plane) continue;  // collinear
      const Sides own = sides_of(*plane, caster);
      if (own.positive == own.negative) continue;  // on both, or the caster's own plane
      if (own.negative) *plane = opposite(std::move(*plane));
      if (sides_of(*plane, light).positive) continue;
      const bool known = std::any_of(planes.begin(), planes.end(),
                                     [&](const ExactPlane& other) { return same(other, *plane); });
      if (!known) planes.push_back(std::move(*plane));
    }
  }
}

/// `blocking`: the caster's plane, oriented so that it blocks light that starts in front. `light`:
/// A_O, with some area in front of it.
Volume penumbra_volume(const Points& caster, const ExactPlane& blocking, const Points& light) {
  Volume volume;
  volume.empty = false;
  volume.planes.push_back(opposite(blocking));
  add_separating_planes(caster, light, caster, light, volume.planes);
  add_separating_planes(light, caster, caster, light, volume.planes);
  return volume;
}

/// `light`: A_R.
Volume umbra_volume(const Points& caster, const ExactPlane& blocking, const Points& light) {
  Volume volume;
  std::vector<ExactPlane> planes{opposite(blocking)};
  for (const HomogeneousPoint& vertex : light) {
    const int height = sgn(value_at(blocking, vertex));
    if (height < 0) return volume;
    for (std::size_t i = 0; i < caster.size(); ++i) {
      const HomogeneousPoint& from = caster[i];
      const Integers3 edge = difference(from, caster[(i + 1) % caster.size()]);
      // Of a vertex in the caster's plane: whether it is outside, by walls across that plane.
      std::optional<ExactPlane> plane =
          plane_at(from, cross(edge, height == 0 ? blocking.normal : difference(from, vertex)));
      if (!plane) continue;
      if (sides_of(*plane, caster).negative) *plane = opposite(std::move(*plane));
      if (height == 0) {
        if (value_at(*plane, vertex) < 0) return volume;
        continue;
      }
      const bool known = std::any_of(planes.begin(), planes.end(),
                                     [&](const ExactPlane& other) { return same(other, *plane); });
      if (!known) planes.push_back(std::move(*plane));
    }
  }
  volume.empty = false;
  volume.planes = std::move(planes);
  return volume;
}

}  // namespace

struct AreaRegions::Data {
  /// One side of a part as it blocks light, whatever the receiver.
  struct Blocker {
    std::uint32_t part = 0;
    ExactPlane plane;        // oriented so that the light it blocks is in front
    Points points;           // what of the part is in front of A's plane
    Volume penumbra, umbra;  // of all of A, for receivers that cut neither
    std::vector<Vector> near_points;
  };
  struct PartData {
    std::vector<Integers3> loop;
    ExactPlane plane;  // of the loop's own front
    Points front;      // what of the part is in front of A's plane
    std::vector<Vector> near_points;
    std::array<bool, 2> sees{};  // front, back
  };

  const PreparedScene& scene;
  Points light;
  ExactPlane light_plane;  // it emits to the front
  std::vector<PartData> parts;
  std::vector<Blocker> blockers;
  Integers3 centre;
  std::size_t box_bits = 1;

  Data(const PreparedScene& prepared, const PreparedLight& prepared_light);
  void set_box();
  Vector near_point(const HomogeneousPoint& point) const;
  NearPlane near_plane(const ExactPlane& plane) const;
  void set_near(Volume& volume) const {
    for (const ExactPlane& plane : volume.planes) volume.near.push_back(near_plane(plane));
  }
  bool clip_by(const Volume& volume, const Chart& chart, const PartData& receiver, bool closed,
               ConvexLoop& loop, ConvexLoop& workspace) const;
};

AreaRegions::Data::Data(const PreparedScene& prepared, const PreparedLight& prepared_light)
    : scene(prepared) {
  const std::vector<Integers3>& loop = prepared_light.area_loop;
  light = as_points(loop);
  light_plane = plane_of(loop);
  parts.resize(scene.parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    PartData& data = parts[i];
    for (VertexId vertex : scene.loop(scene.parts[i])) {
      data.loop.push_back({scene.geometry.grid.at(vertex, 0), scene.geometry.grid.at(vertex, 1),
                           scene.geometry.grid.at(vertex, 2)});
    }
    data.plane = plane_of(data.loop);
    data.front = front_of(as_points(data.loop), light_plane);
    if (data.front.empty()) continue;
    const Sides sides = sides_of(data.plane, light);
    data.sees = {sides.positive, sides.negative && scene.parts[i].two_sided};
  }
  set_box();
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    PartData& data = parts[i];
    for (const Integers3& vertex : data.loop) data.near_points.push_back(near_point({vertex, 1}));
    if (data.front.empty() || !scene.parts[i].casts) continue;
    for (const bool front : {true, false}) {
      if (!front && !scene.parts[i].two_sided) continue;
      Blocker blocker;
      blocker.part = i;
      blocker.plane = front ? data.plane : opposite(data.plane);
      const Points blocked = front_of(light, blocker.plane);
      if (blocked.empty()) continue;
      blocker.points = data.front;
      blocker.penumbra = penumbra_volume(blocker.points, blocker.plane, blocked);
      blocker.umbra = umbra_volume(blocker.points, blocker.plane, light);
      set_near(blocker.penumbra);
      set_near(blocker.umbra);
      for (const HomogeneousPoint& point : blocker.points) {
        blocker.near_points.push_back(near_point(point));
      }
      blockers.push_back(std::move(blocker));
    }
  }
}

void AreaRegions::Data::set_box() {
  if (!light.empty()) centre = light[0].xyz;
  for (const PartData& part : parts) {
    for (const Integers3& vertex : part.loop) {
      for (int k = 0; k < 3; ++k) {
        const mpz_class offset = vertex[k] - centre[k];
        box_bits = std::max(box_bits, mpz_sizeinbase(offset.get_mpz_t(), 2));
      }
    }
  }
}

namespace {

/// value / 2^shift, off by at most 2^-52 of itself; 0 or infinite beyond the range.
double scaled(const mpz_class& value, long shift) {
  if (value == 0) return 0;
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, value.get_mpz_t());
  return std::ldexp(mantissa, static_cast<int>(std::clamp(exponent - shift, -1060L, 1060L)));
}

}  // namespace

Vector AreaRegions::Data::near_point(const HomogeneousPoint& point) const {
  // 2^box_bits exceeds every offset from the centre: all coordinates are at most 1 in size.
  Vector result{};
  for (int k = 0; k < 3; ++k) {
    const mpz_class over = point.xyz[k] - centre[k] * point.w;
    if (over == 0) continue;
    long exponent_over = 0, exponent_w = 0;
    const double a = mpz_get_d_2exp(&exponent_over, over.get_mpz_t());
    const double b = mpz_get_d_2exp(&exponent_w, point.w.get_mpz_t());
    const long power = exponent_over - exponent_w - static_cast<long>(box_bits);
    result[k] = std::ldexp(a / b, static_cast<int>(std::clamp(power, -1060L, 1060L)));
  }
  return result;
}

NearPlane AreaRegions::Data::near_plane(const ExactPlane& plane) const {
  std::size_t bits = 1;
  for (const mpz_class& component : plane.normal) {
    bits = std::max(bits, mpz_sizeinbase(component.get_mpz_t(), 2));
  }
  NearPlane result;
  for (int k = 0; k < 3; ++k) result.normal[k] = scaled(plane.normal[k], static_cast<long>(bits));
  const mpz_class offset = plane.offset - dot(plane.normal, centre);
  result.offset = scaled(offset, static_cast<long>(bits + box_bits));
  return result;
}

bool AreaRegions::Data::clip_by(const Volume& volume, const Chart& chart, const PartData& receiver,
                                bool closed, ConvexLoop& loop, ConvexLoop& workspace) const {
  if (volume.empty) return false;
  for (std::size_t i = 0; i < volume.planes.size(); ++i) {
    if (!volume.near.empty()) {
      const NearPlane& near = volume.near[i];
      const bool inside = std::all_of(receiver.near_points.begin(), receiver.near_points.end(),
                                      [&](const Vector& p) { return near.at(p) > kNearBound; });
      if (inside) continue;
    }
    const ChartLine line = chart.trace(volume.planes[i]);
    // The receiver lies in the plane: inside of what is closed, outside of what is open.
    if (closed && line.a == 0 && line.b == 0 && line.c == 0) continue;
    if (!clip(loop, line, workspace)) return false;
  }
  return true;
}

AreaRegions::AreaRegions(const PreparedScene& scene, const PreparedLight& light)
    : data_(std::make_unique<Data>(scene, light)) {}
AreaRegions::~AreaRegions() = default;
AreaRegions::AreaRegions(AreaRegions&&) noexcept = default;

bool AreaRegions::sees(std::uint32_t part, Side side) const {
  return side != Side::kOn && data_->parts[part].sees[side == Side::kFront ? 0 : 1];
}

AreaShade AreaRegions::shade_on(std::uint32_t part, Side side) const {
  const Data& data = *data_;
  const Data::PartData& own = data.parts[part];
  const ExactPlane plane = side == Side::kFront ? own.plane : opposite(own.plane);
  const NearPlane near_plane = data.near_plane(plane);
  const Chart chart(plane);
  AreaShade shade;
  ConvexLoop whole = loop_in_chart(chart, own.loop), workspace;
  const ChartLine horizon = chart.trace(data.light_plane);
  {
    ConvexLoop behind = whole;
    const ChartLine beyond{-horizon.a, -horizon.b, -horizon.c};
    if (clip(behind, beyond, workspace)) shade.behind = std::move(behind.vertices);
  }
  if (!clip(whole, horizon, workspace)) return shade;
  const bool cuts_light = sides_of(plane, data.light).negative;
  const Points light = cuts_light ? front_of(data.light, plane) : data.light;

  for (const Data::Blocker& blocker : data.blockers) {
    if (blocker.part == part) continue;
    // Volumes of cut casters and lights lie inside those of whole ones: what these miss is apart.
    const auto all_outside = [](const NearPlane& near, const std::vector<Vector>& points) {
      return std::all_of(points.begin(), points.end(),
                         [&](const Vector& point) { return near.at(point) < -kNearBound; });
    };
    const bool apart =
        all_outside(near_plane, blocker.near_points) ||
        std::any_of(blocker.penumbra.near.begin(), blocker.penumbra.near.end(),
                    [&](const NearPlane& near) { return all_outside(near, own.near_points); });
    if (apart) continue;
    const Sides caster_sides = sides_of(plane, blocker.points);
    if (!caster_sides.positive) continue;  // behind the receiver, or coplanar with it
    Volume own_penumbra, own_umbra;
    const Volume *penumbra = &blocker.penumbra, *umbra = &blocker.umbra;
    if (cuts_light || caster_sides.negative) {
      const Points caster = front_of(blocker.points, plane);
      const Points blocked = front_of(light, blocker.plane);
      if (blocked.empty()) continue;
      own_penumbra = penumbra_volume(caster, blocker.plane, blocked);
      own_umbra = umbra_volume(caster, blocker.plane, light);
      penumbra = &own_penumbra;
      umbra = &own_umbra;
    }
    ConvexLoop loop = whole;
    if (!data.clip_by(*penumbra, chart, own, false, loop, workspace)) continue;
    shade.penumbra.push_back({blocker.part, std::move(loop.vertices)});
    loop = whole;
    if (!data.clip_by(*umbra, chart, own, true, loop, workspace)) continue;
    shade.umbra.push_back({blocker.part, std::move(loop.vertices)});
  }
  return shade;
}

}  // namespace gnomon::oracle
