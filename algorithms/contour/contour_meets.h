// SPDX-License-Identifier: LGPL-3.0-or-later
// A polygon and its neighbours: who is on its edges, above or below. Bodies of contour_walk.h.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_MEETS_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_MEETS_H

#include <bit>
#include <utility>

#include "algorithms/contour/contour_walk.h"

namespace gnomon {

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::walk(std::uint32_t p, std::span<const std::uint32_t> neighbours) {
  constexpr std::size_t kAhead = 3;
  p_ = p;
  neighbours_ = neighbours;
  const std::uint32_t n = polygons_->polygons[p].count;
  if (lists_.size() < n) lists_.resize(n);
  for (std::uint32_t k = 0; k < n; ++k) lists_[k].clear();
  find_silent_edges();
  hidden_edges_ = 0;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    if (i + kAhead < neighbours.size()) polygons_->prefetch_corners(neighbours[i + kAhead]);
    if (dark_[neighbours[i]] == 0) meet(neighbours[i]);
  }
  if constexpr (Numbers::kCertified) {
    if (std::all_of(lists_.begin(), lists_.begin() + n,
                    [](const auto& lists) { return lists.hidden.empty(); })) {
      sums_[p].flags |= kHoldsLit | kOwnWhole;
    }
  }
  for (std::uint32_t k = 0; k < n; ++k) walk_edge(k);
}

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::find_silent_edges() {
  const FacingPolygon& own = polygons_->polygons[p_];
  if (silent_.size() < own.count) silent_.resize(own.count);
  all_edges_silent_ = true;
  silent_edges_ = 0x1111;
  for (std::uint32_t k = 0; k < own.count; ++k) {
    const std::uint8_t silent = own.casts ? polygons_->is_shared[own.first + k] : 1;
    silent_[k] = silent;
    all_edges_silent_ = all_edges_silent_ && silent != 0;
    if (silent == 0 && k < 4) silent_edges_ &= ~(1u << 4 * k);
  }
}

template <class Numbers, class Sides>
[[gnu::always_inline]] inline void ContourWalk<Numbers, Sides>::meet(std::uint32_t q) {
  const FacingPolygon& own = polygons_->polygons[p_];
  const DepthRange mine = own.depth, its = polygons_->polygons[q].depth;
  const bool below = its.high < mine.low, above = mine.high < its.low;
  if (!casts(q) && (above || !own.casts)) return;
  if (below && all_edges_silent_) return;
  order_ = below ? 1 : above ? -1 : 0;
  nearer_ = {};
  const bool in_block = own.count <= 4 && polygons_->polygons[q].count <= 4;
  if constexpr (Survey::kInBlocks) {
    if (in_block) {
      meet_block(q);
      return;
    }
  }
  if (!survey_.find_signs(p_, q)) {
    // They do not overlap, but may share a line: then the one that has no corner inside is the last
    // whose signs were found.
    if (casts(q) && !all_edges_silent_) meet_outside(q);
    return;
  }
  for (std::uint32_t k = 0; k < own.count; ++k) {
    if ((below && silent_[k]) || !survey_.may_go_through(k, q)) continue;
    const LineThrough through = survey_.through(p_, k, q);
    if (through.cover != LineCover::kNone) meet_on_edge(k, q, through);
  }
  if (order_ == 0 && casts(q)) crease(q);
}

// Whether the polygon that is met is behind all of p_, or before it, by the depths of p_'s corners.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::find_order(std::uint32_t q) {
  const std::uint32_t n = polygons_->polygons[p_].count;
  nearer_ = survey_.find_nearer(q, p_);
  const std::uint64_t all = ~std::uint64_t{0} >> (CornerSet::kMost - n);
  order_ = nearer_.left == all ? 1 : nearer_.right == all ? -1 : 0;
}

