// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/answer/deep_umbra.h"

#include <algorithm>
#include <utility>

#include "oracle/geometry/convex_loop.h"
#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

namespace {

ConvexLoop with_lines(std::vector<ChartPoint> vertices) {
  ConvexLoop loop;
  loop.vertices = std::move(vertices);
  for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
    loop.lines.push_back(
        line_through(loop.vertices[i], loop.vertices[(i + 1) % loop.vertices.size()]));
  }
  return loop;
}

bool holds(const std::vector<ChartPoint>& convex, const std::vector<ChartPoint>& points) {
  for (std::size_t i = 0; i < convex.size(); ++i) {
    for (const ChartPoint& point : points) {
      if (orientation(convex[i], convex[(i + 1) % convex.size()], point) < 0) return false;
    }
  }
  return true;
}

mpq_class ratio(const mpz_class& over, const mpz_class& under) {
  mpq_class value(over, under);
  value.canonicalize();
  return value;
}

/// The line across the middle of a loop's box, across its longer side: positive beyond it.
ChartLine middle_line(const std::vector<ChartPoint>& loop) {
  mpq_class low[2], high[2];
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const mpq_class at[2] = {ratio(loop[i].x, loop[i].w), ratio(loop[i].y, loop[i].w)};
    for (int k = 0; k < 2; ++k) {
      if (i == 0 || at[k] < low[k]) low[k] = at[k];
      if (i == 0 || at[k] > high[k]) high[k] = at[k];
    }
  }
  const int k = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
  const mpq_class middle = (low[k] + high[k]) / 2;
  ChartLine line;
  (k == 0 ? line.a : line.b) = middle.get_den();
  line.c = -middle.get_num();
  return line;
}

ChartPoint centre_of(const std::vector<ChartPoint>& loop) {
  mpq_class x, y;
  for (const ChartPoint& vertex : loop) {
    x += ratio(vertex.x, vertex.w);
    y += ratio(vertex.y, vertex.w);
  }
  x /= mpq_class(loop.size());
  y /= mpq_class(loop.size());
  const mpz_class w = lcm(x.get_den(), y.get_den());
  ChartPoint point{x.get_num() * (w / x.get_den()), y.get_num() * (w / y.get_den()), w};
  reduce(point);
  return point;
}

}  // namespace

void DeepUmbra::certify(const std::vector<ChartPoint>& loop) {
  for (std::uint32_t part : group_.parts) certify_in_part(loop, part);
}

void DeepUmbra::certify_box_of(const std::vector<ChartPoint>& points) {
  if (points.empty()) return;
  const ChartPoint *left = &points[0], *right = left, *low = left, *high = left;
  for (const ChartPoint& point : points) {
    if (compare_x(point, *left) < 0) left = &point;
    if (compare_x(point, *right) > 0) right = &point;
    if (compare_y(point, *low) < 0) low = &point;
    if (compare_y(point, *high) > 0) high = &point;
  }
  const auto corner = [](const ChartPoint& x, const ChartPoint& y) {
    ChartPoint point{x.x * y.w, y.y * x.w, x.w * y.w};
    reduce(point);
    return point;
  };
  if (compare_x(*left, *right) == 0 || compare_y(*low, *high) == 0) return;
  certify({corner(*left, *low), corner(*right, *low), corner(*right, *high), corner(*left, *high)});
}

void DeepUmbra::certify_whole() {
  for (std::uint32_t part : group_.parts) {
    certify_in_part(loop_in_chart(chart_, grid_loop(answer_.prepared(), part)).vertices, part);
  }
}

void DeepUmbra::certify_in_part(const std::vector<ChartPoint>& loop, std::uint32_t part) {
  const PreparedScene& prepared = answer_.prepared();
  const AreaShade& shade = answer_.area_shade(light_, part, group_.side);
  if (!answer_.area_regions(light_).sees(part, group_.side)) return;
  const ChartLine horizon = chart_.trace(plane_of(prepared.lights[light_].area_loop));
  ConvexLoop whole = with_lines(loop), workspace;
  for (const ChartLine& line : loop_in_chart(chart_, grid_loop(prepared, part)).lines) {
    if (!clip(whole, line, workspace)) return;
  }
  if (!clip(whole, horizon, workspace)) return;
  const AreaVisibility& visibility = answer_.area_visibility(light_);
  std::vector<std::pair<ConvexLoop, int>> open;
  open.emplace_back(std::move(whole), 0);
  while (!open.empty() && tests_ < kTests) {
    auto [piece, depth] = std::move(open.back());
    open.pop_back();
    const bool umbra = std::any_of(
        shade.umbra.begin(), shade.umbra.end(),
        [&, &piece = piece](const ShadowPiece& own) { return holds(own.loop, piece.vertices); });
    if (umbra) continue;
    ++tests_;
    std::vector<RationalPoint> corners;
    for (const ChartPoint& vertex : piece.vertices) {
      corners.push_back(chart_.lift_to_scene(prepared.geometry, vertex));
    }
    if (visibility.hides_all_from(part, group_.side, corners)) {
      certified_.push_back(std::move(piece.vertices));
      continue;
    }
    if (depth == kDepth) continue;
    // After a few halvings a piece that sees light from its middle and corners is given up.
    if (depth >= kDepth / 3) {
      corners.push_back(chart_.lift_to_scene(prepared.geometry, centre_of(piece.vertices)));
      const bool sees =
          std::all_of(corners.rbegin(), corners.rend(), [&](const RationalPoint& point) {
            return !visibility.at(part, group_.side, point).deep();
          });
      if (sees) continue;
    }
    const ChartLine across = middle_line(piece.vertices);
    ConvexLoop half = piece;
    if (clip(half, across, workspace)) open.emplace_back(std::move(half), depth + 1);
    if (clip(piece, {-across.a, -across.b, -across.c}, workspace)) {
      open.emplace_back(std::move(piece), depth + 1);
    }
  }
}

}  // namespace gnomon::oracle
