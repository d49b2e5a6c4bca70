// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/area_visibility.h"

#include <algorithm>
#include <array>

namespace gnomon::oracle {

namespace {

using Vector = ExactPoint;
using Loop = std::vector<Vector>;

Vector minus(const Vector& a, const Vector& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}

mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}

Vector negated(const Vector& a) { return {mpq_class(-a[0]), mpq_class(-a[1]), mpq_class(-a[2])}; }

/// normal . (x - base) >= 0.
struct HalfSpace {
  Vector normal, base;
  mpq_class at(const Vector& point) const { return dot(normal, minus(point, base)); }
};

/// What of a convex loop is in the closed half-space: also what has no area, down to a point.
Loop closed_part(const Loop& loop, const HalfSpace& half) {
  std::vector<mpq_class> values;
  bool outside = false;
  for (const Vector& point : loop) {
    values.push_back(half.at(point));
    outside = outside || values.back() < 0;
  }
  if (!outside) return loop;
  Loop result;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    if (values[i] >= 0) result.push_back(loop[i]);
    if (sgn(values[i]) * sgn(values[j]) >= 0) continue;
    const mpq_class t = values[i] / (values[i] - values[j]);
    Vector crossing;
    for (int k = 0; k < 3; ++k) crossing[k] = loop[i][k] + t * (loop[j][k] - loop[i][k]);
    result.push_back(std::move(crossing));
  }
  return result;
}

mpq_class area_along(const Vector& normal, const Loop& loop) {
  mpq_class sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += dot(normal, cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0])));
  }
  return sum / 2;
}

struct Polygon3 {
  Loop loop;
  Vector normal;  // of the front
  bool two_sided = false, casts = false;
};

Vector loop_normal(const Loop& loop) {
  return cross(minus(loop[1], loop[0]), minus(loop[2], loop[0]));
}

/// Where a point of the polygon's plane lies: 1 inside, 0 on the border, -1 outside.
int place_in(const Polygon3& polygon, const Vector& point) {
  int result = 1;
  for (std::size_t i = 0; i < polygon.loop.size(); ++i) {
    const Vector& a = polygon.loop[i];
    const Vector edge = minus(polygon.loop[(i + 1) % polygon.loop.size()], a);
    result = std::min(result, sgn(dot(cross(polygon.normal, edge), minus(point, a))));
  }
  return result;
}

/// The half-space of the plane through a point and an edge of a polygon that holds the polygon.
/// Requires: the point is not in the polygon's plane.
HalfSpace through(const Vector& point, const Polygon3& polygon, std::size_t edge) {
  const std::size_t size = polygon.loop.size();
  const Vector &a = polygon.loop[edge], &b = polygon.loop[(edge + 1) % size];
  HalfSpace half{cross(minus(a, point), minus(b, point)), point};
  if (half.at(polygon.loop[(edge + 2) % size]) < 0) half.normal = negated(half.normal);
  return half;
}

}  // namespace

struct AreaVisibility::Data {
  std::vector<Polygon3> parts;
  Loop light;
  Vector light_normal;
  mpq_class light_area;

  mpq_class height(const Vector& point) const { return dot(light_normal, minus(point, light[0])); }
  mpq_class area_of(const Loop& loop) const { return area_along(light_normal, loop); }
  /// A_R; empty without area, or if the side does not receive.
  Loop seen_by(std::uint32_t receiver, Side side) const;
  bool coplanar(const Polygon3& a, const Polygon3& b) const {
    return std::all_of(a.loop.begin(), a.loop.end(), [&](const Vector& vertex) {
      return dot(b.normal, minus(vertex, b.loop[0])) == 0;
    });
  }
  /// What is left of loops in the light's plane without one convex loop.
  std::vector<Loop> without(const std::vector<Loop>& loops, const Loop& hidden) const;
};

