// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/ridge_edges/ridge_arcs.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <unordered_map>
#include <utility>

#include "scene/base/vectors.h"
#include "scene/geometry/box_tree.h"

namespace gnomon {

namespace {

using scene_detail::Box;
using scene_detail::BoxTree;

constexpr std::uint32_t kNone = RidgeEdge::kNone;

/// What runs along one edge: facing parts either way, and all parts.
struct EdgeUse {
  std::int32_t sum = 0;
  std::vector<std::pair<std::uint32_t, bool>> facing;  // part, and whether it runs from b to a
  std::vector<std::uint32_t> others;
};

DirectionVector grid_point(const Geometry& geometry, VertexId vertex) {
  return {geometry.grid.at(vertex, 0), geometry.grid.at(vertex, 1), geometry.grid.at(vertex, 2)};
}

/// Positive if `point` is in front of the part's facing side.
Sign side_of_part(const PreparedScene& scene, const Part& part, Side facing, VertexId point) {
  const SupportTriple& plane = scene.geometry.planes[part.plane];
  const DirectionVector a = grid_point(scene.geometry, plane.a);
  const DirectionVector normal = cross(minus(grid_point(scene.geometry, plane.b), a),
                                       minus(grid_point(scene.geometry, plane.c), a));
  const Sign sign = sign_of(mpz_class(dot(normal, minus(grid_point(scene.geometry, point), a))));
  return part.flipped == (facing == Side::kFront) ? -sign : sign;
}

/// A vertex of the part that is not on the edge; all of them are on one side of its neighbours'
/// planes.
VertexId apart_from(const PreparedScene& scene, const Part& part, EdgeEnds edge) {
  const auto loop = scene.loop(part);
  return *std::ranges::find_if(loop, [&](VertexId v) { return v != edge.a && v != edge.b; });
}

void classify(const PreparedScene& scene, const EdgeUse& use, std::span<const Side> facing,
              RidgeEdge& ridge) {
  if (use.others.empty()) {
    ridge.kind = RidgeKind::kBorder;
    return;
  }
  ridge.hidden = use.others.front();
  const Part& hidden = scene.parts[ridge.hidden];
  const VertexId vertex = apart_from(scene, hidden, scene.geometry.edges[ridge.edge.index()]);
  const Sign sign = side_of_part(scene, scene.parts[ridge.facing], facing[ridge.facing], vertex);
  ridge.kind = sign == Sign::kPositive ? RidgeKind::kHidden : RidgeKind::kVisible;
}

/// The box of an arc on the unit sphere: of its ends, and as much more as it bulges out of its
/// chord.
Box box_of(const FilteredVector& from, const FilteredVector& to) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    square += (from.nearest[k] - to.nearest[k]) * (from.nearest[k] - to.nearest[k]);
  }
  constexpr double kRounding = 1e-12;
  const double bulge = 1 - std::sqrt(std::max(0.0, 1 - square / 4)) + kRounding;
  Box box = Box::empty();
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = std::minmax(from.nearest[static_cast<std::size_t>(k)],
                                         to.nearest[static_cast<std::size_t>(k)]);
    box.add(k, low - bulge, high + bulge);
  }
  return box;
}

/// Positive if d is to the left of the plane of a, b, c, seen from where these are clockwise.
Sign orientation(const Geometry& geometry, VertexId a, VertexId b, VertexId c, VertexId d) {
  const DirectionVector origin = grid_point(geometry, a);
  return sign_of(mpz_class(
      dot(cross(minus(grid_point(geometry, b), origin), minus(grid_point(geometry, c), origin)),
          minus(grid_point(geometry, d), origin))));
}

}  // namespace

std::uint32_t RayTable::of(const DirectionVector& direction) {
  DirectionVector own = primitive(direction);
  const auto [place, is_new] = places_.try_emplace(own, static_cast<std::uint32_t>(rays_.size()));
  if (is_new) rays_.emplace_back(std::move(own));
  return place->second;
}

