// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/grid.h"

#include <algorithm>
#include <limits>

#include "scene/base/exact_int.h"
#include "scene/base/large_pages.h"
#include "scene/base/parallel.h"

namespace gnomon {
namespace {

using scene_detail::Int128;
using scene_detail::to_mpz;
using scene_detail::UInt128;

/// The common unit 2^two * 10^ten of all numbers seen, and a bound of their bits over it.
struct CommonUnit {
  bool dyadic = false, decimal = false, big = false;
  std::int32_t lowest_two = std::numeric_limits<std::int32_t>::max();
  std::int32_t lowest_ten = std::numeric_limits<std::int32_t>::max();
  // Largest value of (bits of the mantissa) + exponent * log2(base), rounded up.
  std::int64_t top = std::numeric_limits<std::int64_t>::min();

  void add(const Number& number) {
    if (number.is_zero()) return;
    if (!number.has_small_mantissa()) {
      big = true;
    }
    const std::int32_t exponent = number.exponent();
    if (number.is_decimal()) {
      decimal = true;
      lowest_ten = std::min(lowest_ten, exponent);
    } else {
      dyadic = true;
      lowest_two = std::min(lowest_two, exponent);
    }
    if (big) return;
    const std::int64_t mantissa = number.small_mantissa();
    const int bits =
        static_cast<int>(std::bit_width(mantissa < 0 ? 0 - static_cast<std::uint64_t>(mantissa)
                                                     : static_cast<std::uint64_t>(mantissa)));
    const std::int64_t scale =
        number.is_decimal() ? (std::int64_t{exponent} * 3322 + (exponent > 0 ? 999 : 0)) / 1000
                            : exponent;
    top = std::max(top, bits + scale);
  }

  void add(const CommonUnit& other) {
    dyadic |= other.dyadic;
    decimal |= other.decimal;
    big |= other.big;
    lowest_two = std::min(lowest_two, other.lowest_two);
    lowest_ten = std::min(lowest_ten, other.lowest_ten);
    top = std::max(top, other.top);
  }

  /// 2^two * 10^ten divides every number. Of a kind that is absent the exponent is 0; where both
  /// are present neither may be positive, for a power of one base need not divide the other's
  /// numbers.
  std::int32_t two() const { return !dyadic ? 0 : decimal ? std::min(lowest_two, 0) : lowest_two; }
  std::int32_t ten() const { return !decimal ? 0 : dyadic ? std::min(lowest_ten, 0) : lowest_ten; }

  /// Are all numbers over the unit, and their differences, integers of so many bits?
  bool fits_integers_of(int bits) const {
    if (big || (dyadic && decimal)) return false;
    if (!dyadic && !decimal) return true;
    const std::int64_t low = dyadic ? lowest_two : (std::int64_t{lowest_ten} * 3322) / 1000 - 1;
    constexpr int kSpare = 6;  // the sign, a difference, the rounding of `top` and `low`
    return top - low <= bits - kSpare;
  }
};

mpz_class power(unsigned long base, std::int64_t exponent) {
  mpz_class result;
  mpz_ui_pow_ui(result.get_mpz_t(), base, static_cast<unsigned long>(exponent));
  return result;
}

mpq_class unit_value(const CommonUnit& unit) {
  const auto factor = [](unsigned long base, std::int64_t exponent) {
    return exponent >= 0 ? mpq_class(power(base, exponent))
                         : mpq_class(mpz_class(1), power(base, -exponent));
  };
  mpq_class value = factor(2, unit.two()) * factor(10, unit.ten());
  value.canonicalize();
  return value;
}

/// Numbers as machine integers, of 64 or 128 bits, over the unit.
template <class Int>
class NarrowScale {
 public:
  explicit NarrowScale(const CommonUnit& unit) : two_(unit.two()), ten_(unit.ten()) {
    Int value = 1;
    for (Int& entry : powers_) {
      entry = value;
      constexpr unsigned kBits = 8 * sizeof(Int);
      if (value < (Int{1} << (kBits - 6))) value *= 10;
    }
  }
  Int operator()(const Number& number) const {
    const Int mantissa = number.small_mantissa();
    if (mantissa == 0) return 0;
    if (number.is_decimal()) {
      return mantissa * powers_[static_cast<std::size_t>(number.exponent() - ten_)];
    }
    return mantissa * (Int{1} << (number.exponent() - two_));
  }

