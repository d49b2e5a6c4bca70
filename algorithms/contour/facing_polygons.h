// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts that face the light, as the contour method reads them: corners and lines in rows of
// four, one polygon after another, counter-clockwise as seen from the light.
#ifndef GNOMON_ALGORITHMS_CONTOUR_FACING_POLYGONS_H
#define GNOMON_ALGORITHMS_CONTOUR_FACING_POLYGONS_H

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "algorithms/contour/light_rays.h"
#include "algorithms/partition/import_export.h"
#include "algorithms/partition/in_parallel.h"
#include "gnomon/scene/prepare.h"

namespace gnomon {

/// A range of depths that can be compared with those of all other polygons: larger is nearer.
struct DepthRange {
  float low = -std::numeric_limits<float>::infinity();
  float high = std::numeric_limits<float>::infinity();
};

/// One polygon; its corners are [first, first + count) of the arrays by corner.
struct FacingPolygon {
  std::uint32_t part = 0, first = 0, count = 0;
  std::uint32_t block = 0;  // its first block of four corners
  PlaneId plane = 0;
  bool casts = true, reversed = false;
  DepthRange depth;  // once the light's charts are known

  std::uint32_t blocks() const { return (count + 3) / 4; }
};

/// Three rows of four: components x, y and z of four vectors, from corners or lines.
template <class T>
struct VectorBlock {
  T x[4], y[4], z[4];

  Vector<T> at(std::uint32_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::uint32_t k, const Vector<T>& v) {
    x[k] = v[0];
    y[k] = v[1];
    z[k] = v[2];
  }
};

template <class Numbers>
struct FacingPolygons {
  using T = typename Numbers::T;

  std::vector<FacingPolygon> polygons;
  std::vector<VertexId> vertices;  // by corner, and three more that are read with the last ones
  std::vector<PlaneRef> edges;     // by corner: the edge from it to the next, by EdgeId
  /// By corner: whether its edge is that of two casters that go on from each other there, and no
  /// third one's. Where only the edges of meshes are looked at, none but silhouettes cast shadows.
  std::vector<std::uint8_t> is_shared;
  std::vector<VectorBlock<T>> corners, lines;  // interior on the positive side of lines
  std::vector<double> line_error;  // by corner, padded as blocks: of a line's value for |r_k| <= 1
  std::vector<double> reach;       // by polygon: the largest |r_k| of its corners

  std::uint32_t size() const { return static_cast<std::uint32_t>(polygons.size()); }
  Vector<T> corner(const FacingPolygon& p, std::uint32_t k) const {
    return corners[p.block + k / 4].at(k % 4);
  }
  Vector<T> line(const FacingPolygon& p, std::uint32_t k) const {
    return lines[p.block + k / 4].at(k % 4);
  }
  double error_of_line(const FacingPolygon& p, std::uint32_t k) const {
    return line_error[4 * std::size_t{p.block} + k];
  }
  /// Tell the caches that a polygon's first corners, or its first lines, are asked for soon.
  void prefetch_corners(std::uint32_t polygon) const { prefetch(corners[polygons[polygon].block]); }
  void prefetch_lines(std::uint32_t polygon) const { prefetch(lines[polygons[polygon].block]); }
  VertexId vertex(const FacingPolygon& p, std::uint32_t k) const { return vertices[p.first + k]; }
  PlaneRef edge(const FacingPolygon& p, std::uint32_t k) const { return edges[p.first + k]; }

  /// Lays out the parts of `facing`, in its order. The arrays are kept from light to light, and are
  /// right at once where the same sides face the light as the last: suns of one quarter of the day.
  void lay_out(const PreparedScene& scene, const FacingParts& facing, unsigned jobs);
  void find_shared_edges(std::size_t edge_count, unsigned jobs);
  /// Fills polygons [begin, end) with the numbers of one light.
  void fill(const LightRays<Numbers>& light, std::uint32_t begin, std::uint32_t end);

 private:
  static constexpr std::uint32_t kGrain = 4096;  // polygons of one thread

  static void prefetch(const VectorBlock<T>& block) {
    const char* bytes = reinterpret_cast<const char*>(&block);
    __builtin_prefetch(bytes);
    __builtin_prefetch(bytes + sizeof(block) - 1);
  }
  void name_corners(const PreparedScene& scene, const FacingPolygon& p);
  bool is_laid_out(const FacingParts& facing) const;

