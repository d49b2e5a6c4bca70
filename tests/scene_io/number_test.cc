// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/scene/number.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace gnomon {
namespace {

constexpr auto kDouble = NumberMeaning::kDouble;
constexpr auto kDecimal = NumberMeaning::kDecimal;

Number parsed(std::string_view text, NumberMeaning meaning) {
  auto number = Number::parse(text, meaning);
  EXPECT_TRUE(number) << text;
  return number ? *number : Number();
}

ErrorCode code(std::string_view text, NumberMeaning meaning) {
  const auto number = Number::parse(text, meaning);
  EXPECT_FALSE(number) << text;
  return number ? ErrorCode::kInterrupted : number.error().code;
}

TEST(Number, TakesEveryFormOfANumber) {
  for (const auto meaning : {kDouble, kDecimal}) {
    EXPECT_EQ(parsed("2.", meaning).exact(), 2);
    EXPECT_EQ(parsed("+2.e1", meaning).exact(), 20);
    EXPECT_EQ(parsed("-.5E+3", meaning).exact(), -500);
    EXPECT_EQ(parsed("0.25", meaning).exact(), mpq_class(1, 4));
    EXPECT_EQ(parsed("-0", meaning).exact(), 0);
    EXPECT_EQ(parsed("0e99999999999999999999", meaning).exact(), 0);
    EXPECT_EQ(parsed("00012.500", meaning).exact(), mpq_class(25, 2));
    EXPECT_FALSE(std::signbit(parsed("-0.0", meaning).nearest()));
  }
}

TEST(Number, RefusesWhatIsNone) {
  for (const auto meaning : {kDouble, kDecimal}) {
    for (const char* text :
         {"",     "+",  "-",  ".",      "e5",  "1e",    "1e+", "1..2", "1.2.3",    "--1",   "+-1",
          "0x10", "1 ", " 1", "3.1+e2", "1,5", "1e5.5", "nan", "-inf", "INFINITY", "1.#IND"}) {
      EXPECT_EQ(code(text, meaning), ErrorCode::kNumber) << text;
    }
  }
}

TEST(Number, DecimalsAreExactAndDoublesNearest) {
  EXPECT_EQ(parsed("0.1", kDecimal).exact(), mpq_class(1, 10));
  EXPECT_EQ(parsed("0.1", kDouble).exact(), mpq_class(0.1));
  EXPECT_FALSE(parsed("0.1", kDecimal) == parsed("0.1", kDouble));
  EXPECT_EQ(parsed("0.5", kDecimal), parsed("0.5", kDouble));
  EXPECT_EQ(parsed("2.50e1", kDecimal), parsed("25", kDecimal));
  EXPECT_EQ(parsed("0.1", kDecimal).nearest(), 0.1);
  // 2^53 + 1 is a tie, to even.
  EXPECT_EQ(parsed("9007199254740993", kDecimal).nearest(), 9007199254740992.0);
  EXPECT_EQ(parsed("9007199254740993", kDouble).nearest(), 9007199254740992.0);
  EXPECT_EQ(parsed("9007199254740993.0000000000000000000000000001", kDecimal).nearest(),
            9007199254740994.0);
}

TEST(Number, OverflowIsAnErrorAndUnderflowAWarning) {
  EXPECT_EQ(code("1e309", kDouble), ErrorCode::kNumber);
  EXPECT_EQ(code("-1.7976931348623159e308", kDouble), ErrorCode::kNumber);
  EXPECT_EQ(code("1e99999999999999999999999", kDouble), ErrorCode::kNumber);
  const std::pair<const char*, bool> cases[] = {{"1e-300", false},
                                                {"1e-310", true},
                                                {"1e-400", true},
                                                {"-1e-99999999999999999999", true},
                                                {"2.2250738585072014e-308", false},
                                                {"0.0000", false}};
  for (const auto& [text, expected] : cases) {
    bool underflow = false;
    EXPECT_TRUE(Number::parse(text, kDouble, &underflow));
    EXPECT_EQ(underflow, expected) << text;
  }
  // All digits of a subnormal: nothing is lost.
  const std::string whole = *Number(5e-324).to_text(kDecimal);
  bool underflow = false;
  EXPECT_EQ(*Number::parse(whole, kDouble, &underflow), Number(5e-324));
  EXPECT_FALSE(underflow);
}

TEST(Number, DecimalsHaveLimits) {
  EXPECT_EQ(parsed("1e4096", kDecimal).to_text(), "1e4096");
  EXPECT_EQ(parsed("1e-4096", kDecimal).to_text(), "1e-4096");
  EXPECT_EQ(code("1e4097", kDecimal), ErrorCode::kLimit);
  EXPECT_EQ(code("10e4096", kDecimal), ErrorCode::kLimit);
  EXPECT_EQ(code("1e-4097", kDecimal), ErrorCode::kLimit);
  EXPECT_EQ(code("1e999999999999999999999999", kDecimal), ErrorCode::kLimit);
  EXPECT_EQ(code("1e-999999999999999999999999", kDecimal), ErrorCode::kLimit);
  EXPECT_TRUE(Number::parse(std::string(1000, '7'), kDecimal));
  EXPECT_EQ(code(std::string(1001, '7'), kDecimal), ErrorCode::kLimit);
  EXPECT_EQ(code("0." + std::string(1001, '7'), kDecimal), ErrorCode::kLimit);
  // Zeros at the ends are no digits.
  EXPECT_EQ(parsed("1." + std::string(5000, '0'), kDecimal).exact(), 1);
  EXPECT_EQ(parsed(std::string(5000, '0') + "1", kDecimal).exact(), 1);
  // Doubles have no limit of digits.
  EXPECT_EQ(parsed("0." + std::string(5000, '9'), kDouble).exact(), 1);
  // Beyond the doubles, a decimal has a nearest one all the same.
  EXPECT_EQ(parsed("-1e400", kDecimal).nearest(), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(parsed("1e-400", kDecimal).nearest(), 0);
}

TEST(Number, TextsArePlainAndShort) {
  const std::pair<const char*, const char*> cases[] = {
      {"0.1", "0.1"},       {"100000", "100000"},     {"1e20", "100000000000000000000"},
      {"1e22", "1e22"},     {"0.000001", "0.000001"}, {"1e-7", "1e-7"},
      {"-12.500", "-12.5"}, {"1.25e-9", "1.25e-9"},   {"3.1e2", "310"}};
  for (const auto& [text, expected] : cases) {
    EXPECT_EQ(parsed(text, kDouble).to_text(), expected);
    EXPECT_EQ(parsed(text, kDecimal).to_text(), expected);
  }
  EXPECT_EQ(parsed("1234567890123456789012345", kDecimal).to_text(), "1234567890123456789012345");
  EXPECT_EQ(Number::from_dyadic(mpz_class("18446744073709551617"), 0).to_text(),
            "18446744073709551617");
}

TEST(Number, TextUnderAMeaning) {
  EXPECT_EQ(*Number(0.1).to_text(kDouble), "0.1");
  EXPECT_EQ(*Number(0.1).to_text(kDecimal),
            "0.1000000000000000055511151231257827021181583404541015625");
  EXPECT_EQ(*parsed("0.5", kDecimal).to_text(kDouble), "0.5");
  EXPECT_EQ(parsed("0.1", kDecimal).to_text(kDouble).error().code, ErrorCode::kNumber);
  EXPECT_EQ(Number::from_decimal(1, 5000).to_text(kDecimal).error().code, ErrorCode::kLimit);
}

TEST(Number, CopiesAndMovesLargeMantissas) {
  const Number large = parsed("123456789012345678901234567890.5", kDecimal);
  Number copy = large;
  EXPECT_EQ(copy, large);
  const Number moved = std::move(copy);
  EXPECT_EQ(moved, large);
  copy = moved;
  EXPECT_EQ(copy, large);
  copy = Number(2.0);
  EXPECT_EQ(copy.exact(), 2);
  EXPECT_EQ(large.sign(), 1);
  EXPECT_EQ((-large.mantissa()), mpz_class("-1234567890123456789012345678905"));
}

double random_double(std::mt19937_64& random) {
  for (;;) {
    std::uint64_t bits = random();
    if (random() % 5 == 0) bits &= 0x800fffffffffffff;  // subnormal
    const auto value = std::bit_cast<double>(bits);
    if (std::isfinite(value)) return value;
  }
}

TEST(Number, RandomDoublesSurviveBothMeanings) {
  std::mt19937_64 random(20240611);
  for (int i = 0; i < 20000; ++i) {
    const double value = random_double(random);
    const Number number(value);
    ASSERT_EQ(number.nearest(), value);
    ASSERT_EQ(parsed(number.to_text(), kDouble), number);
    if (i % 20 != 0) continue;
    ASSERT_EQ(number.exact(), mpq_class(value));
    const Number decimal = parsed(*number.to_text(kDecimal), kDecimal);
    ASSERT_EQ(decimal, number);
    ASSERT_TRUE(decimal.is_double());
    ASSERT_EQ(decimal.nearest(), value);
  }
}

TEST(Number, RoundsTiesToEven) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 500; ++i) {
    const double low = std::abs(random_double(random));
    const double high = std::nextafter(low, std::numeric_limits<double>::infinity());
    if (!std::isfinite(high)) continue;
    const mpq_class middle = (mpq_class(low) + mpq_class(high)) / 2;
    const auto shift = static_cast<std::int32_t>(mpz_scan1(middle.get_den_mpz_t(), 0));
    const Number number = Number::from_dyadic(middle.get_num(), -shift);
    EXPECT_FALSE(number.is_double());
    const double nearest = number.nearest();
    EXPECT_TRUE(nearest == low || nearest == high);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(nearest) % 2, 0u);
  }
}

TEST(Number, RandomDecimalsAreTheirText) {
  std::mt19937_64 random(99);
  for (int i = 0; i < 5000; ++i) {
    std::string digits = std::to_string(random() % 9 + 1);
    for (auto n = random() % 40; n > 0; --n) digits += static_cast<char>('0' + random() % 10);
    const int exponent = static_cast<int>(random() % 80) - 40;
    const std::string text = digits + "e" + std::to_string(exponent);
    const Number number = parsed(text, kDecimal);
    mpq_class expected{mpz_class(digits)};
    mpz_class power;
    mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(exponent)));
    if (exponent < 0) {
      expected /= power;
    } else {
      expected *= power;
    }
    ASSERT_EQ(number.exact(), expected) << text;
    ASSERT_EQ(parsed(number.to_text(), kDecimal), number) << text;
    ASSERT_EQ(number.nearest(), parsed(text, kDouble).nearest()) << text;
  }
}

}  // namespace
}  // namespace gnomon
