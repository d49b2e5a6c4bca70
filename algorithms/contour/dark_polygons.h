// SPDX-License-Identifier: LGPL-3.0-or-later
// Polygons that are wholly in shadow, found and proven before the others are walked along: they
// get no light, cast no border of a shadow on anything, and need not be met by anybody.
//
// Why they may all be left out at once: of the casters in a direction the nearest is not dark
// there, so that whatever a dark one hides is hidden by one that stays. Nothing that is seen on
// either side of a line changes.
//
// The proof is combinatorial. Let W be casters that are nearer than a polygon p wherever they
// overlap it. If every edge of each of W is, as far as it is inside p, covered on its outer side by
// others of W, then the union of W has no border inside p: it covers p, or nothing of it. So one
// point of p that is inside one of W is enough. An edge is covered where the polygon on its other
// side is one of W, or along the intervals in which it is inside others. All of these are the signs
// of input corners and the intervals of edge_survey.h; nothing is subtracted.
//
// W is found as it is needed, by asking who is above one point: first the middle of p, then a point
// beyond the uncovered part of an edge. That is a guess in doubles, which changes only whether a
// dark polygon is found.
#ifndef GNOMON_ALGORITHMS_CONTOUR_DARK_POLYGONS_H
#define GNOMON_ALGORITHMS_CONTOUR_DARK_POLYGONS_H

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/contour/edge_survey.h"
#include "algorithms/contour/light_charts.h"
#include "algorithms/contour/pair_search.h"
#include "algorithms/contour/stretches.h"

namespace gnomon {

/// What the proofs of all polygons of a light read.
class DarkScene {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// Requires: one chart.
  template <class Numbers>
  void make(const FacingPolygons<Numbers>& polygons, const LightCharts& charts,
            std::size_t edge_count, unsigned jobs);

  /// The box and the depths of a polygon.
  struct Seen {
    float low_u, low_v, high_u, high_v;
    DepthRange depth;
    std::uint32_t casts, unused;  // half a cache line
  };
  const Seen& seen(std::uint32_t polygon) const { return seen_[polygon]; }
  /// The polygon on the other side of an edge that two casters share; kNone of other edges.
  std::uint32_t across(PlaneRef edge) const { return owners_[2 * edge.index() + !edge.flipped()]; }

 private:
  std::vector<Seen> seen_;
  std::vector<std::uint32_t> owners_;  // by edge and direction: who has it, if it is shared
};

template <class Numbers>
void DarkScene::make(const FacingPolygons<Numbers>& polygons, const LightCharts& charts,
                     std::size_t edge_count, unsigned jobs) {
  const ChartBoxes& boxes = charts.charts()[0];
  seen_.resize(polygons.size());
  owners_.assign(2 * edge_count, kNone);
  in_parallel(jobs, polygons.size(), 1024, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const FacingPolygon& p = polygons.polygons[i];
      seen_[i] = {
          boxes.low_u[i], boxes.low_v[i], boxes.high_u[i], boxes.high_v[i], p.depth, p.casts, 0};
      for (std::uint32_t k = 0; k < p.count; ++k) {
        const PlaneRef edge = polygons.edge(p, k);
        // Of a shared edge each direction has one polygon.
        if (polygons.is_shared[p.first + k]) owners_[2 * edge.index() + edge.flipped()] = i;
      }
    }
  });
}

template <class Numbers, class Sides>
class DarkProof {
 public:
  using Survey = EdgeSurvey<Numbers, Sides>;

  DarkProof(const DarkScene& scene, const LightRays<Numbers>& light,
            const FacingPolygons<Numbers>& polygons, const LightCharts& charts,
            const PairSearch& pairs, Sides& sides, const Lanes& lanes)
      : scene_(&scene),
        light_(&light),
        polygons_(&polygons),
        charts_(&charts),
        pairs_(&pairs),
        lanes_(&lanes),
        survey_(light, polygons, sides, lanes) {}

  /// Whether polygon p is certainly dark; false of some that are.
  bool is_dark(std::uint32_t p);
  std::uint64_t filtered() const { return survey_.filtered(); }

 private:
  static constexpr std::size_t kMostMembers = 12;
  using Ray = Vector<double>;

