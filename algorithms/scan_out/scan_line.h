// SPDX-License-Identifier: LGPL-3.0-or-later
// The primary scan (Bouknight & Kelley, as Crow 1977 tells of it): polygons wait in buckets by the
// first row that may show them, are active until the last, and begin and end at events of each row.
// Between two events the same polygons cover every sample; the nearest at the first sample is seen
// until another comes in front of it, by one change of a sign.
//
// Of coplanar parts the one of the smallest index is seen. Exactness: that of the space.
#ifndef GNOMON_ALGORITHMS_SCAN_OUT_SCAN_LINE_H
#define GNOMON_ALGORITHMS_SCAN_OUT_SCAN_LINE_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/part_balls.h"
#include "algorithms/pixels/visible_row.h"

namespace gnomon {

template <ImageSpaceModel Space>
class ScanLine {
 public:
  ScanLine(ImageScene<Space>& scene, const PartBalls& balls, std::uint32_t rows)
      : scene_(scene), buckets_(rows), last_row_(scene.scene().parts.size(), 0) {
    for (std::uint32_t p = 0; p < scene.scene().parts.size(); ++p) {
      if (!scene.facing_eye(p).valid()) continue;
      std::uint32_t first = 0, end = rows;
      while (first < end && balls.misses_row(p, first)) ++first;
      while (end > first && balls.misses_row(p, end - 1)) --end;
      if (first == end) continue;
      buckets_[first].push_back(p);
      last_row_[p] = end - 1;
    }
  }

  /// Requires: rows ascend from call to call, and nothing is drawn in the row.
  void draw_row(std::uint32_t row, std::span<std::uint32_t> seen, WorkCounts& work) {
    for (; next_bucket_ <= row; ++next_bucket_) {
      const auto& bucket = buckets_[next_bucket_];
      active_.insert(active_.end(), bucket.begin(), bucket.end());
    }
    std::erase_if(active_, [&](std::uint32_t part) { return last_row_[part] < row; });
    find_events(row, work);
    covering_.clear();
    for (std::size_t i = 0; i < events_.size();) {
      const std::uint32_t column = events_[i].column;
      for (; i < events_.size() && events_[i].column == column; ++i) take(events_[i]);
      if (i < events_.size() && !covering_.empty()) {
        draw_between({column, events_[i].column}, row, seen, work);
      }
    }
  }

  /// Pairs of a sample and a part that covers it, so far.
  std::uint64_t covered() const { return covered_; }

 private:
  struct Event {
    std::uint32_t column = 0, part = 0;
    bool begins = false;
  };

  void find_events(std::uint32_t row, WorkCounts& work) {
    events_.clear();
    for (const std::uint32_t part : active_) {
      const Span span = covered_span(scene_, part, row);
      if (span.empty()) continue;
      ++work[Counter::kSpans];
      covered_ += span.size();
      events_.push_back({span.begin, part, true});
      events_.push_back({span.end, part, false});
    }
    work[Counter::kEvents] += events_.size();
    std::ranges::sort(events_, {}, &Event::column);
  }
  void take(const Event& event) {
    if (event.begins) {
      covering_.push_back(event.part);
    } else {
      std::erase(covering_, event.part);
    }
  }

  /// The same parts cover all of the span.
  void draw_between(Span span, std::uint32_t row, std::span<std::uint32_t> seen, WorkCounts& work) {
    while (!span.empty()) {
      const std::uint32_t nearest = nearest_at(span.begin, row, work);
      const std::uint32_t end = end_of(nearest, span, row, work);
      std::fill(seen.begin() + span.begin, seen.begin() + end, nearest);
      span.begin = end;
    }
  }
  std::uint32_t nearest_at(std::uint32_t column, std::uint32_t row, WorkCounts& work) {
    std::uint32_t nearest = covering_.front();
    for (const std::uint32_t other : covering_) {
      if (other == nearest) continue;
      const PlaneRef own = scene_.facing_eye(nearest), plane = scene_.facing_eye(other);
      if (plane.same_plane(own)) {
        nearest = std::min(nearest, other);
        continue;
      }
      ++work[Counter::kDepthTests];
      // What is seen of the one lies behind the other where it is on the other side of its plane.
      if (scene_.space().side_at_sample(plane, own, {column, row}) == Sign::kNegative) {
        nearest = other;
      }
    }
    return nearest;
  }
  /// Where another part comes in front of the nearest one, or the span ends.
  std::uint32_t end_of(std::uint32_t nearest, Span span, std::uint32_t row, WorkCounts& work) {
    const PlaneRef own = scene_.facing_eye(nearest);
    for (const std::uint32_t other : covering_) {
      const PlaneRef plane = scene_.facing_eye(other);
      if (span.size() == 1) break;
      if (plane.same_plane(own)) continue;
      ++work[Counter::kDepthTests];
      const Span nearer = part_on_side(scene_.space(), span, plane, own, row, Sign::kNegative);
      // On rounded kernels it may seem nearer at the first sample, too, where it was not before.
      if (!nearer.empty() && nearer.begin > span.begin) span.end = nearer.begin;
    }
    return span.end;
  }

  ImageScene<Space>& scene_;
  std::vector<std::vector<std::uint32_t>> buckets_;  // parts by the first row that may show them
  std::vector<std::uint32_t> last_row_;              // by part
  std::uint32_t next_bucket_ = 0;
  std::vector<std::uint32_t> active_;    // parts that may be in this row
  std::vector<Event> events_;            // of this row
  std::vector<std::uint32_t> covering_;  // parts between the last event and the next
  std::uint64_t covered_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SCAN_OUT_SCAN_LINE_H
