// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/convex_loop.h"

#include <algorithm>
#include <utility>

namespace gnomon::oracle {

ConvexLoop loop_in_chart(const Chart& chart, std::span<const Integers3> points) {
  ConvexLoop result;
  for (const Integers3& point : points) result.vertices.push_back(chart.at(point));
  const std::size_t size = points.size();
  // Strictly convex without collinear vertices: any three consecutive ones tell the orientation.
  if (size >= 3 && orientation(result.vertices[0], result.vertices[1], result.vertices[2]) < 0) {
    std::reverse(result.vertices.begin(), result.vertices.end());
  }
  for (std::size_t i = 0; i < size; ++i) {
    result.lines.push_back(line_through(result.vertices[i], result.vertices[(i + 1) % size]));
  }
  return result;
}

bool clip(ConvexLoop& loop, const ChartLine& line, ConvexLoop& workspace) {
  const std::size_t size = loop.vertices.size();
  std::vector<int> signs(size);
  bool inside = false, outside = false;
  for (std::size_t i = 0; i < size; ++i) {
    signs[i] = sign_at(line, loop.vertices[i]);
    inside = inside || signs[i] > 0;
    outside = outside || signs[i] < 0;
  }
  if (!inside) return false;
  if (!outside) return true;
  workspace.vertices.clear();
  workspace.lines.clear();
  for (std::size_t i = 0; i < size; ++i) {
    const int here = signs[i], next = signs[(i + 1) % size];
    if (here > 0) {
      workspace.vertices.push_back(loop.vertices[i]);
      workspace.lines.push_back(loop.lines[i]);
      if (next < 0) {
        workspace.vertices.push_back(meet(loop.lines[i], line));
        workspace.lines.push_back(line);
      }
    } else if (here == 0) {
      workspace.vertices.push_back(loop.vertices[i]);
      workspace.lines.push_back(next > 0 ? loop.lines[i] : line);
    } else if (next > 0) {
      workspace.vertices.push_back(meet(loop.lines[i], line));
      workspace.lines.push_back(loop.lines[i]);
    }
  }
  std::swap(loop, workspace);
  return true;
}

}  // namespace gnomon::oracle
