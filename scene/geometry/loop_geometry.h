// SPDX-License-Identifier: LGPL-3.0-or-later
// Exact vectors on the scene's grid, and what a loop is: cleaned of repeated and collinear
// vertices, its area vector, planar or not, convex or not.
#ifndef GNOMON_SCENE_GEOMETRY_LOOP_GEOMETRY_H
#define GNOMON_SCENE_GEOMETRY_LOOP_GEOMETRY_H

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "gnomon/kernel/sign.h"
#include "scene/base/exact_int.h"

namespace gnomon::scene_detail {

template <class Int>
struct Vec3 {
  Int x, y, z;
  const Int& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  bool is_zero() const { return x == 0 && y == 0 && z == 0; }
};

template <class Int>
Vec3<Int> operator-(const Vec3<Int>& a, const Vec3<Int>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Int>
Vec3<Int> operator+(const Vec3<Int>& a, const Vec3<Int>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Int>
Vec3<Int> cross(const Vec3<Int>& a, const Vec3<Int>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Int>
Int dot(const Vec3<Int>& a, const Vec3<Int>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// A corner of an input loop: its vertex after welding, and the smallest index in Scene::vertices
/// of the repeated vertices that it stands for. Rules that need an order use `input`, so that they
/// depend neither on where a loop starts nor on how vertices were welded.
struct Corner {
  VertexId vertex = 0;
  std::uint32_t input = 0;
};

template <class Int>
Vec3<Int> point(const GridPositions& grid, VertexId vertex) {
  if constexpr (!std::is_same_v<Int, mpz_class>) {
    if (grid.is_narrow()) {
      const std::int64_t* const p = grid.narrow_point(vertex);
      return {Int(p[0]), Int(p[1]), Int(p[2])};
    }
  }
  return {coordinate<Int>(grid, vertex, 0), coordinate<Int>(grid, vertex, 1),
          coordinate<Int>(grid, vertex, 2)};
}

struct Cleaning {
  std::uint32_t repeated = 0, collinear = 0;
};

/// Drops repeated vertices and vertices collinear with both neighbours (also the tip of an edge
/// that runs there and back), again and again until none is left. Fewer than 3 corners remain if
/// and only if all lie on one line or cancel out: a loop of zero area. Cost: O(size).
template <class Int>
Cleaning clean_loop(const GridPositions& grid, std::vector<Corner>& loop) {
  Cleaning done;
  std::vector<Corner> kept;
  std::vector<Vec3<Int>> at;
  kept.reserve(loop.size());
  // `kept` is a stack: a corner may undo the ones before it.
  for (const Corner& corner : loop) {
    kept.push_back(corner);
    at.push_back(point<Int>(grid, corner.vertex));
    for (std::size_t n = kept.size(); n >= 2; n = kept.size()) {
      if (kept[n - 1].vertex == kept[n - 2].vertex) {
        kept[n - 2].input = std::min(kept[n - 2].input, kept[n - 1].input);
        kept.pop_back();
        at.pop_back();
        ++done.repeated;
      } else if (n >= 3 && cross(at[n - 2] - at[n - 3], at[n - 1] - at[n - 2]).is_zero()) {
        kept.erase(kept.end() - 2);
        at.erase(at.end() - 2);
        ++done.collinear;
      } else {
        break;
      }
    }
  }
  // What is left to do is where the loop closes; `first` is the front of a queue.
  std::size_t first = 0;
  while (kept.size() - first >= 3) {
    const std::size_t n = kept.size();
    if (kept[first].vertex == kept[n - 1].vertex) {
      kept[first].input = std::min(kept[first].input, kept[n - 1].input);
      kept.pop_back();
      at.pop_back();
      ++done.repeated;
    } else if (cross(at[n - 1] - at[n - 2], at[first] - at[n - 1]).is_zero()) {
      kept.pop_back();
      at.pop_back();
      ++done.collinear;
    } else if (cross(at[first] - at[n - 1], at[first + 1] - at[first]).is_zero()) {
      ++first;
      ++done.collinear;
    } else {
      break;
    }
  }
  if (done.repeated + done.collinear != 0) {
    loop.assign(kept.begin() + static_cast<std::ptrdiff_t>(first), kept.end());
  }
  return done;
}

/// Twice the area vector: the sum over the fan from the first corner; counter-clockwise seen from
/// its tip. Zero for loops of fewer than 3 corners.
template <class Int>
Vec3<Int> area_vector(const std::vector<Vec3<Int>>& loop) {
  Vec3<Int> sum{0, 0, 0};
  for (std::size_t i = 2; i < loop.size(); ++i) {
    sum = sum + cross(loop[i - 1] - loop[0], loop[i] - loop[0]);
  }
  return sum;
}

/// The axis along which a loop is projected: the largest component of its area vector, ties z, y,
/// x.
template <class Int>
int projection_axis(const Vec3<Int>& area) {
  const auto absolute = [](const Int& v) { return v < 0 ? Int(-v) : v; };
  const Int x = absolute(area.x), y = absolute(area.y), z = absolute(area.z);
  return z >= x && z >= y ? 2 : y >= x ? 1 : 0;
}

/// Every corner on the plane through loop[0] with this normal.
template <class Int>
bool lies_in_plane(const std::vector<Vec3<Int>>& loop, const Vec3<Int>& origin,
                   const Vec3<Int>& normal) {
  return std::all_of(loop.begin(), loop.end(),
                     [&](const Vec3<Int>& p) { return dot(normal, p - origin) == 0; });
}

/// Strictly convex, by its turns and by its going round once; so without repeated or collinear
/// corners. Requires: planar with this area vector, which is not zero.
template <class Int>
bool is_convex(const std::vector<Vec3<Int>>& loop, const Vec3<Int>& area) {
  const std::size_t n = loop.size();
  if (n == 3) return true;
  const int axis = projection_axis(area);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const bool positive = area[axis] > 0;
  int switches = 0;  // of the edges' lexicographic direction: 2 if the loop goes round once
  Vec3<Int> last = loop[0] - loop[n - 1];
  const auto is_forward = [&](const Vec3<Int>& edge) {
    return edge[u] > 0 || (edge[u] == 0 && edge[v] > 0);
  };
  bool last_forward = is_forward(last);
  for (std::size_t i = 0; i < n; ++i) {
    Vec3<Int> next = loop[i + 1 == n ? 0 : i + 1] - loop[i];
    const Int turn = last[u] * next[v] - last[v] * next[u];
    if (positive ? !(turn > 0) : !(turn < 0)) return false;
    const bool forward = is_forward(next);
    if (forward != last_forward) ++switches;
    last_forward = forward;
    last = std::move(next);
  }
  return switches == 2;
}

}  // namespace gnomon::scene_detail

#endif  // GNOMON_SCENE_GEOMETRY_LOOP_GEOMETRY_H
