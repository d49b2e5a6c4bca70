// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/geometry/scene_point.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <optional>
#include <utility>

namespace gnomon::oracle {

namespace {

__extension__ typedef __int128 Int128;

constexpr std::int64_t kLargestSmall = (std::int64_t{1} << Integers4::kSmallBits) - 1;

int sign_of(Int128 value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

bool is_small(const mpz_class& value) {
  return mpz_sizeinbase(value.get_mpz_t(), 2) <= Integers4::kSmallBits;
}

/// Coordinates over their common denominator, if all of it is small.
std::optional<std::array<std::int64_t, 4>> small_point(const RationalPoint& point) {
  std::array<std::int64_t, 4> result{0, 0, 0, 1};
  std::array<std::int64_t, 3> under{};
  Int128 common = 1;
  for (int k = 0; k < 3; ++k) {
    if (!is_small(point[k].get_num()) || !is_small(point[k].get_den())) return std::nullopt;
    under[k] = point[k].get_den().get_si();
    if (under[k] == 1 || under[k] == common) continue;
    common *= under[k] / std::gcd(static_cast<std::int64_t>(common), under[k]);
    if (common > kLargestSmall) return std::nullopt;
  }
  for (int k = 0; k < 3; ++k) {
    const Int128 over = (common / under[k]) * point[k].get_num().get_si();
    if (over > kLargestSmall || over < -kLargestSmall) return std::nullopt;
    result[k] = static_cast<std::int64_t>(over);
  }
  result[3] = static_cast<std::int64_t>(common);
  return result;
}

/// Room for products, kept: nothing is allocated once it is large enough.
struct Scratch {
  mpz_class sum, minor;
};
Scratch& scratch() {
  static thread_local Scratch own;
  return own;
}

}  // namespace

Integers4::Integers4(std::array<mpz_class, 4> values)
    : is_large_made_(true), large_(std::move(values)) {
  for (const mpz_class& value : large_) {
    bits_ = std::max(bits_, static_cast<int>(mpz_sizeinbase(value.get_mpz_t(), 2)));
  }
  if (!is_small()) return;
  for (int k = 0; k < 4; ++k) small_[k] = large_[k].get_si();
}

Integers4::Integers4(const std::array<std::int64_t, 4>& values) : small_(values) {
  for (const std::int64_t value : values) {
    const auto size = static_cast<std::uint64_t>(value < 0 ? -value : value);
    bits_ = std::max(bits_, static_cast<int>(std::bit_width(size)));
  }
}

void Integers4::make_large() const {
  if (is_large_made_) return;
  for (int k = 0; k < 4; ++k) large_[k] = static_cast<long>(small_[k]);
  is_large_made_ = true;
}

Integers4 scene_point(const RationalPoint& point) {
  if (const auto small = small_point(point)) return Integers4(*small);
  std::array<mpz_class, 4> result;
  mpz_class& common = result[3];
  common = point[0].get_den();
  for (int k = 1; k < 3; ++k) {
    if (point[k].get_den() != common) common = lcm(common, point[k].get_den());
  }
  for (int k = 0; k < 3; ++k) {
    if (point[k].get_den() == common) {
      result[k] = point[k].get_num();
      continue;
    }
    mpz_divexact(result[k].get_mpz_t(), common.get_mpz_t(), point[k].get_den_mpz_t());
    result[k] *= point[k].get_num();
  }
  return Integers4(std::move(result));
}

Integers4 scene_plane(const Geometry& geometry, const ExactPlane& plane) {
  // n . (x - origin) / step - d, times the step and what makes it an integer.
  mpq_class offset = plane.offset * geometry.step;
  for (int k = 0; k < 3; ++k) {
    if (geometry.origin[k] != 0) offset += plane.normal[k] * geometry.origin[k];
  }
  std::array<mpz_class, 4> result;
  for (int k = 0; k < 3; ++k) result[k] = plane.normal[k] * offset.get_den();
  result[3] = -offset.get_num();
  return Integers4(std::move(result));
}

int sign_of_product(const Integers4& plane, const Integers4& point) {
  if (plane.is_small() && point.is_small()) {
    Int128 sum = 0;
    for (int k = 0; k < 4; ++k) sum += static_cast<Int128>(plane.small(k)) * point.small(k);
    return sign_of(sum);
  }
  mpz_ptr sum = scratch().sum.get_mpz_t();
  mpz_mul(sum, plane.large(0).get_mpz_t(), point.large(0).get_mpz_t());
  for (int k = 1; k < 4; ++k) {
    mpz_addmul(sum, plane.large(k).get_mpz_t(), point.large(k).get_mpz_t());
  }
  return mpz_sgn(sum);
}

Integers4 plane_through(const Integers4& a, const Integers4& b, const Integers4& c) {
  // The determinant of a, b, c and a fourth row, by that row.
  std::array<mpz_class, 4> plane;
  Scratch& own = scratch();
  mpz_ptr minor = own.minor.get_mpz_t();
  for (int k = 0; k < 4; ++k) {
    const int i = k == 0 ? 1 : 0, j = k <= 1 ? 2 : 1, l = k == 3 ? 2 : 3;
    mpz_ptr sum = plane[k].get_mpz_t();
    const auto add = [&](int x, int y, int z) {
      mpz_mul(minor, a.large(x).get_mpz_t(), b.large(y).get_mpz_t());
      mpz_submul(minor, a.large(y).get_mpz_t(), b.large(x).get_mpz_t());
      mpz_addmul(sum, minor, c.large(z).get_mpz_t());
    };
    add(i, j, l);
    add(j, l, i);
    add(l, i, j);
    if (k % 2 == 0) mpz_neg(sum, sum);
  }
  return Integers4(std::move(plane));
}

PlaneTurn::PlaneTurn(const Integers3& normal) {
  int axis = 0;
  while (axis < 2 && normal[axis] == 0) ++axis;
  const bool above = normal[axis] > 0;
  x_ = (axis + (above ? 1 : 2)) % 3;
  y_ = (axis + (above ? 2 : 1)) % 3;
}

int PlaneTurn::operator()(const Integers4& a, const Integers4& b, const Integers4& c) const {
  // The determinant of the rows (x, y, w): its sign is that of the turn, since each w is positive.
  if (a.is_tiny() && b.is_tiny() && c.is_tiny()) {
    const auto minor = [&](int i, int j) {
      return static_cast<Int128>(a.small(i)) * b.small(j) -
             static_cast<Int128>(a.small(j)) * b.small(i);
    };
    return sign_of(minor(y_, 3) * c.small(x_) + minor(3, x_) * c.small(y_) +
                   minor(x_, y_) * c.small(3));
  }
  Scratch& own = scratch();
  mpz_ptr sum = own.sum.get_mpz_t(), minor = own.minor.get_mpz_t();
  mpz_set_ui(sum, 0);
  const auto add = [&](int i, int j, int k) {
    mpz_mul(minor, a.large(i).get_mpz_t(), b.large(j).get_mpz_t());
    mpz_submul(minor, a.large(j).get_mpz_t(), b.large(i).get_mpz_t());
    mpz_addmul(sum, minor, c.large(k).get_mpz_t());
  };
  add(y_, 3, x_);
  add(3, x_, y_);
  add(x_, y_, 3);
  return mpz_sgn(sum);
}

mpq_class PlaneTurn::doubled_area(const std::vector<const Integers4*>& loop) const {
  // The sum over edges of (x y' - x' y) / (w w'), first where neighbours have one denominator.
  mpq_class sum;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Integers4 &a = *loop[i], &b = *loop[(i + 1) % loop.size()];
    mpq_class term;
    term.get_num() = a.large(x_) * b.large(y_) - a.large(y_) * b.large(x_);
    term.get_den() = a.large(3) * b.large(3);
    term.canonicalize();
    sum += term;
  }
  return sum;
}

namespace {

std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 29);
}

std::uint64_t hash_of(const RationalPoint& point) {
  std::uint64_t hash = 0;
  for (const mpq_class& coordinate : point) {
    const mpq_srcptr value = coordinate.get_mpq_t();
    hash = mixed(hash, mpz_getlimbn(mpq_numref(value), 0));
    hash = mixed(hash, mpz_getlimbn(mpq_denref(value), 0) + (mpq_sgn(value) < 0 ? 1 : 0));
  }
  return hash;
}

}  // namespace

std::uint32_t PointNumbers::number_of(const RationalPoint& point) {
  constexpr std::uint32_t kNone = 0xffffffffu;
  const auto number = static_cast<std::uint32_t>(points_.size());
  const auto [place, is_new] = first_.try_emplace(hash_of(point), number);
  if (!is_new) {
    for (std::uint32_t own = place->second; own != kNone; own = next_[own]) {
      if (*points_[own] == point) return own;
    }
  }
  next_.push_back(is_new ? kNone : std::exchange(place->second, number));
  points_.push_back(&point);
  return number;
}

}  // namespace gnomon::oracle
