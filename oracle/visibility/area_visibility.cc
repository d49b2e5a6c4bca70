// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/area_visibility.h"

#include <algorithm>
#include <numeric>

#include "oracle/visibility/area_visibility_data.h"

namespace gnomon::oracle {

using area_view::closed_part;
using area_view::HalfSpace;
using area_view::Loop;
using area_view::loop_normal;
using area_view::place_in;
using area_view::Polygon3;
using area_view::through;
using area_view::Vector;
using space::cross;
using space::dot;
using space::minus;
using space::negated;

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
  data_->all.resize(data_->parts.size());
  std::iota(data_->all.begin(), data_->all.end(), 0u);
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

AreaPointVisibility AreaVisibility::at(std::uint32_t receiver, Side side,
                                       const RationalPoint& point, bool fractions) const {
  return at(receiver, side, point, fractions, data_->all);
}

AreaPointVisibility AreaVisibility::at(std::uint32_t receiver, Side side,
                                       const RationalPoint& point, bool fractions,
                                       std::span<const std::uint32_t> casters) const {
  return look(receiver, side, point, fractions, casters, nullptr);
}

/// A caster with another loop.
struct AreaVisibility::Moved {
  std::uint32_t part;
  Polygon3 polygon;
};

AreaPointVisibility AreaVisibility::at_if_moved(std::uint32_t receiver, Side side,
                                                const RationalPoint& point,
                                                std::span<const std::uint32_t> casters,
                                                std::uint32_t moved,
                                                const std::vector<RationalPoint>& loop) const {
  Moved other{moved, data_->parts[moved]};
  other.polygon.loop = loop;
  return look(receiver, side, point, true, casters, &other);
}

AreaPointVisibility AreaVisibility::look(std::uint32_t receiver, Side side,
                                         const RationalPoint& point, bool fractions,
                                         std::span<const std::uint32_t> casters,
                                         const Moved* moved) const {
  const Data& data = *data_;
  AreaPointVisibility result;
  const Loop seen = data.seen_by(receiver, side);
  const mpq_class above = data.height(point);
  if (seen.empty() || above <= 0) {
    result.state = LightState::kUmbra;
    result.behind_light = true;
    result.on_boundary = result.jumps = !seen.empty() && above == 0;
    return result;
  }
  const mpq_class whole = data.area_of(seen);
  bool touches = false, touches_all = false, certain_umbra = false, some_umbra = false;
  mpq_class most;
  std::vector<Loop> visible{seen};
  for (const std::uint32_t i : casters) {
    const Polygon3& caster = moved && moved->part == i ? moved->polygon : data.parts[i];
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
      const bool lies_on = place_in(caster, point) >= 0;
      if ((front && back) || lies_on) touches = touches_all = true;
      result.jumps = result.jumps || lies_on;
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
  result.state = some_umbra ? LightState::kUmbra
                 : most > 0 ? LightState::kPenumbra
                            : LightState::kLit;
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

}  // namespace gnomon::oracle