AreaVisibility::AreaVisibility(const PreparedScene& scene, const PreparedLight& light)
    : data_(std::make_unique<Data>()) {
  const Geometry& geometry = scene.geometry;
  const auto in_scene = [&](const std::array<mpz_class, 3>& grid) {
    Vector result;
    for (int k = 0; k < 3; ++k) result[k] = geometry.origin[k] + geometry.step * grid[k];
    return result;
  };
  for (const auto& vertex : light.area_loop) data_->light.push_back(in_scene(vertex));
  data_->light_normal = loop_normal(data_->light);
  data_->light_area = data_->area_of(data_->light);
  for (const Part& part : scene.parts) {
    Polygon3 polygon;
    for (VertexId vertex : scene.loop(part)) {
      polygon.loop.push_back(in_scene(
          {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1), geometry.grid.at(vertex, 2)}));
    }
    polygon.normal = loop_normal(polygon.loop);
    polygon.two_sided = part.two_sided;
    polygon.casts = part.casts;
    data_->parts.push_back(std::move(polygon));
  }
}

AreaVisibility::~AreaVisibility() = default;
AreaVisibility::AreaVisibility(AreaVisibility&&) noexcept = default;

Loop AreaVisibility::Data::seen_by(std::uint32_t receiver, Side side) const {
  const Polygon3& own = parts[receiver];
  if (side == Side::kOn || (side == Side::kBack && !own.two_sided)) return {};
  const bool in_front = std::any_of(own.loop.begin(), own.loop.end(),
                                    [&](const Vector& vertex) { return height(vertex) > 0; });
  if (!in_front) return {};
  Loop seen =
      closed_part(light, {side == Side::kFront ? own.normal : negated(own.normal), own.loop[0]});
  return area_of(seen) > 0 ? seen : Loop{};
}

std::vector<Loop> AreaVisibility::Data::without(const std::vector<Loop>& loops,
                                                const Loop& hidden) const {
  std::vector<Loop> left;
  for (Loop rest : loops) {
    for (std::size_t i = 0; i < hidden.size() && !rest.empty(); ++i) {
      const Vector edge = minus(hidden[(i + 1) % hidden.size()], hidden[i]);
      const HalfSpace inside{cross(light_normal, edge), hidden[i]};
      Loop beyond = closed_part(rest, {negated(inside.normal), inside.base});
      if (area_of(beyond) > 0) left.push_back(std::move(beyond));
      rest = closed_part(rest, inside);
      if (!(area_of(rest) > 0)) rest.clear();
    }
  }
  return left;
}