  std::uint32_t caster_at(const Ray& ray) const;
  bool is_above(std::uint32_t w);
  bool join(std::uint32_t w);
  bool cover_edges(std::uint32_t w);
  bool cover_edge(std::uint32_t w, std::uint32_t k, unsigned left, unsigned right);
  void find_covers(std::uint32_t w, std::uint32_t k);
  Ray point_beyond(std::uint32_t w, std::uint32_t k, const Segment<Numbers>& part,
                   unsigned right) const;

  const DarkScene* scene_;
  const LightRays<Numbers>* light_;
  const FacingPolygons<Numbers>* polygons_;
  const LightCharts* charts_;
  const PairSearch* pairs_;
  const Lanes* lanes_;
  Survey survey_;
  std::uint32_t p_ = 0;
  std::vector<std::uint32_t> members_;  // W
  bool overlaps_ = false;               // one of W and p, for certain
  bool covered_ = false;                // one of W holds p
  std::vector<Stretch<Numbers>> covers_;
  std::vector<Segment<Numbers>> left_;
};

template <class Numbers, class Sides>
bool DarkProof<Numbers, Sides>::is_dark(std::uint32_t p) {
  p_ = p;
  members_.clear();
  overlaps_ = covered_ = false;
  const FacingPolygon& own = polygons_->polygons[p];
  if (own.count > 4) return false;
  Ray middle{0, 0, 0};
  for (std::uint32_t k = 0; k < own.count; ++k) {
    const Ray corner = polygons_->corner(own, k);
    for (int i = 0; i < 3; ++i) middle[i] += corner[i] / own.count;
  }
  const std::uint32_t first = caster_at(middle);
  if (first == DarkScene::kNone || !join(first)) return false;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!cover_edges(members_[i])) return false;
    if (covered_) return true;
  }
  return overlaps_;
}

/// The largest of the casters above p that hold a direction, by the doubles.
template <class Numbers, class Sides>
std::uint32_t DarkProof<Numbers, Sides>::caster_at(const Ray& ray) const {
  const auto [u, v] = charts_->place(ray);
  const float lowest = scene_->seen(p_).depth.low;
  const double depth = dot_product(light_->depths[polygons_->polygons[p_].plane], ray);
  float most = -1;
  std::uint32_t best = DarkScene::kNone;
  for (const std::uint32_t q : pairs_->neighbours(p_)) {
    const DarkScene::Seen& seen = scene_->seen(q);
    // One branch, which is seldom taken, instead of six that nobody can foresee.
    const bool may_hold = (seen.low_u <= u) & (u <= seen.high_u) & (seen.low_v <= v) &
                          (v <= seen.high_v) & (seen.depth.high > lowest);
    if (!may_hold || !seen.casts) continue;
    const float size = (seen.high_u - seen.low_u) * (seen.high_v - seen.low_v);
    if (size <= most) continue;
    const FacingPolygon& other = polygons_->polygons[q];
    if (other.count > 4) continue;
    const CornerSigns signs =
        lanes_->corner_signs(ray.data(), 0, polygons_->lines[other.block].x, 1);
    if ((signs.negative & 15) != 0) continue;
    if (!(dot_product(light_->depths[other.plane], ray) > depth)) continue;
    most = size;
    best = q;
  }
  return best;
}

/// Whether w is nearer than p wherever they overlap.
template <class Numbers, class Sides>
bool DarkProof<Numbers, Sides>::is_above(std::uint32_t w) {
  const DarkScene::Seen &mine = scene_->seen(p_), &its = scene_->seen(w);
  if (its.depth.low > mine.depth.high) return true;
  if (!(its.depth.high > mine.depth.low)) return false;
  const FacingPolygon &own = polygons_->polygons[p_], &other = polygons_->polygons[w];
  const unsigned all = (1u << own.count) - 1;
  CornerSet corners = survey_.find_nearer(w, p_);
  if (corners.left != 0) return false;
  if (corners.right == all) return true;
  // All of one are on the far side of the other's plane, or all of the other on the near one's.
  bool behind = corners.right != 0;
  bool holds = true;
  for (std::uint32_t j = 0; j < own.count && holds; ++j) {
    if (corners.right >> j & 1) continue;
    const int sign = survey_.nearer(w, p_, j, survey_.depth(w, p_, j));
    behind |= sign < 0;
    holds = sign <= 0;
  }
  if (holds) return behind;
  corners = survey_.find_nearer(p_, w);
  return corners.left == (1u << other.count) - 1;
}