 private:
  std::int32_t two_, ten_;
  std::array<Int, sizeof(Int) == sizeof(Int128) ? 40 : 20> powers_;
};

/// Numbers as GMP integers over the unit.
class WideScale {
 public:
  explicit WideScale(const CommonUnit& unit) : two_(unit.two()), ten_(unit.ten()) {}
  mpz_class operator()(const Number& number) {
    if (number.is_zero()) return 0;
    mpz_class value = number.mantissa();
    const std::int64_t twos =
        number.is_decimal() ? -std::int64_t{two_} : std::int64_t{number.exponent()} - two_;
    const std::int64_t tens =
        number.is_decimal() ? std::int64_t{number.exponent()} - ten_ : -std::int64_t{ten_};
    if (twos > 0) value <<= static_cast<unsigned long>(twos);
    if (tens > 0) {
      if (tens != last_tens_) {
        last_tens_ = tens;
        last_power_ = power(10, tens);
      }
      value *= last_power_;
    }
    return value;
  }

 private:
  std::int32_t two_, ten_;
  std::int64_t last_tens_ = -1;
  mpz_class last_power_;
};

void fill_narrow_or_wide(ExactGrid& grid, std::vector<mpz_class> coordinates) {
  for (const mpz_class& c : coordinates) {
    if (c != 0)
      grid.bits = std::max(grid.bits, static_cast<unsigned>(mpz_sizeinbase(c.get_mpz_t(), 2)));
  }
  grid.is_narrow = grid.bits <= GridPositions::kNarrowBits;
  if (!grid.is_narrow) {
    grid.wide = std::move(coordinates);
    return;
  }
  grid.narrow.reserve(coordinates.size());
  for (const mpz_class& c : coordinates) grid.narrow.push_back(c.get_si());
}

/// The box of points, and the greatest common divisor of the differences of their coordinates along
/// each axis: 0 if there are none.
template <class Int, class UInt>
struct BoxAndStep {
  bool empty = true;
  std::array<Int, 3> low{}, high{};
  UInt step = 0;

  void add(const std::array<Int, 3>& point) {
    if (empty) {
      empty = false;
      low = high = point;
      return;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      if (step != 1) {
        add_difference(
            static_cast<UInt>(point[k] > low[k] ? point[k] - low[k] : low[k] - point[k]));
      }
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }
  void add(const BoxAndStep& other) {
    if (other.empty) return;
    add_difference(other.step);
    add(other.low);
    add(other.high);
  }

 private:
  void add_difference(UInt d) {
    if (d == 0 || step == 1) return;
    constexpr UInt kShort = ~std::uint64_t{0};
    if (step != 0 && (d | step) <= kShort &&
        static_cast<std::uint64_t>(d) % static_cast<std::uint64_t>(step) == 0) {
      return;
    }
    step = static_cast<UInt>(scene_detail::gcd_of(UInt128{step}, UInt128{d}));
  }
};

template <class Int, class UInt>
ExactGrid make_grid_in_machine_integers(std::span<const Position* const> points,
                                        const CommonUnit& unit) {
  const NarrowScale<Int> scale(unit);
  using Box = BoxAndStep<Int, UInt>;
  Box box;
  for (const Box& piece :
       scene_detail::map_pieces(points.size(), scene_detail::kPieceOfCheapElements,
                                [&](std::size_t begin, std::size_t end) {
                                  Box result;
                                  for (std::size_t i = begin; i < end; ++i) {
                                    const Position& p = *points[i];
                                    result.add(std::array{scale(p[0]), scale(p[1]), scale(p[2])});
                                  }
                                  return result;
                                })) {
    box.add(piece);
  }
  const std::array<Int, 3>& low = box.low;
  UInt top = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    top = std::max(top, static_cast<UInt>(box.high[k] - low[k]));
  }
  const UInt step = box.step == 0 ? 1 : box.step;

