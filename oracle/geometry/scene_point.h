// SPDX-License-Identifier: GPL-3.0-or-later
// Points and planes of scene units in homogeneous integers, for the checker of exact claims: on
// which side of a plane a point is, and which way three points turn, as signs of sums of products.
// No sum is brought to lowest terms on the way, which is where rational numbers spend their time.
//
// Exactness: exact at any size; products of small numbers are taken in 128 bits, where a bound on
// their factors proves that they fit.
#ifndef GNOMON_ORACLE_GEOMETRY_SCENE_POINT_H
#define GNOMON_ORACLE_GEOMETRY_SCENE_POINT_H

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "gnomon/kernel/geometry.h"
#include "gnomon/result/claims.h"
#include "oracle/geometry/chart.h"

namespace gnomon::oracle {

/// Four integers, as 64-bit numbers where all fit in kSmallBits.
class Integers4 {
 public:
  /// Four products of two such numbers are below 2^126 together, and fit in 128 bits.
  static constexpr int kSmallBits = 62;
  /// Six products of three such numbers are below 2^123 together.
  static constexpr int kTinyBits = 40;

  explicit Integers4(std::array<mpz_class, 4> values);
  explicit Integers4(const std::array<std::int64_t, 4>& values);

  bool is_small() const { return bits_ <= kSmallBits; }
  bool is_tiny() const { return bits_ <= kTinyBits; }
  /// Requires: is_small().
  std::int64_t small(int k) const { return small_[k]; }
  const mpz_class& large(int k) const {
    make_large();
    return large_[k];
  }
  /// What several threads look at must have been made large before.
  void make_large() const;

 private:
  int bits_ = 0;  // of the largest
  std::array<std::int64_t, 4> small_{};
  mutable bool is_large_made_ = false;
  mutable std::array<mpz_class, 4> large_;
};

/// (x, y, z) over w > 0.
Integers4 scene_point(const RationalPoint& point);
/// A plane of the grid as a function of points in scene units: the sign of its product with
/// scene_point() is that of the plane's value there.
Integers4 scene_plane(const Geometry& geometry, const ExactPlane& plane);
/// Sign of the product. Degree: 1 in each.
int sign_of_product(const Integers4& plane, const Integers4& point);

/// Through three points, which may be at infinity: with w = 0 and a direction. Its front is either
/// side. Degree: 1 in each.
Integers4 plane_through(const Integers4& a, const Integers4& b, const Integers4& c);

/// Which way three points of one plane turn.
class PlaneTurn {
 public:
  /// Requires: a normal that is not zero.
  explicit PlaneTurn(const Integers3& normal);

  /// 1 if the way from a over b to c turns left, seen from where the normal points; -1 right; 0 if
  /// they are on one line. Requires: scene points in one plane with the normal. Degree: 1 in each.
  int operator()(const Integers4& a, const Integers4& b, const Integers4& c) const;
  /// Of a loop: twice its area, as seen along one axis, signed; in scene units squared. Areas of
  /// one plane compare by it.
  mpq_class doubled_area(const std::vector<const Integers4*>& loop) const;

 private:
  int x_ = 0, y_ = 1;  // coordinates in which left is left
};

/// Points, each once: equal ones have one number.
class PointNumbers {
 public:
  std::uint32_t number_of(const RationalPoint& point);
  std::size_t size() const { return points_.size(); }
  const RationalPoint& operator[](std::uint32_t number) const { return *points_[number]; }

 private:
  // Points are referred to, not copied: they must outlive this.
  std::vector<const RationalPoint*> points_;
  std::vector<std::uint32_t> next_;  // with the same hash
  std::unordered_map<std::uint64_t, std::uint32_t> first_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_GEOMETRY_SCENE_POINT_H
