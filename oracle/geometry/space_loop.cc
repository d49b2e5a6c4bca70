// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/space_loop.h"

#include <utility>

namespace gnomon::oracle::space {

RationalPoint minus(const RationalPoint& a, const RationalPoint& b) {
  return {mpq_class(a[0] - b[0]), mpq_class(a[1] - b[1]), mpq_class(a[2] - b[2])};
}
mpq_class dot(const RationalPoint& a, const RationalPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
          mpq_class(a[0] * b[1] - a[1] * b[0])};
}

RationalPoint negated(const RationalPoint& a) {
  return {mpq_class(-a[0]), mpq_class(-a[1]), mpq_class(-a[2])};
}

HalfSpace::HalfSpace(RationalPoint n, const RationalPoint& b) : normal(std::move(n)), base(b) {
  // Scaled first: a normal is a product of lengths, and may leave the range of doubles.
  mpq_class most = 0;
  for (const mpq_class& c : normal) {
    if (cmp(abs(c), most) > 0) most = abs(c);
  }
  for (int k = 0; k < 3 && most != 0; ++k) near_normal[k] = mpq_class(normal[k] / most).get_d();
  for (int k = 0; k < 3; ++k) near_base[k] = base[k].get_d();
}

double HalfSpace::near_value(const std::array<double, 3>& p) const {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += near_normal[k] * (p[k] - near_base[k]);
  return sum;
}

Loop cut(const Loop& loop, const HalfSpace& half) {
  Loop result;
  std::vector<mpq_class> values;
  bool inside = false, outside = false;
  for (const RationalPoint& point : loop) {
    values.push_back(half.value(point));
    inside = inside || values.back() > 0;
    outside = outside || values.back() < 0;
  }
  if (!inside) return {};
  if (!outside) return loop;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const std::size_t j = (i + 1) % loop.size();
    if (values[i] >= 0) result.push_back(loop[i]);
    if (sgn(values[i]) * sgn(values[j]) < 0) {
      const mpq_class t = values[i] / (values[i] - values[j]);
      RationalPoint crossing;
      for (int k = 0; k < 3; ++k) crossing[k] = loop[i][k] + t * (loop[j][k] - loop[i][k]);
      result.push_back(std::move(crossing));
    }
  }
  return result;
}

std::vector<Loop> without(std::vector<Loop> loops, std::span<const HalfSpace> bounds) {
  std::vector<Loop> left;
  for (Loop& loop : loops) {
    for (std::size_t i = 0; i < bounds.size() && !loop.empty(); ++i) {
      const HalfSpace beyond(negated(bounds[i].normal), bounds[i].base);
      Loop inner = cut(loop, bounds[i]);
      Loop outer = inner.empty() ? loop : cut(loop, beyond);
      if (!outer.empty()) left.push_back(std::move(outer));
      loop = std::move(inner);
    }
  }
  return left;
}

PlaneView::PlaneView(const RationalPoint& normal) {
  int axis = 0;
  while (axis < 2 && normal[axis] == 0) ++axis;
  const bool above = normal[axis] > 0;
  x_ = (axis + (above ? 1 : 2)) % 3;
  y_ = (axis + (above ? 2 : 1)) % 3;
  // An area vector along the normal is told by one of its components.
  scale_ = dot(normal, normal) / (2 * abs(normal[axis]));
}

int PlaneView::turn(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) const {
  const mpq_class left = (b[x_] - a[x_]) * (c[y_] - a[y_]);
  const mpq_class right = (b[y_] - a[y_]) * (c[x_] - a[x_]);
  const int order = cmp(left, right);
  return order > 0 ? 1 : order < 0 ? -1 : 0;
}

mpq_class PlaneView::area(const Loop& loop) const {
  mpq_class sum;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const RationalPoint& before = loop[(i + loop.size() - 1) % loop.size()];
    const RationalPoint& after = loop[(i + 1) % loop.size()];
    sum += loop[i][x_] * (after[y_] - before[y_]);
  }
  return sum * scale_;
}

mpq_class area_along(const RationalPoint& normal, const Loop& loop) {
  RationalPoint sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const RationalPoint term = cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0]));
    for (int k = 0; k < 3; ++k) sum[k] += term[k];
  }
  return dot(normal, sum) / 2;
}

mpq_class area_along(const RationalPoint& normal, const std::vector<Loop>& loops) {
  mpq_class sum;
  for (const Loop& loop : loops) sum += area_along(normal, loop);
  return sum;
}

}  // namespace gnomon::oracle::space