// As meet(), of two polygons of at most four corners.
template <class Numbers, class Sides>
[[gnu::always_inline]] inline void ContourWalk<Numbers, Sides>::meet_block(std::uint32_t q) {
  polygons_->prefetch_lines(q);
  const BlockSigns signs = survey_.block_signs(p_, q);
  const std::uint32_t n = polygons_->polygons[p_].count;
  const unsigned lines = 0x1111u >> 4 * (4 - n);
  const unsigned some_left = lines_with_any(signs.positive);
  bool overlaps = some_left == lines;
  if (!overlaps && (!casts(q) || all_edges_silent_)) return;
  // Where all corners are on one side, the polygon is beside the edge if two are on its line.
  const unsigned on_line = valid_signs(n, polygons_->polygons[q].count) &
                           ~static_cast<unsigned>(signs.positive | signs.negative);
  const unsigned along = lines_with_two(on_line);
  unsigned met = overlaps ? (some_left & lines_with_any(signs.negative)) | along : along;
  met &= ~hidden_edges_;
  // A silent edge is beside nobody, and casts nothing on what is below.
  if (!overlaps || order_ > 0) met &= ~silent_edges_;
  if (met == 0 && (!overlaps || order_ != 0)) return;
  if (order_ == 0) {
    // As the ground meets a wall.
    if (met == 0 && (!casts(q) || !survey_.sides_of_plane(q, p_).both())) return;
    find_order(q);
    if (order_ > 0) met &= ~silent_edges_;
  }
  if (met != 0 && !survey_.find_values(q, p_)) {
    if (!casts(q)) return;
    met &= along & ~silent_edges_;
    overlaps = false;
  }
  in_block_ = true;
  for (; met != 0; met &= met - 1) {
    const auto bit = static_cast<std::uint32_t>(std::countr_zero(met));
    const std::uint32_t k = bit / 4;
    const LineThrough through =
        survey_.through_block(q, signs.positive >> bit & 15u, signs.negative >> bit & 15u);
    if (through.cover == LineCover::kNone) continue;
    if (!overlaps && through.cover != LineCover::kOuter) continue;
    meet_on_edge(k, q, through);
  }
  in_block_ = false;
  if (overlaps && order_ == 0 && casts(q)) crease(q);
}

// A polygon wholly outside of an edge is beside the edge only if it has one on its line.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::meet_outside(std::uint32_t q) {
  for (std::uint32_t k = 0; k < polygons_->polygons[p_].count; ++k) {
    const LineThrough through = survey_.through(p_, k, q);
    if (through.cover == LineCover::kOuter && !silent_[k]) meet_on_edge(k, q, through);
    if (survey_.is_outside(k)) break;
  }
}

template <class Numbers, class Sides>
[[gnu::always_inline]] inline int ContourWalk<Numbers, Sides>::nearer_corner(std::uint32_t q,
                                                                             std::uint32_t j) {
  if (j < CornerSet::kMost) {
    if (nearer_.left >> j & 1) return 1;
    if (nearer_.right >> j & 1) return -1;
  }
  return survey_.nearer(q, p_, j, survey_.depth(q, p_, j));
}

