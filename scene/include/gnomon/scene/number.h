// SPDX-License-Identifier: LGPL-3.0-or-later
// One coordinate as the scene means it: exactly a dyadic rational (a double) or exactly a decimal
// fraction. 16 bytes; a mantissa beyond 63 bits lives on the heap.
//
// Exactness: exact() is the coordinate itself; nearest() is the double nearest to it, ties to even
// (an infinity or 0 for a decimal beyond the range of doubles).
#ifndef GNOMON_SCENE_NUMBER_H
#define GNOMON_SCENE_NUMBER_H

#include <gmpxx.h>

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
  explicit Number(double value);
  Number(const Number& other);
  Number(Number&& other) noexcept;
  Number& operator=(Number other) noexcept;
  ~Number();

  /// mantissa * base^exponent, base 2 or 10; normalised (no factor of the base left in the
  /// mantissa).
  static Number from_decimal(mpz_class mantissa, std::int32_t exponent);
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

  double nearest() const;
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
