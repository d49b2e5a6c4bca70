// SPDX-License-Identifier: LGPL-3.0-or-later
// One edge: where it is seen, and from which polygons behind it takes what is in its shadow. Bodies
// of contour_walk.h.
#ifndef GNOMON_ALGORITHMS_CONTOUR_CONTOUR_ACTS_H
#define GNOMON_ALGORITHMS_CONTOUR_CONTOUR_ACTS_H

#include "algorithms/contour/contour_walk.h"

namespace gnomon {

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::walk_edge(std::uint32_t k) {
  EdgeLists<Numbers>& lists = lists_[k];
  const Segment<Numbers> whole{PlaceOnEdge::from(), PlaceOnEdge::to(), true};
  ContourSum<Numbers>& sum = sums_[p_];
  for (const Stretch<Numbers>& stretch : lists.hidden) {
    sum.flags |= certainly_before(stretch.low, stretch.high) ? kHoldsShadow : kPerhapsShadow;
  }
  if (lists.hidden.empty()) {
    seen_.assign(1, whole);
  } else {
    uncovered<Numbers>({&whole, 1}, lists.hidden, seen_);
  }
  if (!(sum.flags & kOwnWhole)) {
    for (const Segment<Numbers>& segment : seen_) add_own(k, segment);
  }
  if (!casts(p_) || seen_.empty()) return;
  if (lists.behind.empty() && lists.level.empty()) return;
  if (!lists.level.empty()) {
    if (silent_[k]) find_beside(k);
    for (const Behind<Numbers>& receiver : lists.level) act_level(k, receiver);
  }
  if (lists.behind.empty() || silent_[k]) return;
  // Below a caster that goes on from the edge, or through it, nothing is seen beside the edge.
  std::span<const Segment<Numbers>> free = seen_;
  if (!lists.taken.empty() || !lists.beside.empty() || !lists.level.empty()) {
    covers_ = lists.taken;
    for (const Behind<Numbers>& other : lists.beside) covers_.push_back({other.low, other.high});
    for (const Behind<Numbers>& other : lists.level) {
      if (casts(other.polygon)) covers_.push_back({other.low, other.high});
    }
    uncovered<Numbers>(seen_, covers_, free_);
    free = free_;
  }
  if (free.empty()) return;
  for (const Segment<Numbers>& segment : free) {
    if (segment.sure) {
      act_along(k, segment);
    } else {
      perhaps_at(k, segment.low, segment.high);
    }
  }
}

// A receiver whose plane holds the edge is seen beside the edge where no caster at the edge's depth
// is above it there.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::act_level(std::uint32_t k, const Behind<Numbers>& receiver) {
  const EdgeLists<Numbers>& lists = lists_[k];
  covers_ = lists.hidden;
  covers_.insert(covers_.end(), lists.taken.begin(), lists.taken.end());
  for (const auto* others : {&lists.beside, &lists.level}) {
    for (const Behind<Numbers>& other : *others) {
      if (casts(other.polygon) && is_above_outside(k, other.polygon, receiver.polygon)) {
        covers_.push_back({other.low, other.high});
      }
    }
  }
  const Segment<Numbers> whole{receiver.low, receiver.high,
                               certainly_before(receiver.low, receiver.high)};
  uncovered<Numbers>({&whole, 1}, covers_, free_);
  for (const Segment<Numbers>& segment : free_) {
    if (segment.sure) {
      take_from(k, receiver, segment.low, segment.high);
    } else {
      take_perhaps(k, receiver, segment.low, segment.high);
    }
  }
}

// Both planes hold edge k, so that one corner of q on the outer side tells.
template <class Numbers, class Sides>
bool ContourWalk<Numbers, Sides>::is_above_outside(std::uint32_t k, std::uint32_t q,
                                                   std::uint32_t than) {
  if (plane(q) == plane(than)) return false;
  T value;
  for (std::uint32_t j = 0; j < polygons_->polygons[q].count; ++j) {
    if (survey_.side(p_, k, q, j, value) >= 0) continue;
    const int sign = survey_.nearer(than, q, j, survey_.depth(than, q, j));
    if (sign != 0) return sign > 0;
  }
  return false;
}