// Of an edge that is hidden from end to end nothing more is asked for.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::hide(std::uint32_t k, const Stretch<Numbers>& stretch) {
  EdgeLists<Numbers>& lists = lists_[k];
  lists.hidden.push_back(stretch);
  if (stretch.low.name == PlaceName::from()) {
    if (lists.first.t < stretch.high.t) lists.first = stretch.high;
  } else if (!(stretch.high.name == PlaceName::to())) {
    return;
  }
  if (stretch.high.name == PlaceName::to() && stretch.low.t < lists.last.t) {
    lists.last = stretch.low;
  }
  if (certainly_no_gap(lists.first, lists.last)) hidden_edges_ |= k < 4 ? 1u << 4 * k : 0;
}

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::meet_on_edge(std::uint32_t k, std::uint32_t q,
                                               const LineThrough& through) {
  if (through.cover != LineCover::kBoth && !rules_.edges_on_a_line_count) return;
  const std::uint32_t next = k + 1 == polygons_->polygons[p_].count ? 0 : k + 1;
  Stretch<Numbers> stretch;
  int from = order_, to = order_;
  if (order_ == 0) {
    // Who is nearer may tell that nothing more is asked for, and costs less than the interval.
    if (!silent_[k] && !find_interval(k, q, through, stretch)) return;
    from = nearer_corner(q, k);
    to = nearer_corner(q, next);
    if (silent_[k]) {
      if (from >= 0 && to >= 0 && from + to > 0) return;
      if (!find_interval(k, q, through, stretch)) return;
    }
  } else if (!find_interval(k, q, through, stretch)) {
    return;
  }
  ++intervals_;
  EdgeLists<Numbers>& lists = lists_[k];
  if (from <= 0 && to <= 0 && from + to < 0) {
    if (!casts(q)) return;
    if (!rules_.casters_are_the_same_in_each_step && polygons_->polygons[q].reversed) return;
    if (through.cover == LineCover::kOuter) {
      lists.taken.push_back(stretch);
    } else {
      hide(k, stretch);
    }
    return;
  }
  Behind<Numbers> entry{stretch.low,
                        stretch.high,
                        survey_.depth(q, p_, k),
                        survey_.depth(q, p_, next),
                        survey_.depth_error(q, p_),
                        q,
                        through.cover == LineCover::kBoth};
  if (plane(q) == plane(p_)) {
    meet_in_plane(lists, q, through.cover, entry);
  } else if (from == 0 && to == 0) {
    meet_level(lists, k, q, through.cover, entry);
  } else if (from * to >= 0) {
    put(lists, through.cover, false, casts(q), entry);
  } else {
    // The edge goes through the plane of q.
    const PlaceOnEdge pierced = zero_between<Numbers>(
        survey_.depth_over(p_, q, k), survey_.depth_over(p_, q, next),
        Numbers::kCertified ? survey_.depth_over_error(p_, q) : 0, PlaceName::support(plane(q)));
    Behind<Numbers> before = entry, after = entry;
    before.high = earlier_of(stretch.high, pierced);
    after.low = later_of(stretch.low, pierced);
    if (shorten_cover(before.low, before.high))
      put(lists, through.cover, from < 0, casts(q), before);
    if (shorten_cover(after.low, after.high)) put(lists, through.cover, to < 0, casts(q), after);
  }
}

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::put(EdgeLists<Numbers>& lists, LineCover cover, bool other_above,
                                      bool other_casts, const Behind<Numbers>& entry) {
  if (other_above) {
    if (!other_casts) return;
    if (cover == LineCover::kOuter) {
      lists.taken.push_back({entry.low, entry.high});
    } else {
      lists.hidden.push_back({entry.low, entry.high});
    }
    return;
  }
  if (cover == LineCover::kInner || !casts(p_)) return;
  if (cover == LineCover::kOuter && !other_casts) return;
  lists.behind.push_back(entry);
}

// Polygons of one plane do not hide each other, but where another goes on beyond the edge, or has
// its own edge there, this one does not act.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::meet_in_plane(EdgeLists<Numbers>& lists, std::uint32_t q,
                                                LineCover cover, const Behind<Numbers>& entry) {
  if (!casts(q) || !casts(p_)) return;
  if (cover == LineCover::kOuter) {
    lists.beside.push_back(entry);
  } else if (cover == LineCover::kBoth || q < p_) {
    lists.taken.push_back({entry.low, entry.high});
  }
}

// As the survey has it; all corners that are not on the plane of q are on one side of it.
template <class Numbers, class Sides>
int ContourWalk<Numbers, Sides>::nearer_beside(std::uint32_t q) {
  if constexpr (Numbers::kCertified) {
    if (nearer_.left != 0) return 1;
    if (nearer_.right != 0) return -1;
  }
  return survey_.nearer_beside(q, p_);
}

// The edge lies in the plane of q: their slopes tell who is nearer on the inner side.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::meet_level(EdgeLists<Numbers>& lists, std::uint32_t k,
                                             std::uint32_t q, LineCover cover,
                                             const Behind<Numbers>& entry) {
  if (cover == LineCover::kOuter) {
    if (casts(q) && casts(p_)) lists.beside.push_back(entry);
  } else if ((rules_.equal_depth_by_its_planes ? nearer_beside(q)
                                               : survey_.nearer_by_far_corner(q, p_, k)) < 0) {
    if (casts(q)) lists.hidden.push_back({entry.low, entry.high});
  } else if (cover == LineCover::kBoth && casts(p_)) {
    lists.level.push_back(entry);
  }
}

// Of a silent edge, what is beside it is only looked for if its plane is another's, too.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::find_beside(std::uint32_t k) {
  lists_[k].beside.clear();
  const std::uint8_t silent = std::exchange(silent_[k], 0);
  for (const std::uint32_t q : neighbours_) {
    if (!casts(q) || dark_[q] != 0) continue;
    const LineThrough through = survey_.through_by_one(p_, k, q);
    order_ = 0;
    nearer_ = {};
    if (through.cover == LineCover::kOuter) meet_on_edge(k, q, through);
  }
  silent_[k] = silent;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_MEETS_H
