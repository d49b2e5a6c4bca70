// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <numeric>

#include "gnomon/scene/intent.h"
#include "scene/repair/snap.h"

namespace gnomon::scene_detail {

namespace {

/// Polygons that are to lie in one plane.
using Group = std::vector<std::uint32_t>;

/// The plane of the polygon when the round began, if it has one.
std::optional<PlaneId> plane_id(const PreparedScene& prepared, std::uint32_t polygon) {
  const std::uint32_t first = prepared.first_part[polygon], last = prepared.first_part[polygon + 1];
  for (std::uint32_t p = first; p < last; ++p) {
    if (prepared.parts[p].plane != prepared.parts[first].plane) return std::nullopt;
  }
  return first == last ? std::nullopt : std::optional(prepared.parts[first].plane);
}

std::vector<Group> groups_of(const PreparedScene& prepared,
                             const std::vector<NearlyCoplanarPair>& pairs,
                             const std::vector<std::uint32_t>& bent) {
  const std::size_t polygons = prepared.first_part.size() - 1;
  std::vector<std::uint32_t> parent(polygons);
  std::iota(parent.begin(), parent.end(), 0u);
  const auto first = [&](std::uint32_t polygon) {
    while (parent[polygon] != polygon) polygon = parent[polygon] = parent[parent[polygon]];
    return polygon;
  };
  std::vector<std::uint8_t> taken(polygons, 0);
  for (const std::uint32_t polygon : bent) taken[polygon] = 1;
  for (const NearlyCoplanarPair& pair : pairs) {
    taken[pair.polygon] = taken[pair.other] = 1;
    const std::uint32_t a = first(pair.polygon), b = first(pair.other);
    parent[std::max(a, b)] = std::min(a, b);
  }
  // Those that are in one plane already stay in one.
  std::map<PlaneId, std::uint32_t> first_in_plane;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    const auto plane = taken[p] != 0 ? plane_id(prepared, p) : std::nullopt;
    if (!plane) continue;
    const std::uint32_t a = first(p), b = first(first_in_plane.emplace(*plane, p).first->second);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::map<std::uint32_t, Group> groups;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    if (taken[p] != 0) groups[first(p)].push_back(p);
  }
  std::vector<Group> result;
  for (auto& [name, group] : groups) result.push_back(std::move(group));
  return result;
}

class Flattening {
 public:
  Flattening(SnapRound& round, const mpq_class& distance, const std::set<std::uint32_t>& pinned)
      : round_(round), distance_(distance), pinned_(pinned) {
    const PreparedScene& prepared = round.prepared();
    for (std::uint32_t p = 0; p + 1 < prepared.first_part.size(); ++p) {
      if (const auto plane = plane_id(prepared, p)) ++polygons_in_[*plane];
    }
  }

  /// Whether anything moved.
  bool flatten(const Group& group) {
    std::vector<std::pair<long double, std::uint32_t>> planar;
    for (const std::uint32_t polygon : group) {
      if (round_.plane_of(polygon)) planar.emplace_back(-area_of(polygon), polygon);
    }
    std::ranges::sort(planar);
    // The largest that is planar tells the plane. If nothing can come to it, all that lie in its
    // plane stay there if they are several, and the next may gather the rest. So nobody goes back
    // and forth: polygons join others in a plane, or leave them for one with a larger polygon.
    Group rest = group;
    for (const auto& [area, host] : planar) {
      const RationalPlane plane = *round_.plane_of(host);
      if (move_to(plane, rest)) return true;
      if (is_alone(host)) continue;
      std::erase_if(rest, [&](std::uint32_t polygon) {
        const auto own = round_.plane_of(polygon);
        return own && own->is_same_as(plane);
      });
    }
    return planar.empty() && flatten_bent(group);
  }

 private:
  /// Where vertices go, before it is known whether all can.
  using Moves = std::map<VertexId, RationalPoint>;

  long double area_of(std::uint32_t polygon) const {
    Vector sum;
    const PreparedScene& prepared = round_.prepared();
    for (std::uint32_t p = prepared.first_part[polygon]; p < prepared.first_part[polygon + 1];
         ++p) {
      sum = sum + round_.points().area_vector(prepared.loop(prepared.parts[p]));
    }
    return length_of(sum);
  }

