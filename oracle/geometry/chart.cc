// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/chart.h"

namespace gnomon::oracle {

namespace {

mpz_class gcd_of(const mpz_class& a, const mpz_class& b, const mpz_class& c) {
  mpz_class result = gcd(a, b);
  if (result != 1) result = gcd(result, c);
  return result;
}

}  // namespace

Integers3 minus(const Integers3& a, const Integers3& b) {
  return {mpz_class(a[0] - b[0]), mpz_class(a[1] - b[1]), mpz_class(a[2] - b[2])};
}

Integers3 cross(const Integers3& a, const Integers3& b) {
  return {mpz_class(a[1] * b[2] - a[2] * b[1]), mpz_class(a[2] * b[0] - a[0] * b[2]),
          mpz_class(a[0] * b[1] - a[1] * b[0])};
}

mpz_class dot(const Integers3& a, const Integers3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

mpz_class value_at(const ExactPlane& plane, const Integers3& point) {
  return dot(plane.normal, point) - plane.offset;
}

mpz_class value_at(const ExactPlane& plane, const HomogeneousPoint& point) {
  return dot(plane.normal, point.xyz) - plane.offset * point.w;
}

ExactPlane opposite(ExactPlane plane) {
  for (mpz_class& component : plane.normal) component = -component;
  plane.offset = -plane.offset;
  return plane;
}

void reduce(ExactPlane& plane) {
  mpz_class common = gcd_of(plane.normal[0], plane.normal[1], plane.normal[2]);
  common = gcd(common, plane.offset);
  if (common <= 1) return;
  for (mpz_class& component : plane.normal) component /= common;
  plane.offset /= common;
}

Integers3 area_vector(std::span<const Integers3> loop) {
  Integers3 sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Integers3 term = cross(minus(loop[i], loop[0]), minus(loop[i + 1], loop[0]));
    for (int k = 0; k < 3; ++k) sum[k] += term[k];
  }
  return sum;
}

ExactPlane plane_of(std::span<const Integers3> loop) {
  ExactPlane plane;
  plane.normal = area_vector(loop);
  plane.offset = loop.empty() ? mpz_class(0) : dot(plane.normal, loop[0]);
  reduce(plane);
  return plane;
}

HomogeneousPoint to_grid(const Geometry& geometry, const RationalPoint& point) {
  std::array<mpq_class, 3> coordinates;
  HomogeneousPoint result;
  for (int k = 0; k < 3; ++k) {
    coordinates[k] = (point[k] - geometry.origin[k]) / geometry.step;
    result.w = lcm(result.w, coordinates[k].get_den());
  }
  for (int k = 0; k < 3; ++k) {
    result.xyz[k] = coordinates[k].get_num() * (result.w / coordinates[k].get_den());
  }
  return result;
}

namespace {

/// a b - c d. The result keeps its memory: an expression of mpz_class would make a number for each
/// product, and that costs more than the products of short numbers.
void subtract_products(mpz_class& result, const mpz_class& a, const mpz_class& b,
                       const mpz_class& c, const mpz_class& d) {
  mpz_mul(result.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
  mpz_submul(result.get_mpz_t(), c.get_mpz_t(), d.get_mpz_t());
}

void add_product(mpz_class& sum, const mpz_class& a, const mpz_class& b) {
  mpz_addmul(sum.get_mpz_t(), a.get_mpz_t(), b.get_mpz_t());
}

/// The sign of a b - c d.
int compare_products(const mpz_class& a, const mpz_class& b, const mpz_class& c,
                     const mpz_class& d) {
  thread_local mpz_class difference;
  subtract_products(difference, a, b, c, d);
  return sgn(difference);
}

}  // namespace

int sign_at(const ChartLine& line, const ChartPoint& point) {
  thread_local mpz_class value;
  mpz_mul(value.get_mpz_t(), line.a.get_mpz_t(), point.x.get_mpz_t());
  add_product(value, line.b, point.y);
  add_product(value, line.c, point.w);
  return sgn(value);
}

ChartLine line_through(const ChartPoint& a, const ChartPoint& b) {
  ChartLine line;
  subtract_products(line.a, a.y, b.w, a.w, b.y);
  subtract_products(line.b, a.w, b.x, a.x, b.w);
  subtract_products(line.c, a.x, b.y, a.y, b.x);
  reduce(line);
  return line;
}

void reduce(ChartLine& line) {
  const mpz_class common = gcd_of(line.a, line.b, line.c);
  if (common <= 1) return;
  line.a /= common;
  line.b /= common;
  line.c /= common;
}

void reduce(ChartPoint& point) {
  mpz_class common = gcd_of(point.w, point.x, point.y);
  if (point.w < 0) common = -common;
  if (common == 1) return;
  point.x /= common;
  point.y /= common;
  point.w /= common;
}

ChartPoint meet(const ChartLine& a, const ChartLine& b) {
  ChartPoint point;
  subtract_products(point.x, a.b, b.c, a.c, b.b);
  subtract_products(point.y, a.c, b.a, a.a, b.c);
  subtract_products(point.w, a.a, b.b, a.b, b.a);
  reduce(point);
  return point;
}

int compare_x(const ChartPoint& a, const ChartPoint& b) {
  if (a.w == b.w) return cmp(a.x, b.x);
  return compare_products(a.x, b.w, b.x, a.w);
}

int compare_y(const ChartPoint& a, const ChartPoint& b) {
  if (a.w == b.w) return cmp(a.y, b.y);
  return compare_products(a.y, b.w, b.y, a.w);
}

int compare(const ChartPoint& a, const ChartPoint& b) {
  const int by_x = compare_x(a, b);
  return by_x != 0 ? by_x : compare_y(a, b);
}

int orientation(const ChartPoint& a, const ChartPoint& b, const ChartPoint& c) {
  thread_local mpz_class minor, value;
  subtract_products(minor, a.y, b.w, a.w, b.y);
  mpz_mul(value.get_mpz_t(), minor.get_mpz_t(), c.x.get_mpz_t());
  subtract_products(minor, a.w, b.x, a.x, b.w);
  add_product(value, minor, c.y);
  subtract_products(minor, a.x, b.y, a.y, b.x);
  add_product(value, minor, c.w);
  return sgn(value);
}

Chart::Chart(const ExactPlane& support) : support_(support) {
  axis_ = 2;
  if (cmp(abs(support.normal[1]), abs(support.normal[axis_])) > 0) axis_ = 1;
  if (cmp(abs(support.normal[0]), abs(support.normal[axis_])) > 0) axis_ = 0;
  first_ = (axis_ + 1) % 3;
  second_ = (axis_ + 2) % 3;
}

ChartPoint Chart::at(const Integers3& point) const {
  return ChartPoint{point[first_], point[second_], 1};
}

ChartPoint Chart::project(const HomogeneousPoint& point) const {
  // p - n (n . p - d) / (n . n), all over w.
  const mpz_class value = value_at(support_, point);
  ChartPoint result;
  if (value == 0) {
    result = {point.xyz[first_], point.xyz[second_], point.w};
  } else {
    const mpz_class squared = dot(support_.normal, support_.normal);
    result.x = point.xyz[first_] * squared - support_.normal[first_] * value;
    result.y = point.xyz[second_] * squared - support_.normal[second_] * value;
    result.w = point.w * squared;
  }
  reduce(result);
  return result;
}

ChartLine Chart::trace(const ExactPlane& plane) const {
  // On the support plane x_axis = (d - n_first x - n_second y) / n_axis; times |n_axis|.
  const mpz_class& own = support_.normal[axis_];
  const mpz_class& other = plane.normal[axis_];
  ChartLine line;
  line.a = plane.normal[first_] * own - other * support_.normal[first_];
  line.b = plane.normal[second_] * own - other * support_.normal[second_];
  line.c = other * support_.offset - plane.offset * own;
  if (own < 0) {
    line.a = -line.a;
    line.b = -line.b;
    line.c = -line.c;
  }
  reduce(line);
  return line;
}

HomogeneousPoint Chart::lift(const ChartPoint& point) const {
  const mpz_class& own = support_.normal[axis_];
  HomogeneousPoint result;
  result.xyz[first_] = point.x * own;
  result.xyz[second_] = point.y * own;
  result.xyz[axis_] = support_.offset * point.w - support_.normal[first_] * point.x -
                      support_.normal[second_] * point.y;
  result.w = point.w * own;
  if (result.w < 0) {
    for (mpz_class& coordinate : result.xyz) coordinate = -coordinate;
    result.w = -result.w;
  }
  return result;
}

RationalPoint Chart::lift_to_scene(const Geometry& geometry, const ChartPoint& point) const {
  const HomogeneousPoint lifted = lift(point);
  RationalPoint result;
  for (int k = 0; k < 3; ++k) {
    mpq_class coordinate(lifted.xyz[k], lifted.w);
    coordinate.canonicalize();
    result[k] = geometry.origin[k] + geometry.step * coordinate;
  }
  return result;
}

}  // namespace gnomon::oracle
