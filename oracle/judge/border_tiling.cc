// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/judge/border_tiling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace gnomon::oracle {

namespace {

constexpr long double kMostCells = 0x1p60L;

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  std::uint64_t hash = a * 0x9e3779b97f4a7c15ull;
  hash = (hash ^ (hash >> 29)) + b * 0xbf58476d1ce4e5b9ull;
  return hash ^ (hash >> 32);
}

long double distance(const PlanarPoint& a, const PlanarPoint& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// Vertices that are all but one as one: the first.
class Places {
 public:
  Places(const PlanarPoint& low, long double snap) : low_(low), snap_(snap) {}

  std::uint32_t at(const PlanarPoint& point) {
    const std::int64_t x = cell(point.x - low_.x), y = cell(point.y - low_.y);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        const auto found = cells_.find(key(i, j));
        if (found == cells_.end()) continue;
        for (std::uint32_t place = found->second; place != kNone; place = next_[place]) {
          const PlanarPoint& own = places_[place];
          if (std::fabs(own.x - point.x) <= snap_ && std::fabs(own.y - point.y) <= snap_) {
            return place;
          }
        }
      }
    }
    const auto place = static_cast<std::uint32_t>(places_.size());
    places_.push_back(point);
    const auto [head, made] = cells_.try_emplace(key(x, y), place);
    next_.push_back(made ? kNone : std::exchange(head->second, place));
    return place;
  }
  const PlanarPoint& operator[](std::uint32_t place) const { return places_[place]; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::int64_t cell(long double offset) const {
    return static_cast<std::int64_t>(std::floor(offset / snap_));
  }
  /// Cells of one key are looked at together: a place is taken by its distance alone.
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return mixed(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y));
  }

  PlanarPoint low_;
  long double snap_;
  std::vector<PlanarPoint> places_;
  std::vector<std::uint32_t> next_;  // of the same key
  std::unordered_map<std::uint64_t, std::uint32_t> cells_;
};

/// Directed edges between places, each with how often it is there: forward less backward.
class Edges {
 public:
  void add(std::uint32_t from, std::uint32_t to, int count) {
    if (from == to) return;
    counts_[key(from, to)] += from < to ? count : -count;
  }
  bool cancel() const {
    return std::ranges::all_of(counts_, [](const auto& edge) { return edge.second == 0; });
  }
  struct Edge {
    std::uint32_t from = 0, to = 0;
    int count = 0;
  };
  std::vector<Edge> left() const {
    std::vector<Edge> edges;
    for (const auto& [ends, count] : counts_) {
      if (count != 0) {
        edges.push_back(
            {static_cast<std::uint32_t>(ends >> 32), static_cast<std::uint32_t>(ends), count});
      }
    }
    return edges;
  }
  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
  }

 private:
  std::unordered_map<std::uint64_t, int> counts_;
};

/// Places in a raster, to find those near an edge.
class Raster {
 public:
  Raster(const Places& places, const std::vector<std::uint32_t>& chosen) : places_(places) {
    PlanarLoop points;
    for (const std::uint32_t place : chosen) points.push_back(places[place]);
    box_ = box_of(points);
    side_ = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::sqrt(static_cast<double>(chosen.size()))));
    cells_.resize(side_ * side_);
    for (const std::uint32_t place : chosen) {
      const PlanarPoint& point = places[place];
      cells_[row(point.y) * side_ + column(point.x)].push_back(place);
    }
  }

  /// Calls for all places within `margin` of a segment, and some others.
  void near(const PlanarPoint& a, const PlanarPoint& b, long double margin,
            const std::function<void(std::uint32_t)>& visit) const {
    const auto [left, right] = a.x < b.x ? std::pair(a, b) : std::pair(b, a);
    const std::size_t first = column(left.x - margin), last = column(right.x + margin);
    const long double slope = right.x > left.x ? (right.y - left.y) / (right.x - left.x) : 0;
    for (std::size_t c = first; c <= last; ++c) {
      // What of the segment, and a column more, is above the column.
      long double low = std::min(left.y, right.y), high = std::max(left.y, right.y);
      if (right.x > left.x) {
        const long double wide = (box_.high.x - box_.low.x) / static_cast<long double>(side_);
        const auto at = [&](long double x) {
          return left.y + slope * (std::clamp(x, left.x, right.x) - left.x);
        };
        const long double start = box_.low.x + static_cast<long double>(c) * wide;
        const long double y0 = at(start - wide - margin), y1 = at(start + 2 * wide + margin);
        low = std::min(y0, y1);
        high = std::max(y0, y1);
      }
      for (std::size_t r = row(low - margin); r <= row(high + margin); ++r) {
        for (const std::uint32_t place : cells_[r * side_ + c]) visit(place);
      }
    }
  }

 private:
  std::size_t index(long double at, long double low, long double high) const {
    if (!(high > low)) return 0;
    const long double cell = (at - low) / (high - low) * static_cast<long double>(side_);
    return static_cast<std::size_t>(std::clamp(cell, 0.0L, static_cast<long double>(side_ - 1)));
  }
  std::size_t column(long double x) const { return index(x, box_.low.x, box_.high.x); }
  std::size_t row(long double y) const { return index(y, box_.low.y, box_.high.y); }

  const Places& places_;
  PlanarBox box_{};
  std::size_t side_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