std::vector<RidgeEdge> ridge_edges_of(const PreparedScene& scene,
                                      std::span<const std::uint32_t> parts,
                                      std::span<const Side> facing) {
  std::map<EdgeId, EdgeUse> uses;
  for (const std::uint32_t index : parts) {
    const Part& part = scene.parts[index];
    if (!part.casts) continue;
    const bool faces = facing[index] != Side::kOn;
    const bool turned = facing[index] == Side::kBack;
    for (const PlaneRef edge : scene.edges(part)) {
      EdgeUse& use = uses[edge.index()];
      if (!faces) {
        use.others.push_back(index);
        continue;
      }
      const bool from_b = edge.flipped() != turned;
      use.sum += from_b ? -1 : 1;
      use.facing.emplace_back(index, from_b);
    }
  }
  std::vector<RidgeEdge> ridges;
  for (const auto& [edge, use] : uses) {
    if (use.sum == 0) continue;
    RidgeEdge ridge;
    ridge.edge = PlaneRef(edge, use.sum < 0);
    ridge.facing = std::ranges::find(use.facing, use.sum < 0, [](const auto& one) {
                     return one.second;
                   })->first;
    classify(scene, use, facing, ridge);
    // As often as more facing parts run along it this way than the other.
    ridges.insert(ridges.end(), static_cast<std::size_t>(std::abs(use.sum)), ridge);
  }
  return ridges;
}

RidgeArcs::RidgeArcs(const PreparedScene& scene, std::span<const FilteredVector> directions,
                     std::span<const RidgeEdge> edges)
    : directions_(directions), cuts_(edges.size()) {
  arcs_.reserve(edges.size());
  for (const RidgeEdge& edge : edges) {
    const EdgeEnds ends = scene.geometry.edges[edge.edge.index()];
    RidgeArc& arc = arcs_.emplace_back();
    arc.from = edge.edge.flipped() ? ends.b : ends.a;
    arc.to = edge.edge.flipped() ? ends.a : ends.b;
    arc.from_ray = table_.of(directions[arc.from].exact);
    arc.to_ray = table_.of(directions[arc.to].exact);
    arc.normal = FilteredVector(cross(directions[arc.from].exact, directions[arc.to].exact));
  }
}

bool RidgeArcs::cut(const PreparedScene& scene, RidgeLoops& loops,
                    const std::atomic<bool>* interrupted) {
  std::vector<Box> boxes;
  boxes.reserve(arcs_.size());
  for (const RidgeArc& arc : arcs_) {
    boxes.push_back(box_of(directions_[arc.from], directions_[arc.to]));
  }
  const BoxTree tree(boxes);
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < arcs_.size(); ++i) {
    if (interrupted != nullptr && interrupted->load(std::memory_order_relaxed)) return false;
    near.clear();
    tree.for_each_that_meets(boxes[i], [&](std::uint32_t j) {
      if (j > i) near.push_back(j);
    });
    std::ranges::sort(near);  // so that nothing depends on the tree
    loops.pairs += near.size();
    for (const std::uint32_t j : near) cut_pair(scene, i, j, loops);
  }
  return true;
}

/// `of_end`: the side of the arc's plane that the end of another is on.
void RidgeArcs::cut_by_end(std::uint32_t arc, VertexId vertex, std::uint32_t ray, Sign of_end) {
  const RidgeArc& own = arcs_[arc];
  if (of_end != Sign::kZero || ray == own.from_ray || ray == own.to_ray) return;
  const DirectionVector& x = directions_[vertex].exact;
  const auto inside = [&](const DirectionVector& from, const DirectionVector& to) {
    return dot(cross(from, to), own.normal.exact) > 0;
  };
  if (inside(directions_[own.from].exact, x) && inside(x, directions_[own.to].exact)) {
    cuts_[arc].push_back(ray);
  }
}