template <class Numbers, class Sides>
bool DarkProof<Numbers, Sides>::join(std::uint32_t w) {
  if (std::find(members_.begin(), members_.end(), w) != members_.end()) return true;
  if (members_.size() == kMostMembers || polygons_->polygons[w].count > 4) return false;
  if (!scene_->seen(w).casts || !is_above(w)) return false;
  members_.push_back(w);
  return true;
}

template <class Numbers, class Sides>
bool DarkProof<Numbers, Sides>::cover_edges(std::uint32_t w) {
  const FacingPolygon& other = polygons_->polygons[w];
  const unsigned corners = (1u << polygons_->polygons[p_].count) - 1;
  const BlockSigns signs = survey_.block_signs(w, p_);
  unsigned inside = corners;  // corners of p inside of w
  bool some_right = false;
  for (std::uint32_t k = 0; k < other.count; ++k) {
    const unsigned left = signs.positive >> 4 * k & corners;
    if (left == 0) return true;  // beside p
    inside &= left;
    some_right |= (signs.negative >> 4 * k & corners) != 0;
  }
  if (!some_right) {
    covered_ = true;
    return true;
  }
  overlaps_ |= inside != 0;
  for (std::uint32_t k = 0; k < other.count; ++k) {
    const unsigned left = signs.positive >> 4 * k & corners;
    const unsigned right = signs.negative >> 4 * k & corners;
    if (right != 0 && !cover_edge(w, k, left, right)) return false;
  }
  return true;
}

template <class Numbers, class Sides>
bool DarkProof<Numbers, Sides>::cover_edge(std::uint32_t w, std::uint32_t k, unsigned left,
                                           unsigned right) {
  const FacingPolygon& other = polygons_->polygons[w];
  if (polygons_->is_shared[other.first + k]) {
    const std::uint32_t next = scene_->across(polygons_->edge(other, k));
    if (next != DarkScene::kNone && join(next)) return true;
  }
  Stretch<Numbers> inside;
  const LineThrough through = survey_.through_block(p_, left, right);
  if (!survey_.interval(w, k, p_, through, inside)) return true;
  const Segment<Numbers> whole{inside.low, inside.high, certainly_before(inside.low, inside.high)};
  overlaps_ |= whole.sure;
  for (;;) {
    find_covers(w, k);
    uncovered<Numbers>({&whole, 1}, covers_, left_);
    if (left_.empty()) return true;
    const std::uint32_t more = caster_at(point_beyond(w, k, left_.front(), right));
    const std::size_t before = members_.size();
    if (more == DarkScene::kNone || !join(more) || members_.size() == before) return false;
  }
}

/// The intervals of an edge of w in which others cover its outer side.
template <class Numbers, class Sides>
void DarkProof<Numbers, Sides>::find_covers(std::uint32_t w, std::uint32_t k) {
  covers_.clear();
  for (const std::uint32_t q : members_) {
    if (q == w) continue;
    const BlockSigns signs = survey_.block_signs(w, q);
    const LineThrough through =
        survey_.through_block(q, signs.positive >> 4 * k & 15u, signs.negative >> 4 * k & 15u);
    if (through.cover != LineCover::kBoth && through.cover != LineCover::kOuter) continue;
    Stretch<Numbers> stretch;
    if (survey_.interval(w, k, q, through, stretch)) covers_.push_back(stretch);
  }
}

/// A little beyond the middle of a part of an edge of w, inside p if p is convex.
template <class Numbers, class Sides>
auto DarkProof<Numbers, Sides>::point_beyond(std::uint32_t w, std::uint32_t k,
                                             const Segment<Numbers>& part, unsigned right) const
    -> Ray {
  constexpr double kBeyond = 0x1p-10;
  const FacingPolygon& other = polygons_->polygons[w];
  const Ray from = polygons_->corner(other, k);
  const Ray to = polygons_->corner(other, k + 1 == other.count ? 0 : k + 1);
  const Ray corner = polygons_->corner(polygons_->polygons[p_],
                                       static_cast<std::uint32_t>(std::countr_zero(right)));
  const double t = (part.low.t + part.high.t) / 2;
  Ray ray;
  for (int i = 0; i < 3; ++i) {
    const double on_edge = from[i] + t * (to[i] - from[i]);
    ray[i] = on_edge + kBeyond * (corner[i] - on_edge);
  }
  return ray;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_DARK_POLYGONS_H