// Goes along a seen segment, from one place where a polygon behind it begins or ends to the next.
// Places that may be in another order than their numbers are taken together: what happens from the
// least value of all of them to the greatest is open.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::act_along(std::uint32_t k, const Segment<Numbers>& segment) {
  const std::vector<Behind<Numbers>>& behind = lists_[k].behind;
  if (behind.size() == 1) {
    const Behind<Numbers>& only = behind.front();
    PlaceOnEdge low = later_of(only.low, segment.low), high = earlier_of(only.high, segment.high);
    if (certainly_before(low, high)) {
      if (only.covers_both) take_from(k, only, low, high);
    } else if (shorten(low, high)) {
      perhaps_at(k, low, high);
    }
    return;
  }
  find_events(k, segment);
  bool started = false;
  PlaceOnEdge at = segment.low;
  for (std::size_t begin = 0; begin < events_.size();) {
    const EventGroup group = group_of_events(begin);
    if (started) go_to(k, at, group.low);
    if (group.is_open) perhaps_at(k, group.low, group.high);
    at = group.high;
    bool ended = false;
    for (std::size_t i = begin; i < group.end; ++i) {
      const Event& event = events_[i];
      if (event.entry == kSegment) {
        (event.begins ? started : ended) = true;
      } else if (event.begins) {
        active_.push_back(event.entry);
      }
    }
    if (ended) return;
    for (std::size_t i = begin; i < group.end; ++i) {
      if (!events_[i].begins) std::erase(active_, events_[i].entry);
    }
    begin = group.end;
  }
}

// What begins and ends within a segment, and its own ends; what is there from its beginning is
// active at once.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::find_events(std::uint32_t k, const Segment<Numbers>& segment) {
  const std::vector<Behind<Numbers>>& behind = lists_[k].behind;
  active_.clear();
  events_.clear();
  events_.push_back({segment.low, kSegment, true});
  events_.push_back({segment.high, kSegment, false});
  for (std::uint32_t i = 0; i < behind.size(); ++i) {
    const PlaceOnEdge &low = behind[i].low, &high = behind[i].high;
    if (certainly_before(segment.high, low) || certainly_before(high, segment.low)) continue;
    if (certainly_before(low, segment.low) || is_same_place(low, segment.low)) {
      active_.push_back(i);
    } else {
      events_.push_back({low, i, true});
    }
    if (!certainly_before(segment.high, high) && !is_same_place(high, segment.high)) {
      events_.push_back({high, i, false});
    }
  }
  std::sort(events_.begin(), events_.end(), [](const Event& a, const Event& b) {
    const auto at_a = least_of(a.place), at_b = least_of(b.place);
    if (at_a != at_b) return at_a < at_b;
    return a.entry != b.entry ? a.entry < b.entry : a.begins > b.begins;
  });
}

// The events from one on that may be in another order, or are in one place.
template <class Numbers, class Sides>
auto ContourWalk<Numbers, Sides>::group_of_events(std::size_t begin) const -> EventGroup {
  const PlaceOnEdge& first = events_[begin].place;
  EventGroup group{first, first, begin + 1, false};
  auto reach = greatest_of(first);
  for (; group.end < events_.size(); ++group.end) {
    const PlaceOnEdge& place = events_[group.end].place;
    if (reach < least_of(place)) break;
    if (reach < greatest_of(place)) reach = greatest_of(place);
    if constexpr (Numbers::kCertified) {
      group.is_open = group.is_open || !is_same_place(first, place);
      if (place.name.is_blurred()) group.low.name = group.high.name = first.name.blurred();
    }
  }
  if constexpr (Numbers::kCertified) {
    if (group.is_open) {
      // The ends round by u, the sum that made them by as much.
      group.low = {least_of(first), 2.1 * Ball::kUnit, {}};
      group.high = {reach, 2.1 * Ball::kUnit, {}};
    }
  }
  return group;
}

// From one group of events to the next. The order of depths may change on the way.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::go_to(std::uint32_t k, PlaceOnEdge at, const PlaceOnEdge& next) {
  if (!certainly_before(at, next)) {
    if (!certainly_no_gap(at, next)) perhaps_at(k, at, next);
    return;
  }
  while (!active_.empty()) {
    PlaceOnEdge end = next;
    if (!piece(k, at, end)) perhaps_at(k, at, end);
    if (!(end.t < next.t)) break;
    at = end;
  }
}

