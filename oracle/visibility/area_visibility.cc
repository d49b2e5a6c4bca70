// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/area_visibility.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "oracle/geometry/space_loop.h"

namespace gnomon::oracle {

namespace {

using space::area_along;
using space::cross;
using space::dot;
using space::Loop;
using space::minus;
using space::negated;

using Vector = RationalPoint;

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

struct Polygon3 {
  Loop loop;
  std::vector<VertexId> vertices;  // equal ids are equal points
  Vector normal;                   // of the front
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
  std::vector<std::uint32_t> all;  // parts
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
  /// Where light may cross one edge on its way to a convex polygon: half-spaces across the light's
  /// plane whose intersection holds all places where it arrives from. `none`: it cannot cross.
  struct Crossing {
    enum class Kind : std::uint8_t { kNone, kSome, kUnknown } kind = Kind::kNone;
    std::vector<HalfSpace> bounds;
  };
  Crossing crossing(const Vector& u, const Vector& v, const Loop& polygon) const;
  /// A sheet of casters that share edges, all of them between the polygon and the light, one face
  /// forward.
  struct Facet {
    std::uint32_t part = 0;
    bool front = true;  // blocks with its front
  };
  std::vector<Loop> without_sheet(const std::vector<Loop>& loops, const std::vector<Facet>& sheet,
                                  const Loop& polygon) const;
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
      polygon.vertices.push_back(vertex);
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

// With h the height over the light's plane, the line from p through x meets that plane in
// (h(p) x - h(x) p) / (h(p) - h(x)), bilinear in p and x above and below. Where h(x) <= h(p) all
// these are combinations, with weights that are not negative, of those of the polygon's corners and
// the edge's ends: points, or directions where h(p) = h(x).
AreaVisibility::Data::Crossing AreaVisibility::Data::crossing(const Vector& u, const Vector& v,
                                                              const Loop& polygon) const {
  Crossing result;
  mpq_class low = height(polygon[0]), high = low;
  for (const Vector& corner : polygon) {
    low = std::min(low, height(corner));
    high = std::max(high, height(corner));
  }
  Loop ends{u, v};
  std::array<mpq_class, 2> heights{height(u), height(v)};
  if (heights[0] > heights[1]) {
    std::swap(ends[0], ends[1]);
    std::swap(heights[0], heights[1]);
  }
  if (heights[0] >= high) return result;  // below all of the polygon
  if (heights[1] > low) {
    // What is below the polygon's lowest corner counts for none of its points, if it is level.
    if (heights[0] > low || low != high) {
      result.kind = Crossing::Kind::kUnknown;
      return result;
    }
    const mpq_class t = (low - heights[0]) / (heights[1] - heights[0]);
    for (int k = 0; k < 3; ++k) ends[1][k] = ends[0][k] + t * (ends[1][k] - ends[0][k]);
    heights[1] = low;
  }
  int axis = 0;
  while (light_normal[axis] == 0) ++axis;
  const int first = (axis + 1) % 3, second = (axis + 2) % 3;
  std::vector<Vector> generators;  // x, y, w
  for (const Vector& corner : polygon) {
    const mpq_class above = height(corner);
    for (int e = 0; e < 2; ++e) {
      const auto at = [&](int k) { return mpq_class(above * ends[e][k] - heights[e] * corner[k]); };
      Vector generator{at(first), at(second), mpq_class(above - heights[e])};
      if (generator[0] != 0 || generator[1] != 0 || generator[2] != 0) {
        generators.push_back(std::move(generator));
      }
    }
  }
  bool flat = true;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Vector line = cross(generators[i], generators[j]);
      if (line[0] == 0 && line[1] == 0) {
        flat = flat && line[2] == 0;
        continue;
      }
      bool positive = false, negative = false;
      for (const Vector& generator : generators) {
        const int sign = sgn(dot(line, generator));
        positive = positive || sign > 0;
        negative = negative || sign < 0;
      }
      if (positive || negative) flat = false;
      if (positive == negative) continue;
      if (negative) line = negated(line);
      HalfSpace half;
      half.normal[first] = line[0];
      half.normal[second] = line[1];
      const int along = line[0] != 0 ? first : second;
      half.base[along] = -line[2] / half.normal[along];
      result.bounds.push_back(std::move(half));
    }
  }
  // Without area only if the edge lies in the receiver's plane, which A_R does not cross.
  if (!flat) result.kind = Crossing::Kind::kSome;
  return result;
}

// Of the sheet's facets all face the same way. Seen from p, the number of those that cover a point
// of the light is how often the sheet's border winds around it, and does not change while neither
// moves across the border. So what no border edge can cross, from anywhere in the polygon, is
// covered from all of it if it is from one point.
std::vector<Loop> AreaVisibility::Data::without_sheet(const std::vector<Loop>& loops,
                                                      const std::vector<Facet>& sheet,
                                                      const Loop& polygon) const {
  constexpr std::size_t kMostPieces = 500;
  std::map<std::pair<VertexId, VertexId>, std::pair<int, std::pair<const Vector*, const Vector*>>>
      border;
  for (const Facet& facet : sheet) {
    const Polygon3& own = parts[facet.part];
    for (std::size_t i = 0; i < own.loop.size(); ++i) {
      const std::size_t j = (i + 1) % own.loop.size();
      const bool ordered = own.vertices[i] < own.vertices[j];
      auto& [count, ends] = border[std::minmax(own.vertices[i], own.vertices[j])];
      count += ordered == facet.front ? 1 : -1;
      ends = {&own.loop[i], &own.loop[j]};
    }
  }
  std::vector<Loop> open, cells = loops;
  for (const auto& [ids, edge] : border) {
    if (edge.first == 0) continue;
    const Crossing where = crossing(*edge.second.first, *edge.second.second, polygon);
    if (where.kind == Crossing::Kind::kUnknown) return loops;
    if (where.kind == Crossing::Kind::kNone) continue;
    std::vector<Loop> next;
    for (Loop& cell : cells) {
      for (const HalfSpace& half : where.bounds) {
        Loop beyond = closed_part(cell, {negated(half.normal), half.base});
        if (area_of(beyond) > 0) next.push_back(std::move(beyond));
        cell = closed_part(cell, half);
        if (!(area_of(cell) > 0)) {
          cell.clear();
          break;
        }
      }
      if (!cell.empty()) open.push_back(std::move(cell));
    }
    cells = std::move(next);
    if (cells.size() + open.size() > kMostPieces) return loops;
  }
  const auto middle_of = [](const Loop& loop) {
    Vector middle;
    for (const Vector& vertex : loop) {
      for (int k = 0; k < 3; ++k) middle[k] += vertex[k] / mpq_class(loop.size());
    }
    return middle;
  };
  const Vector from = middle_of(polygon);
  for (Loop& cell : cells) {
    const Vector to = middle_of(cell);
    const bool covered = std::any_of(sheet.begin(), sheet.end(), [&](const Facet& facet) {
      const Polygon3& own = parts[facet.part];
      for (std::size_t e = 0; e < own.loop.size(); ++e) {
        if (through(from, own, e).at(to) < 0) return false;
      }
      return true;
    });
    if (!covered) open.push_back(std::move(cell));
  }
  return open;
}

bool AreaVisibility::hides_all_from(std::uint32_t receiver, Side side,
                                    const std::vector<RationalPoint>& polygon) const {
  const Data& data = *data_;
  const Loop seen = data.seen_by(receiver, side);
  if (seen.empty()) return false;
  for (const Vector& corner : polygon) {
    if (data.height(corner) < 0) return false;
  }
  std::vector<Loop> visible{seen};
  std::vector<Data::Facet> facets;
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
    const auto some_at = [&](int sign) {
      return std::any_of(seen.begin(), seen.end(),
                         [&](const Vector& a) { return sgn(starts.at(a)) == sign; });
    };
    if (!some_at(1)) continue;
    if (!some_at(-1)) facets.push_back({i, behind});
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
  // Sheets: facets joined across shared edges.
  std::vector<std::size_t> parent(facets.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  std::map<std::pair<VertexId, VertexId>, std::size_t> edges;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const std::vector<VertexId>& loop = data.parts[facets[f].part].vertices;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto edge = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      const auto [place, inserted] = edges.try_emplace(edge, f);
      if (!inserted) parent[find(f)] = find(place->second);
    }
  }
  std::map<std::size_t, std::vector<Data::Facet>> sheets;
  for (std::size_t f = 0; f < facets.size(); ++f) sheets[find(f)].push_back(facets[f]);
  for (const auto& [root, sheet] : sheets) {
    if (sheet.size() < 2) continue;
    visible = data.without_sheet(visible, sheet, polygon);
    if (visible.empty()) return true;
  }
  return false;
}

}  // namespace gnomon::oracle
