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

class WrittenNumbers {
 public:
  void add(const WrittenNumber& number);
  WrittenNumber operator[](std::size_t index) const;
  std::size_t size() const { return codes_.size(); }
  /// The most that any number without an exponent has: programs leave out zeros at the end, and so
  /// one number alone does not tell how many digits were meant.
  std::int32_t most_decimals() const { return most_decimals_; }
  std::int32_t most_digits() const { return most_digits_; }

  /// How far the exact value may be from a number of this table: half a unit of its last digit. One
  /// with fewer decimals and fewer digits than the table has had zeros at its end, as many as its
  /// decimals or its digits lack, whichever allows more.
  double rounding_of(const WrittenNumber& number) const;

 private:
  struct Wide {
    double value;
    std::int16_t decimals, digits;
    bool has_exponent;
  };
  std::vector<std::uint32_t> codes_;  // decimals and digits, or an index into wide_
  std::vector<Wide> wide_;
  std::int32_t most_decimals_ = 0, most_digits_ = 0;
};

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ENGINE_TABLES_WRITTEN_NUMBER_H