AreaPointVisibility AreaVisibility::at(std::uint32_t receiver, Side side, const ExactPoint& point,
                                       bool fractions) const {
  const Data& data = *data_;
  AreaPointVisibility result;
  const Loop seen = data.seen_by(receiver, side);
  const mpq_class above = data.height(point);
  if (seen.empty() || above <= 0) {
    result.shade = ShadeClass::kUmbra;
    result.behind_light = true;
    result.on_boundary = !seen.empty() && above == 0;
    return result;
  }
  const mpq_class whole = data.area_of(seen);
  bool touches = false, touches_all = false, certain_umbra = false, some_umbra = false;
  mpq_class most;
  std::vector<Loop> visible{seen};
  for (std::uint32_t i = 0; i < data.parts.size(); ++i) {
    const Polygon3& caster = data.parts[i];
    if (i == receiver || !caster.casts) continue;
    const mpq_class rise = dot(caster.normal, minus(point, caster.loop[0]));
    if (rise == 0) {
      // Segments leave the plane at once or stay in it. Next to this point they may meet the
      // caster, if the point is in it or the light reaches the plane; not if both are coplanar.
      if (data.coplanar(data.parts[receiver], caster)) continue;
      const auto on_or = [&](int wanted) {
        return std::any_of(seen.begin(), seen.end(), [&](const Vector& a) {
          const int sign = sgn(dot(caster.normal, minus(a, caster.loop[0])));
          return sign == 0 || sign == wanted;
        });
      };
      const bool front = on_or(1), back = on_or(-1);
      if (!front && !caster.two_sided) continue;
      if ((front && back) || place_in(caster, point) >= 0) touches = touches_all = true;
      continue;
    }
    if (rise > 0 && !caster.two_sided) continue;
    HalfSpace starts{rise < 0 ? caster.normal : negated(caster.normal), caster.loop[0]};
    const bool some_starts =
        std::any_of(seen.begin(), seen.end(), [&](const Vector& a) { return starts.at(a) > 0; });
    if (!some_starts) continue;  // none of the light, or both in one plane
    Loop hidden = closed_part(seen, starts);
    for (std::size_t e = 0; e < caster.loop.size() && !hidden.empty(); ++e) {
      hidden = closed_part(hidden, through(point, caster, e));
    }
    if (hidden.empty()) continue;
    const mpq_class area = data.area_of(hidden);
    if (area == 0) {
      touches = true;
      continue;
    }
    if (area > most) {
      most = area;
      result.caster = i;
    }
    if (area == whole) {
      some_umbra = true;
      // Strictly inside every plane that bounds the umbra: it is umbra nearby too.
      bool strict = true;
      for (const Vector& a : seen) {
        if (starts.at(a) == 0) continue;
        for (std::size_t e = 0; e < caster.loop.size(); ++e) {
          strict = strict && through(point, caster, e).at(a) > 0;
        }
      }
      certain_umbra = certain_umbra || strict;
    }
    if (fractions) {
      result.by_caster.emplace_back(i, mpq_class(area / data.light_area));
      visible = data.without(visible, hidden);
    }
  }
  result.shade = some_umbra ? ShadeClass::kUmbra
                 : most > 0 ? ShadeClass::kPenumbra
                            : ShadeClass::kLit;
  if (some_umbra) {
    result.on_boundary = !certain_umbra;
  } else {
    // Between penumbra and umbra only a caster in whose plane the point lies can be undecided.
    result.on_boundary = most > 0 ? touches_all : touches;
  }
  if (fractions) {
    for (const Loop& loop : visible) result.visible += data.area_of(loop);
    result.hidden = (whole - result.visible) / data.light_area;
    result.visible /= data.light_area;
  }
  return result;
}

bool AreaVisibility::hides_all_from(std::uint32_t receiver, Side side,
                                    const std::vector<ExactPoint>& polygon) const {
  const Data& data = *data_;
  const Loop seen = data.seen_by(receiver, side);
  if (seen.empty()) return false;
  for (const Vector& corner : polygon) {
    if (data.height(corner) < 0) return false;
  }
  std::vector<Loop> visible{seen};
  for (std::uint32_t i = 0; i < data.parts.size(); ++i) {
    const Polygon3& caster = data.parts[i];
    if (i == receiver || !caster.casts) continue;
    bool before = false, behind = false;
    std::vector<int> rises;
    for (const Vector& corner : polygon) {
      rises.push_back(sgn(dot(caster.normal, minus(corner, caster.loop[0]))));
      before = before || rises.back() > 0;
      behind = behind || rises.back() < 0;
    }
    if (before == behind || (before && !caster.two_sided)) continue;
    const HalfSpace starts{behind ? caster.normal : negated(caster.normal), caster.loop[0]};
    const bool some_starts =
        std::any_of(seen.begin(), seen.end(), [&](const Vector& a) { return starts.at(a) > 0; });
    if (!some_starts) continue;
    Loop hidden = closed_part(seen, starts);
    for (std::size_t c = 0; c < polygon.size() && data.area_of(hidden) > 0; ++c) {
      if (rises[c] == 0) {
        // What is hidden next to a corner in the caster's plane: all, or nothing.
        if (place_in(caster, polygon[c]) < 0) hidden.clear();
        continue;
      }
      for (std::size_t e = 0; e < caster.loop.size() && !hidden.empty(); ++e) {
        hidden = closed_part(hidden, through(polygon[c], caster, e));
      }
    }
    if (!(data.area_of(hidden) > 0)) continue;
    visible = data.without(visible, hidden);
    if (visible.empty()) return true;
  }
  return false;
}

}  // namespace gnomon::oracle