/// The places through which edges between two others are led, from the lower number on.
using Ways = std::unordered_map<std::uint64_t, std::vector<std::uint32_t>>;

/// How far along a segment the nearest point of it is, of its length, and how far away.
std::pair<long double, long double> foot_of(const PlanarPoint& a, const PlanarPoint& b,
                                            const PlanarPoint& point) {
  const long double dx = b.x - a.x, dy = b.y - a.y;
  const long double squared = dx * dx + dy * dy;
  const long double t =
      squared > 0 ? std::clamp(((point.x - a.x) * dx + (point.y - a.y) * dy) / squared, 0.0L, 1.0L)
                  : 0.0L;
  return {t, std::hypot(point.x - (a.x + t * dx), point.y - (a.y + t * dy))};
}

Ways ways_of(const Places& places, const std::vector<Edges::Edge>& edges, long double snap) {
  Ways ways;
  std::vector<std::uint32_t> ends;
  for (const Edges::Edge& edge : edges) {
    ends.push_back(edge.from);
    ends.push_back(edge.to);
  }
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const Raster raster(places, ends);
  for (const Edges::Edge& edge : edges) {
    const PlanarPoint &a = places[edge.from], &b = places[edge.to];
    std::vector<std::pair<long double, std::uint32_t>> between;
    raster.near(a, b, snap, [&](std::uint32_t place) {
      if (place == edge.from || place == edge.to) return;
      const auto [t, apart] = foot_of(a, b, places[place]);
      if (t > 0 && t < 1 && apart <= snap) between.emplace_back(t, place);
    });
    if (between.empty()) continue;
    std::ranges::sort(between);
    std::vector<std::uint32_t>& way = ways[Edges::key(edge.from, edge.to)];
    for (const auto& [t, place] : between) way.push_back(place);
  }
  return ways;
}

/// What one edge sweeps on its way to the places that it is led through.
void add_strip(const PlanarPoint& a, const PlanarPoint& b, const PlanarLoop& way,
               long double uncertain, ErrorStrips& strips) {
  const PlanarLine line = line_through(a, b);
  long double low = 0, high = 0, moved = 0, along = 0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const PlanarPoint& place = way[i];
    low = std::min(low, line.at(place));
    high = std::max(high, line.at(place));
    // Points of the edge go to its ends, and to what is between in the order of the way.
    if (i == 0 || i + 1 == way.size()) {
      moved = std::max(moved, distance(place, i == 0 ? a : b));
      continue;
    }
    along = std::max(along, foot_of(a, b, place).first);
    const PlanarPoint from{a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)};
    moved = std::max(moved, distance(place, from));
  }
  const long double width = high - low + 2 * uncertain, reach = moved + 2 * uncertain;
  strips.add(width, distance(a, b) + 2 * reach, reach);
}

}  // namespace

bool cancel(std::span<const TilingLoop> loops, long double snap, long double error,
            ErrorStrips& strips) {
  PlanarLoop all;
  for (const TilingLoop& own : loops) all.insert(all.end(), own.loop->begin(), own.loop->end());
  if (all.empty()) return false;
  const PlanarBox box = box_of(all);
  const long double size = (box.high.x - box.low.x) + (box.high.y - box.low.y);
  if (!(snap > 0) || !(size / snap < kMostCells)) return false;
  Places places(box.low, snap);
  std::vector<std::vector<std::uint32_t>> snapped;
  Edges edges;
  for (const TilingLoop& own : loops) {
    std::vector<std::uint32_t>& loop = snapped.emplace_back();
    for (const PlanarPoint& point : *own.loop) loop.push_back(places.at(point));
    for (std::size_t i = 0; i < loop.size(); ++i) {
      edges.add(loop[i], loop[(i + 1) % loop.size()], own.sign);
    }
  }
  Ways ways;
  if (const std::vector<Edges::Edge> left = edges.left(); !left.empty()) {
    ways = ways_of(places, left, snap);
    Edges split;
    for (const Edges::Edge& edge : left) {
      std::uint32_t from = edge.from;
      if (const auto way = ways.find(Edges::key(edge.from, edge.to)); way != ways.end()) {
        for (const std::uint32_t place : way->second) {
          split.add(from, place, edge.count);
          from = place;
        }
      }
      split.add(from, edge.to, edge.count);
    }
    if (!split.cancel()) return false;
  }
  PlanarLoop way;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    const PlanarLoop& loop = *loops[l].loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t j = (i + 1) % loop.size();
      const std::uint32_t from = snapped[l][i], to = snapped[l][j];
      way.assign(1, places[from]);
      if (const auto led = ways.find(Edges::key(from, to)); from != to && led != ways.end()) {
        for (const std::uint32_t place : led->second) way.push_back(places[place]);
        if (from > to) std::reverse(way.begin() + 1, way.end());
      }
      way.push_back(places[to]);
      add_strip(loop[i], loop[j], way, error + loops[l].slack, strips);
    }
  }
  return true;
}

}  // namespace gnomon::oracle