  std::vector<std::uint8_t> edge_users_;
};

template <class Numbers>
void FacingPolygons<Numbers>::lay_out(const PreparedScene& scene, const FacingParts& facing,
                                      unsigned jobs) {
  if (is_laid_out(facing)) return;
  polygons.resize(facing.parts.size());
  vertices.resize(facing.edges + 3);
  edges.resize(facing.edges);
  std::uint32_t first = 0, block = 0;
  for (std::size_t i = 0; i < facing.parts.size(); ++i) {
    const std::uint32_t index = facing.parts[i];
    const Part& part = scene.parts[index];
    const bool reversed = facing.facing[index].side == Side::kBack;
    polygons[i] = {index, first, part.count, block, part.plane, part.casts, reversed, {}};
    first += part.count;
    block += polygons[i].blocks();
  }
  in_parallel(jobs, size(), kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) name_corners(scene, polygons[i]);
  });
  find_shared_edges(scene.geometry.edges.size(), jobs);
  corners.resize(block);
  lines.resize(block);
  line_error.resize(4 * std::size_t{block});
  reach.resize(polygons.size());
}

template <class Numbers>
bool FacingPolygons<Numbers>::is_laid_out(const FacingParts& facing) const {
  return !polygons.empty() &&
         std::equal(polygons.begin(), polygons.end(), facing.parts.begin(), facing.parts.end(),
                    [&](const FacingPolygon& p, std::uint32_t part) {
                      return p.part == part &&
                             p.reversed == (facing.facing[part].side == Side::kBack);
                    });
}

template <class Numbers>
void FacingPolygons<Numbers>::name_corners(const PreparedScene& scene, const FacingPolygon& p) {
  const Part& part = scene.parts[p.part];
  const auto loop = scene.loop(part);
  const auto loop_edges = scene.edges(part);
  // Reversed: vertex k becomes n - 1 - k, and the edge that ended in it now starts from it.
  for (std::uint32_t k = 0; k < p.count; ++k) {
    const std::uint32_t from = p.reversed ? p.count - 1 - k : k;
    const std::uint32_t edge = !p.reversed ? k : from == 0 ? p.count - 1 : from - 1;
    vertices[p.first + k] = loop[from];
    edges[p.first + k] = p.reversed ? -loop_edges[edge] : loop_edges[edge];
  }
}

template <class Numbers>
void FacingPolygons<Numbers>::find_shared_edges(std::size_t edge_count, unsigned jobs) {
  // Of each edge: whether it is there in either direction, whether more than once, and whether it
  // is one of a polygon that does not cast. Bits are only ever set, so that the order of polygons
  // does not matter.
  constexpr std::uint8_t kForward = 1, kBackward = 2, kAgain = 4, kDoesNotCast = 8;
  edge_users_.assign(edge_count, 0);
  const auto set = [jobs](std::uint8_t& users, std::uint8_t bits) {
    if (jobs == 1) return std::exchange(users, static_cast<std::uint8_t>(users | bits));
    return std::atomic_ref(users).fetch_or(bits, std::memory_order_relaxed);
  };
  in_parallel(jobs, size(), kGrain, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const FacingPolygon& p = polygons[i];
      for (std::uint32_t k = 0; k < p.count; ++k) {
        const PlaneRef edge = edges[p.first + k];
        std::uint8_t& users = edge_users_[edge.index()];
        const std::uint8_t direction = edge.flipped() ? kBackward : kForward;
        if (set(users, direction) & direction) set(users, kAgain);
        if (!p.casts) set(users, kDoesNotCast);
      }
    }
  });
  is_shared.resize(edges.size());
  in_parallel(jobs, static_cast<std::uint32_t>(edges.size()), 4 * kGrain,
              [&](std::uint32_t begin, std::uint32_t end) {
                for (std::uint32_t i = begin; i < end; ++i) {
                  is_shared[i] = edge_users_[edges[i].index()] == (kForward | kBackward);
                }
              });
}

template <class Numbers>
void FacingPolygons<Numbers>::fill(const LightRays<Numbers>& light, std::uint32_t begin,
                                   std::uint32_t end) {
  for (std::uint32_t i = begin; i < end; ++i) {
    const FacingPolygon& p = polygons[i];
    // Bounds of at least 2^-960: what underflows is off by 2^-1074 for each operation.
    constexpr double kLeastError = 0x1p-900, kLeastReach = 0x1p-60;
    double most = kLeastReach;
    for (std::uint32_t k = 0; k < 4 * p.blocks(); ++k) {
      // The last block is filled up with corner 0, which changes no sign of the polygon.
      const std::uint32_t from = p.first + (k < p.count ? k : 0);
      const Vector<T>& ray = light.rays[vertices[from]];
      corners[p.block + k / 4].set(k % 4, ray);
      if constexpr (Numbers::kCertified) most = std::max(most, largest(ray));
      const PlaneRef edge = edges[from];
      Vector<T> line = light.lines[edge.index()];
      if (edge.flipped()) {
        for (T& x : line) x = T(-x);
      }
      lines[p.block + k / 4].set(k % 4, line);
      line_error[4 * std::size_t{p.block} + k] =
          light.line_error[edge.index()] + (Numbers::kCertified ? kLeastError : 0);
    }
    reach[i] = !Numbers::kCertified ? 1 : light.reach > 0 ? light.reach : most;
  }
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_CONTOUR_FACING_POLYGONS_H
