// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as a table has them: their value, and how many digits were written, by which they are
// judged. Millions of them are held in four bytes each where they have few digits.
#ifndef GNOMON_COMPARISON_ENGINE_TABLES_WRITTEN_NUMBER_H
#define GNOMON_COMPARISON_ENGINE_TABLES_WRITTEN_NUMBER_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::comparison {

struct WrittenNumber {
  double value = 0;           // the nearest; NaN and infinity too
  std::int32_t decimals = 0;  // the last digit stands for 10^-decimals
  std::int32_t digits = 0;    // from the first that is not 0 on
  bool has_exponent = false;
};

/// "0.47", "1e-05", "nan", "inf", with or without a sign. Nothing for what is no number, or none
/// that doubles can hold.
std::optional<WrittenNumber> parse_written(std::string_view text);
/// With as many decimals as were written.
std::string text_of(const WrittenNumber& number);

/// How many digits the numbers of a file have: programs leave out zeros at the end, and so one
/// number alone does not tell how many were meant.
class WrittenDigits {
 public:
  void add(const WrittenNumber& number);
  /// The most that any number without an exponent has.
  std::int32_t most_decimals() const { return most_decimals_; }
  std::int32_t most_digits() const { return most_digits_; }
  /// Some have all digits of a double: they came so out of a computation, and nobody claims the
  /// last ones.
  bool are_doubles() const;

  /// How far the exact value may be from a number of this file: half a unit of its last digit. One
  /// with fewer decimals and fewer digits than the file has had zeros at its end, as many as its
  /// decimals or its digits lack, whichever allows more.
  double rounding_of(const WrittenNumber& number) const;

 private:
  std::int32_t most_decimals_ = 0, most_digits_ = 0;
};

/// What numbers that came out of a computation in doubles may be off by besides their digits: as
/// told_share_check.h has it.
inline constexpr double kRoundingOfDoubles = 1e-9;

class WrittenNumbers {
 public:
  void add(const WrittenNumber& number);
  WrittenNumber operator[](std::size_t index) const;
  std::size_t size() const { return codes_.size(); }
  const WrittenDigits& digits() const { return digits_; }

 private:
  struct Wide {
    double value;
    std::int16_t decimals, digits;
    bool has_exponent;
  };
  std::vector<std::uint32_t> codes_;  // decimals and digits, or an index into wide_
  std::vector<Wide> wide_;
  WrittenDigits digits_;
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ENGINE_TABLES_WRITTEN_NUMBER_H
