// SPDX-License-Identifier: LGPL-3.0-or-later
// Crow's shortcut: shadow polygons are kept in one list by depth, each put in where it is first
// met; "once it is discovered which shadow polygons bound the currently visible surface (in depth)
// then only those polygons need be checked". It rests on the claim that shadow polygons of one
// light never meet but in their edges, so that the list stays in order along the row. The walls of
// two casters do meet; so the shortcut is measured here, and never trusted.
#ifndef GNOMON_ALGORITHMS_SHADOW_POLYGONS_NEIGHBOUR_ORDER_H
#define GNOMON_ALGORITHMS_SHADOW_POLYGONS_NEIGHBOUR_ORDER_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/pixels/visible_row.h"
#include "algorithms/shadow_polygons/shadow_surface.h"

namespace gnomon {

template <ImageSpaceModel Space>
class NeighbourOrder {
 public:
  explicit NeighbourOrder(Space& space) : space_(space) {}

  void start_row(std::uint32_t row) {
    row_ = row;
    list_.clear();
    next_ = 0;
  }

  /// The change of the count from the eye to the part of plane `on`, into counts[0 ...
  /// span.size()). Requires: spans of a row come from left to right; `crossed` is what the rays of
  /// the row come through, by first columns.
  void count(std::span<const CrossedSurface> crossed, PlaneRef on, Span span,
             std::span<std::int32_t> counts, WorkCounts& work) {
    std::vector<std::uint32_t> stops{span.end};
    for (const CrossedSurface& one : crossed) {
      for (const std::uint32_t column : {one.span.begin, one.span.end}) {
        if (column > span.begin && column < span.end) stops.push_back(column);
      }
    }
    std::ranges::sort(stops);
    std::uint32_t begin = span.begin;
    for (const std::uint32_t stop : stops) {
      if (stop == begin) continue;
      renew_list(crossed, begin);
      count_stretch(on, {begin, stop}, counts.subspan(begin - span.begin), work);
      begin = stop;
    }
  }

 private:
  /// Takes out what ends before the column, and puts in what has begun, where it is there.
  void renew_list(std::span<const CrossedSurface> crossed, std::uint32_t column) {
    std::erase_if(list_, [&](const CrossedSurface* one) { return one->span.end <= column; });
    for (; next_ < crossed.size() && crossed[next_].span.begin <= column; ++next_) {
      const CrossedSurface& one = crossed[next_];
      if (one.span.end <= column) continue;
      const auto place = std::ranges::find_if(list_, [&](const CrossedSurface* other) {
        return is_before(space_, one.surface, other->surface, {column, row_});
      });
      list_.insert(place, &one);
    }
  }

  /// Of columns in which rays come through all of the list.
  void count_stretch(PlaneRef on, Span stretch, std::span<std::int32_t> counts, WorkCounts& work) {
    const auto is_before_part = [&](std::size_t k, std::uint32_t i) {
      ++work[Counter::kNeighbourTests];
      const ShadowSurface& one = list_[k]->surface;
      return space_.side_at_sample(one.plane, on, {i, row_}) == -one.eye_side;
    };
    std::size_t before = 0;  // so many of the list
    std::int32_t sum = 0;
    for (std::uint32_t i = stretch.begin; i < stretch.end;) {
      while (before < list_.size() && is_before_part(before, i)) {
        sum += list_[before++]->surface.change;
      }
      while (before > 0 && !is_before_part(before - 1, i)) sum -= list_[--before]->surface.change;
      std::uint32_t end = stretch.end;
      for (const std::size_t k : {before - 1, before}) {
        if (k >= list_.size()) continue;
        const PlaneRef plane = list_[k]->surface.plane;
        const bool is_before_now = k < before;
        const Span same = part_where(
            Span{i, end}, [&](std::uint32_t c) { return is_before_part(k, c) == is_before_now; },
            space_.guess_side(plane, on, row_));
        end = std::max(same.end, i + 1);
      }
      std::fill(counts.begin() + (i - stretch.begin), counts.begin() + (end - stretch.begin), sum);
      i = end;
    }
  }

  Space& space_;
  std::uint32_t row_ = 0;
  std::vector<const CrossedSurface*> list_;  // by depth, as far as the claim holds
  std::size_t next_ = 0;                     // the first that was not met yet
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_POLYGONS_NEIGHBOUR_ORDER_H