void RidgeArcs::cut_pair(const PreparedScene& scene, std::uint32_t first, std::uint32_t second,
                         RidgeLoops& loops) {
  const RidgeArc &e = arcs_[first], &f = arcs_[second];
  const Sign f_from = side(e.normal, directions_[f.from]), f_to = side(e.normal, directions_[f.to]);
  if (f_from == f_to && f_from != Sign::kZero) return;
  const Sign e_from = side(f.normal, directions_[e.from]), e_to = side(f.normal, directions_[e.to]);
  cut_by_end(first, f.from, f.from_ray, f_from);
  cut_by_end(first, f.to, f.to_ray, f_to);
  cut_by_end(second, e.from, e.from_ray, e_from);
  cut_by_end(second, e.to, e.to_ray, e_to);
  // f comes from the right of e and e leaves f on its right, or both the other way round; anything
  // else misses, or meets in the direction away from the light.
  const bool crosses = f_to != Sign::kZero && f_to == e_from && f_from == -f_to && e_to == -f_to;
  if (!crosses) return;
  DirectionVector x = cross(e.normal.exact, f.normal.exact);
  if (f_to == Sign::kNegative) {
    for (mpz_class& c : x) c = -c;
  }
  const std::uint32_t ray = table_.of(x);
  cuts_[first].push_back(ray);
  cuts_[second].push_back(ray);
  const Sign order = orientation(scene.geometry, e.from, e.to, f.from, f.to);
  std::uint32_t nearer = PseudoIntersection::kTouch;
  if (order != Sign::kZero) nearer = order == f_to ? first : second;
  loops.crossings.push_back({first, second, nearer, ray});
}

bool RidgeArcs::meet_in_space(const PreparedScene& scene, std::uint32_t first, std::uint32_t second,
                              std::uint32_t ray) const {
  const RidgeArc &e = arcs_[first], &f = arcs_[second];
  const auto end_at = [&](const RidgeArc& arc) -> std::optional<VertexId> {
    if (ray == arc.from_ray) return arc.from;
    if (ray == arc.to_ray) return arc.to;
    return std::nullopt;
  };
  const auto e_end = end_at(e), f_end = end_at(f);
  if (e_end && f_end) return *e_end == *f_end;
  // Lines of one plane meet, and where that plane does not hold the light, on this ray.
  return !is_zero(cross(e.normal.exact, f.normal.exact)) &&
         orientation(scene.geometry, e.from, e.to, f.from, f.to) == Sign::kZero;
}

std::vector<Stretch> RidgeArcs::stretches(std::uint64_t& cancelled) const {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Stretch>> by_ends;
  std::vector<std::uint32_t> along;
  for (std::uint32_t i = 0; i < arcs_.size(); ++i) {
    const RidgeArc& arc = arcs_[i];
    along = cuts_[i];
    std::ranges::sort(along);
    along.erase(std::unique(along.begin(), along.end()), along.end());
    std::ranges::sort(along, [&](std::uint32_t a, std::uint32_t b) {
      return dot(cross(rays()[a].exact, rays()[b].exact), arc.normal.exact) > 0;
    });
    along.push_back(arc.to_ray);
    std::uint32_t from = arc.from_ray;
    for (const std::uint32_t to : along) {
      by_ends[std::minmax(from, to)].push_back({from, to, i, 0});
      from = to;
    }
  }
  std::vector<Stretch> result;
  for (auto& [ends, own] : by_ends) {
    // Those of the two directions cancel, one by one; what is left runs one way.
    const auto forward =
        static_cast<std::size_t>(std::ranges::count(own, ends.first, &Stretch::from_ray));
    const std::size_t both = std::min(forward, own.size() - forward);
    cancelled += both;
    const bool is_forward = 2 * forward > own.size();
    std::size_t skip = both;
    std::uint32_t inner = 0;
    for (Stretch& stretch : own) {
      if ((stretch.from_ray == ends.first) != is_forward) continue;
      if (skip > 0) {
        --skip;
        continue;
      }
      stretch.inner = inner++;
      result.push_back(stretch);
    }
  }
  return result;
}

}  // namespace gnomon