// The first caster just after `low`. Where the order of two is not known, one that was passed over
// may yet be known to be before a later top: so all are compared again until none is.
template <class Numbers, class Sides>
auto ContourWalk<Numbers, Sides>::find_top(std::uint32_t k, const PlaceOnEdge& low,
                                           const PlaceOnEdge& high) -> const Behind<Numbers>* {
  const std::vector<Behind<Numbers>>& behind = lists_[k].behind;
  const Behind<Numbers>* top = nullptr;
  bool is_open = false, changed = true;
  for (std::size_t round = 0; changed && round < active_.size(); ++round) {
    changed = false;
    for (const std::uint32_t i : active_) {
      if (!casts(behind[i].polygon) || &behind[i] == top) continue;
      const int order = top == nullptr ? 1 : order_just_after(k, behind[i], *top, low, high);
      if (order > 0) {
        changed = is_open;
        top = &behind[i];
      }
      is_open = is_open || (order == 0 && plane(behind[i].polygon) != plane(top->polygon));
    }
  }
  return top;
}

// Between two places where nothing begins or ends. `high` comes nearer where the order changes.
// False: the two cannot be told apart.
template <class Numbers, class Sides>
bool ContourWalk<Numbers, Sides>::piece(std::uint32_t k, const PlaceOnEdge& low,
                                        PlaceOnEdge& high) {
  const std::vector<Behind<Numbers>>& behind = lists_[k].behind;
  if (active_.size() == 1) {
    const Behind<Numbers>& only = behind[active_.front()];
    if (only.covers_both) take_from(k, only, low, high);
    return true;
  }
  const Behind<Numbers>* top = find_top(k, low, high);
  if (top != nullptr) {
    for (const std::uint32_t i : active_) {
      if (&behind[i] != top) end_where_order_changes(behind[i], *top, low, high);
    }
    if (!certainly_before(low, high)) return false;
  }
  for (const std::uint32_t i : active_) {
    const Behind<Numbers>& entry = behind[i];
    if (!entry.covers_both && &entry != top) continue;
    if (top != nullptr && &entry != top && is_behind(k, entry, *top, low, high)) continue;
    if (entry.covers_both) take_from(k, entry, low, high);
  }
  return true;
}

/// Sign of the difference of two depths at a place; 0 if the bounds do not tell, or equal.
template <class Numbers, class Sides>
int ContourWalk<Numbers, Sides>::depth_order(const Behind<Numbers>& a, const Behind<Numbers>& b,
                                             const PlaceOnEdge& place) const {
  const T difference = depth_at(a, place) - depth_at(b, place);
  if constexpr (Numbers::kCertified) {
    // Each depth is off by its bound at both ends, and rounds by less than that in between.
    if (std::fabs(difference) <= 2 * (a.depth_error + b.depth_error)) return 0;
  }
  return sign_of_value(difference);
}

// 1 if caster a comes before caster b just after `low`, -1 if b does; 0: in one plane, or not
// known.
template <class Numbers, class Sides>
int ContourWalk<Numbers, Sides>::order_just_after(std::uint32_t k, const Behind<Numbers>& a,
                                                  const Behind<Numbers>& b, const PlaceOnEdge& low,
                                                  const PlaceOnEdge& high) {
  if (plane(a.polygon) == plane(b.polygon)) return 0;
  if (const int order = range_order(a.polygon, b.polygon); order != 0) return order;
  int order = depth_order(a, b, low);
  const int at_high = depth_order(a, b, high);
  if (order * at_high < 0 && !(low.t < passing(a, b, low, high).t)) order = 0;  // it just changed
  if (order == 0) order = at_high;
  if (order == 0) order = level_order(k, a.polygon, b.polygon);
  return order;
}

// Two polygons whose depths along the edge are not told apart: on its outer side.
template <class Numbers, class Sides>
int ContourWalk<Numbers, Sides>::level_order(std::uint32_t k, std::uint32_t a, std::uint32_t b) {
  if constexpr (Numbers::kCertified) {
    return known_order(a, b);
  } else {
    // Equal on the line n of the edge, two depths differ by a multiple of n, positive inside.
    const Vector<T> line = polygons_->line(polygons_->polygons[p_], k);
    return -sign_of_value(T(dot_product(light_->depths[plane(a)], line) -
                            dot_product(light_->depths[plane(b)], line)));
  }
}