  /// None is planar: planes through three vertices of the largest.
  bool flatten_bent(const Group& group) {
    const std::uint32_t host = *std::ranges::max_element(
        group, {}, [&](std::uint32_t polygon) { return area_of(polygon); });
    const std::vector<VertexId> vertices = round_.outline(host);
    constexpr std::size_t kMost = 8;  // vertices that are tried
    const std::size_t count = std::min(vertices.size(), kMost);
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        for (std::size_t k = j + 1; k < count; ++k) {
          const auto plane =
              plane_through(round_.at(vertices[i]), round_.at(vertices[j]), round_.at(vertices[k]));
          if (plane && is_near(*plane, vertices) && move_to(*plane, group)) return true;
        }
      }
    }
    return false;
  }

  bool is_near(const RationalPlane& plane, const std::vector<VertexId>& vertices) {
    return std::ranges::all_of(vertices, [&](VertexId vertex) {
      return plane.square_from(round_.at(vertex)) <= farthest();
    });
  }
  /// The square of how far a vertex may move at a time.
  mpq_class farthest() const { return 9 * distance_ * distance_; }

  /// Moves all of the group that can be moved.
  bool move_to(const RationalPlane& plane, Group group) {
    for (;;) {
      Moves moves;
      std::set<std::uint32_t> members(group.begin(), group.end());
      std::erase_if(group, [&](std::uint32_t polygon) {
        return !find_moves(plane, polygon, members, moves);
      });
      if (group.empty()) return false;
      // Who stays is in the way of the others: its plane has to be kept.
      if (group.size() < members.size()) continue;
      for (auto& [vertex, to] : moves) round_.move(vertex, std::move(to));
      if (!moves.empty()) moved_.insert(group.begin(), group.end());
      return !moves.empty();
    }
  }

  bool find_moves(const RationalPlane& plane, std::uint32_t polygon,
                  const std::set<std::uint32_t>& members, Moves& moves) {
    for (const VertexId vertex : round_.outline(polygon)) {
      if (plane.holds(round_.at(vertex)) || moves.contains(vertex)) continue;
      auto to = place_for(plane, vertex, members);
      if (!to) return false;
      moves.emplace(vertex, *std::move(to));
    }
    return true;
  }

  std::optional<RationalPoint> place_for(const RationalPlane& plane, VertexId vertex,
                                         const std::set<std::uint32_t>& members) {
    const auto inputs = round_.inputs(vertex);
    if (std::ranges::any_of(inputs, [&](std::uint32_t i) { return pinned_.contains(i); })) {
      return std::nullopt;
    }
    const RationalPoint from = round_.at(vertex);
    if (plane.square_from(from) > farthest()) return std::nullopt;
    std::vector<RationalPlane> planes{plane};
    std::vector<VertexId> around;
    for (const std::uint32_t polygon : round_.polygons_at(vertex)) {
      const std::vector<VertexId> outline = round_.outline(polygon);
      around.insert(around.end(), outline.begin(), outline.end());
      if (members.contains(polygon) || is_free_triangle(polygon, outline.size())) continue;
      auto other = round_.plane_of(polygon);
      if (!other) continue;
      if (std::ranges::none_of(planes,
                               [&](const auto& known) { return known.is_same_as(*other); })) {
        planes.push_back(*std::move(other));
      }
    }
    std::vector<RationalPoint> on_all;
    const auto add_if_on_all = [&](const RationalPoint& point) {
      if (std::ranges::all_of(planes, [&](const auto& known) { return known.holds(point); }) &&
          std::ranges::find(on_all, point) == on_all.end()) {
        on_all.push_back(point);
      }
    };
    for (const RationalPoint& point : plane.points) add_if_on_all(point);
    for (const VertexId other : around) {
      if (other != vertex) add_if_on_all(round_.at(other));
    }
    auto to = decimal_point_on(planes, from, distance_, on_all);
    if (to && square_of(*to - from) > farthest()) return std::nullopt;
    return to;
  }

  /// A triangle is planar wherever its corners are, and free if nobody else is in its plane.
  bool is_free_triangle(std::uint32_t polygon, std::size_t corners) const {
    return corners <= 3 && is_alone(polygon);
  }
  /// Nobody else lies in its plane.
  bool is_alone(std::uint32_t polygon) const {
    if (moved_.contains(polygon)) return false;
    const auto plane = plane_id(round_.prepared(), polygon);
    return !plane || polygons_in_.at(*plane) == 1;
  }

  SnapRound& round_;
  const mpq_class& distance_;
  const std::set<std::uint32_t>& pinned_;
  std::map<PlaneId, std::size_t> polygons_in_;  // when the round began
  std::set<std::uint32_t> moved_;               // polygons that were brought to a plane
};

}  // namespace

std::size_t flatten_planes(SnapRound& round, const mpq_class& distance,
                           const std::set<std::uint32_t>& pinned) {
  const Intent intent =
      find_intent(round.scene(), round.prepared(), {.near = not_less_than(distance)});
  std::vector<std::uint32_t> bent;
  for (const BentPolygon& polygon : intent.bent) bent.push_back(polygon.polygon);
  Flattening flattening(round, distance, pinned);
  std::size_t planes = 0;
  for (const Group& group : groups_of(round.prepared(), intent.nearly_coplanar, bent)) {
    planes += flattening.flatten(group) ? 1 : 0;
  }
  return planes;
}

}  // namespace gnomon::scene_detail
