// SPDX-License-Identifier: LGPL-3.0-or-later
// One coordinate as the scene means it: exactly a dyadic rational (a double) or exactly a decimal
// fraction. 16 bytes; a mantissa beyond 63 bits lives on the heap.
//
// Exactness: exact() is the coordinate itself; nearest() is the double nearest to it, ties to even
// (an infinity or 0 for a decimal beyond the range of doubles).
#ifndef GNOMON_SCENE_NUMBER_H
#define GNOMON_SCENE_NUMBER_H

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"

namespace gnomon {

/// How a scene's numbers are meant (docs: semantics, "numbers").
enum class NumberMeaning : std::uint8_t { kDouble, kDecimal };

class Number {
 public:
  Number() = default;
  /// Requires: finite. -0 becomes 0.
  explicit Number(double value) {
    if (value == 0) return;
    // Of a binary64: 52 bits of fraction, 11 of exponent (0 if subnormal), the sign.
    constexpr std::uint64_t kImplicitBit = std::uint64_t{1} << 52;
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto field = static_cast<std::int32_t>((bits >> 52) & 0x7ff);
    const std::uint64_t fraction = bits & (kImplicitBit - 1);
    const std::uint64_t mantissa = field == 0 ? fraction : fraction | kImplicitBit;
    const int shift = std::countr_zero(mantissa);
    const auto shifted = static_cast<std::int64_t>(mantissa >> shift);
    small_ = (bits >> 63) != 0 ? -shifted : shifted;
    exponent_ = std::max(field, 1) - 1075 + shift;
  }
  Number(const Number& other)
      : exponent_(other.exponent_), base_(other.base_), is_big_(other.is_big_) {
    if (is_big_) {
      big_ = new mpz_class(*other.big_);
    } else {
      small_ = other.small_;
    }
  }
  Number(Number&& other) noexcept { take(other); }
  Number& operator=(Number other) noexcept {
    if (is_big_) release();
    take(other);
    return *this;
  }
  ~Number() {
    if (is_big_) release();
  }

  /// mantissa * base^exponent, base 2 or 10; normalised (no factor of the base left in the
  /// mantissa).
  static Number from_decimal(mpz_class mantissa, std::int32_t exponent);
  /// The same without GMP. Requires: a magnitude below 2^63.
  static Number from_short_decimal(std::int64_t mantissa, std::int32_t exponent) {
    Number result;
    result.base_ = 10;
    if (mantissa == 0) return result;
    while (mantissa % 10 == 0) {
      mantissa /= 10;
      ++exponent;
    }
    result.small_ = mantissa;
    result.exponent_ = exponent;
    return result;
  }
  static Number from_dyadic(mpz_class mantissa, std::int32_t exponent);

  /// Reads [+-]digits[.digits][(e|E)[+-]digits], also "2." and ".5". kDouble: the double nearest to
  /// the text. Errors: kNumber (malformed, NaN, infinity, overflow), kLimit (a decimal whose first
  /// digit stands beyond 10^+-kMaxDecimalExponent, or with more than kMaxDecimalDigits digits,
  /// zeros at both ends not counted). `underflow`, if given, is set when a non-zero text became a
  /// subnormal that is not exact, or 0, and is left alone otherwise.
  static constexpr std::int32_t kMaxDecimalExponent = 4096;
  static constexpr std::size_t kMaxDecimalDigits = 1000;
  static Expected<Number> parse(std::string_view text, NumberMeaning meaning,
                                bool* underflow = nullptr);

  double nearest() const {
    // A double's own mantissa and exponent, 2^exponent normal: one exact scaling.
    if (base_ == 2 && has_exact_mantissa() && exponent_ >= -1022 && exponent_ <= 971) {
      return static_cast<double>(small_) *
             std::bit_cast<double>(static_cast<std::uint64_t>(exponent_ + 1023) << 52);
    }
    return rounded();
  }
  mpq_class exact() const;
  bool is_decimal() const { return base_ == 10; }
  /// The value is mantissa() * base^exponent(), base 10 if is_decimal(), else 2; the mantissa has
  /// no factor of the base, and 0 is 0 * base^0.
  mpz_class mantissa() const;
  std::int32_t exponent() const { return exponent_; }
  /// The mantissa as it is stored: most fit into 63 bits. small_mantissa() requires that.
  bool has_small_mantissa() const { return !is_big_; }
  std::int64_t small_mantissa() const { return small_; }
  bool is_zero() const { return !is_big_ && small_ == 0; }
  /// -1, 0 or 1.
  int sign() const;
  /// Exactly a double: nearest() is the value itself.
  bool is_double() const;

  /// Shortest text that reads back to the same value under the meaning that made it; for a dyadic
  /// value that is no double, its whole decimal expansion.
  std::string to_text() const;
  /// Shortest text that reads back to the same value under `meaning`. Errors: kNumber (a value that
  /// is no double, to be read as one), kLimit (more digits than a decimal may have).
  Expected<std::string> to_text(NumberMeaning meaning) const;
  /// Equal as numbers, whatever the base.
  friend bool operator==(const Number& a, const Number& b);

 private:
  /// Requires: a mantissa on the heap. Not inline, so that everything around it is.
  void release() noexcept;
  /// Takes the value of another, which is left with one without a mantissa on the heap. Requires:
  /// this has none.
  void take(Number& other) noexcept {
    exponent_ = other.exponent_;
    base_ = other.base_;
    is_big_ = other.is_big_;
    if (is_big_) {
      big_ = other.big_;
      other.is_big_ = false;
      other.small_ = 0;
      other.exponent_ = 0;
    } else {
      small_ = other.small_;
    }
  }
  /// Is the mantissa a double?
  bool has_exact_mantissa() const {
    constexpr std::int64_t kExactIntegers = std::int64_t{1} << 53;
    return !is_big_ && small_ <= kExactIntegers && small_ >= -kExactIntegers;
  }
  double rounded() const;
  void set(mpz_class mantissa, std::int64_t exponent, std::uint8_t base);

  union {
    std::int64_t small_ = 0;
    mpz_class* big_;
  };
  std::int32_t exponent_ = 0;
  std::uint8_t base_ = 2;
  bool is_big_ = false;
};

static_assert(sizeof(Number) == 16);

}  // namespace gnomon

#endif  // GNOMON_SCENE_NUMBER_H
