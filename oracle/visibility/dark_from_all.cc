// SPDX-License-Identifier: GPL-3.0-or-later
// AreaVisibility::hides_all_from: what casters, each alone and in sheets, hide from all of a
// polygon.
#include <algorithm>
#include <map>
#include <numeric>

#include "oracle/visibility/area_visibility_data.h"

namespace gnomon::oracle {

using area_view::closed_part;
using area_view::EdgeOnLine;
using area_view::HalfSpace;
using area_view::Line;
using area_view::Loop;
using area_view::place_in;
using area_view::Polygon3;
using area_view::through;
using area_view::Vector;
using space::cross;
using space::dot;
using space::minus;
using space::negated;

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

std::map<Line, std::vector<EdgeOnLine>> AreaVisibility::Data::lines_of(
    const std::vector<Facet>& facets) const {
  std::map<Line, std::vector<EdgeOnLine>> result;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const Loop& loop = parts[facets[f].part].loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector &a = loop[i], &b = loop[(i + 1) % loop.size()];
      const Line line(a, b);
      const bool up = a[line.axis] < b[line.axis];
      result[line].push_back({up ? &a : &b, up ? &b : &a, up == facets[f].front ? 1 : -1, f});
    }
  }
  return result;
}

std::vector<std::vector<AreaVisibility::Data::Facet>> AreaVisibility::Data::sheets_of(
    const std::vector<Facet>& facets) const {
  std::vector<std::size_t> parent(facets.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t f) {
    while (parent[f] != f) f = parent[f] = parent[parent[f]];
    return f;
  };
  for (const auto& [line, edges] : lines_of(facets)) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const EdgeOnLine &a = edges[i], &b = edges[j];
        if (std::max((*a.low)[line.axis], (*b.low)[line.axis]) <
            std::min((*a.high)[line.axis], (*b.high)[line.axis])) {
          parent[find(a.facet)] = find(b.facet);
        }
      }
    }
  }
  std::map<std::size_t, std::vector<Facet>> sheets;
  for (std::size_t f = 0; f < facets.size(); ++f) sheets[find(f)].push_back(facets[f]);
  std::vector<std::vector<Facet>> result;
  for (auto& [root, sheet] : sheets) result.push_back(std::move(sheet));
  return result;
}

std::vector<std::pair<Vector, Vector>> AreaVisibility::Data::border_of(
    const std::vector<Facet>& sheet) const {
  std::vector<std::pair<Vector, Vector>> result;
  for (const auto& [line, edges] : lines_of(sheet)) {
    // Where edges begin and end along the line, and how many more bound one side than the other.
    std::map<mpq_class, std::pair<int, const Vector*>> changes;
    for (const EdgeOnLine& edge : edges) {
      for (const auto& [end, sign] : {std::pair{edge.low, edge.sign}, {edge.high, -edge.sign}}) {
        auto& [change, place] = changes[(*end)[line.axis]];
        change += sign;
        place = end;
      }
    }
    int count = 0;
    const Vector* since = nullptr;
    for (const auto& [at, change] : changes) {
      if (count != 0) result.emplace_back(*since, *change.second);
      count += change.first;
      since = change.second;
    }
  }
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
  std::vector<Loop> open, cells = loops;
  for (const auto& [from, to] : border_of(sheet)) {
    const Crossing where = crossing(from, to, polygon);
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
  for (const std::vector<Data::Facet>& sheet : data.sheets_of(facets)) {
    if (sheet.size() < 2) continue;
    visible = data.without_sheet(visible, sheet, polygon);
    if (visible.empty()) return true;
  }
  return false;
}

}  // namespace gnomon::oracle