  ExactGrid grid;
  const mpq_class unit_length = unit_value(unit);
  grid.step = top == 0 ? mpq_class(1) : mpq_class(unit_length * to_mpz(UInt128{step}));
  for (std::size_t k = 0; k < 3; ++k) grid.origin[k] = unit_length * to_mpz(low[k]);
  const UInt largest = top / step;
  if ((largest >> GridPositions::kNarrowBits) == 0) {
    grid.bits = static_cast<unsigned>(std::bit_width(static_cast<std::uint64_t>(largest)));
    scene_detail::resize_in_large_pages(grid.narrow, 3 * points.size());
    const bool short_values = top <= ~std::uint64_t{0};  // so is the step
    scene_detail::for_each_index(points.size(), [&](std::size_t i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto d = static_cast<UInt>(scale((*points[i])[k]) - low[k]);
        grid.narrow[3 * i + k] = static_cast<std::int64_t>(
            step == 1      ? static_cast<std::uint64_t>(d)
            : short_values ? static_cast<std::uint64_t>(d) / static_cast<std::uint64_t>(step)
                           : static_cast<std::uint64_t>(d / step));
      }
    });
    return grid;
  }
  std::vector<mpz_class> coordinates(3 * points.size());
  scene_detail::for_each_index(points.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto d = static_cast<UInt>(scale((*points[i])[k]) - low[k]);
      coordinates[3 * i + k] = to_mpz(UInt128{d} / UInt128{step});
    }
  });
  fill_narrow_or_wide(grid, std::move(coordinates));
  return grid;
}

ExactGrid make_grid_in_gmp_integers(std::span<const Position* const> points,
                                    const CommonUnit& unit) {
  WideScale scale(unit);
  std::vector<mpz_class> coordinates;
  coordinates.reserve(3 * points.size());
  std::array<mpz_class, 3> low;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      coordinates.push_back(scale((*points[i])[k]));
      if (i == 0 || coordinates.back() < low[k]) low[k] = coordinates.back();
    }
  }
  mpz_class step = 0;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    coordinates[i] -= low[i % 3];
    if (step != 1) step = gcd(step, coordinates[i]);
  }
  ExactGrid grid;
  const mpq_class unit_length = unit_value(unit);
  if (step != 0) {
    for (mpz_class& c : coordinates) mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), step.get_mpz_t());
    grid.step = unit_length * step;
  }
  for (std::size_t k = 0; k < 3; ++k) grid.origin[k] = unit_length * low[k];
  fill_narrow_or_wide(grid, std::move(coordinates));
  return grid;
}

}  // namespace

ExactGrid make_grid(std::span<const Position* const> points) {
  CommonUnit unit;
  for (const CommonUnit& piece :
       scene_detail::map_pieces(points.size(), scene_detail::kPieceOfCheapElements,
                                [&](std::size_t begin, std::size_t end) {
                                  CommonUnit result;
                                  for (std::size_t i = begin; i < end; ++i) {
                                    for (const Number& number : *points[i]) result.add(number);
                                  }
                                  return result;
                                })) {
    unit.add(piece);
  }
  if (unit.fits_integers_of(64)) {
    return make_grid_in_machine_integers<std::int64_t, std::uint64_t>(points, unit);
  }
  if (unit.fits_integers_of(128)) {
    return make_grid_in_machine_integers<Int128, UInt128>(points, unit);
  }
  return make_grid_in_gmp_integers(points, unit);
}

std::array<mpz_class, 3> primitive_direction(const Position& vector) {
  CommonUnit unit;
  for (const Number& number : vector) unit.add(number);
  WideScale scale(unit);
  std::array<mpz_class, 3> result;
  mpz_class common = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    result[k] = scale(vector[k]);
    common = gcd(common, result[k]);
  }
  if (common > 1) {
    for (mpz_class& c : result) c /= common;
  }
  return result;
}

}  // namespace gnomon