// Of two polygons that do not pass through each other's planes, one is nearer wherever they
// overlap: 1 if a is, -1 if b is. 0: they may pass.
template <class Numbers, class Sides>
int ContourWalk<Numbers, Sides>::known_order(std::uint32_t a, std::uint32_t b) {
  const auto order_of = [&](std::uint32_t q, std::uint32_t other) {
    const auto sides = survey_.sides_of_plane(q, other);
    return sides.nearer == sides.behind ? 0 : sides.nearer ? 1 : -1;
  };
  if (const int order = order_of(a, b); order != 0) return order;
  return -order_of(b, a);
}

// Where two depths are equal that are not in the same order at `low` and at `high`.
template <class Numbers, class Sides>
auto ContourWalk<Numbers, Sides>::passing(const Behind<Numbers>& a, const Behind<Numbers>& b,
                                          const PlaceOnEdge& low, const PlaceOnEdge& high) const
    -> PlaceOnEdge {
  const PlaceOnEdge passes = zero_between<Numbers>(
      T(depth_at(a, low) - depth_at(b, low)), T(depth_at(a, high) - depth_at(b, high)),
      2 * (a.depth_error + b.depth_error), PlaceName());
  PlaceOnEdge place;
  place.t = low.t + passes.t * T(high.t - low.t);
  if constexpr (Numbers::kCertified) {
    place.error = passes.error * (high.t - low.t) + 4 * Ball::kUnit;
  }
  return place;
}

template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::end_where_order_changes(const Behind<Numbers>& entry,
                                                          const Behind<Numbers>& top,
                                                          const PlaceOnEdge& low,
                                                          PlaceOnEdge& high) {
  if (plane(entry.polygon) == plane(top.polygon)) return;
  if (range_order(entry.polygon, top.polygon) != 0) return;
  if (depth_order(entry, top, low) * depth_order(entry, top, high) >= 0) return;
  const PlaceOnEdge end = passing(entry, top, low, high);
  if (low.t < end.t && end.t < high.t) high = end;
}

// Whether an entry is behind the first caster all along; equal planes are not. Where they touch at
// an end within the bounds there may be a sliver; where they do all along, both are open.
template <class Numbers, class Sides>
bool ContourWalk<Numbers, Sides>::is_behind(std::uint32_t k, const Behind<Numbers>& entry,
                                            const Behind<Numbers>& top, const PlaceOnEdge& low,
                                            const PlaceOnEdge& high) {
  if (plane(entry.polygon) == plane(top.polygon)) return false;
  if (const int order = range_order(entry.polygon, top.polygon); order != 0) return order < 0;
  const int at_low = depth_order(entry, top, low), at_high = depth_order(entry, top, high);
  if (at_low == at_high && at_low != 0) return at_low < 0;
  const int known = level_order(k, entry.polygon, top.polygon);
  if constexpr (!Numbers::kCertified) {
    const int halfway = sign_of_value(T(T(depth_at(entry, low) - depth_at(top, low)) +
                                        T(depth_at(entry, high) - depth_at(top, high))));
    return halfway != 0 ? halfway < 0 : known < 0;
  }
  if (known != 0) return known < 0;
  if (at_low + at_high == 0) {
    sums_[entry.polygon].flags |= kContourOpen;
    sums_[top.polygon].flags |= kContourOpen;
    return at_low <= 0;
  }
  take_perhaps(k, entry, low, high);
  take_perhaps(k, top, low, high);
  return at_low + at_high < 0;
}

// A sliver between two places may be there: it may be taken from whatever is first there.
template <class Numbers, class Sides>
void ContourWalk<Numbers, Sides>::perhaps_at(std::uint32_t k, const PlaceOnEdge& low,
                                             const PlaceOnEdge& high) {
  if constexpr (Numbers::kCertified) {
    const std::vector<Behind<Numbers>>& behind = lists_[k].behind;
    const Behind<Numbers>* cover = nullptr;  // certainly there
    for (const Behind<Numbers>& entry : behind) {
      if (casts(entry.polygon) && certainly_before(entry.low, low) &&
          certainly_before(high, entry.high) &&
          (cover == nullptr || depth_order(entry, *cover, low) > 0)) {
        cover = &entry;
      }
    }
    for (const Behind<Numbers>& entry : behind) {
      if (!entry.covers_both || certainly_before(high, entry.low) ||
          certainly_before(entry.high, low)) {
        continue;
      }
      if (cover != nullptr && &entry != cover && depth_order(entry, *cover, low) < 0 &&
          depth_order(entry, *cover, high) < 0) {
        continue;
      }
      take_perhaps(k, entry, low, high);
    }
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_CONTOUR_ACTS_H
