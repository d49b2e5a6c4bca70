// SPDX-License-Identifier: GPL-3.0-or-later
// One number as text. A double is the one that the C library reads; what was read is written to
// the same value; a decimal's nearest double is the double of the same text.
#include "gnomon/scene/number.h"

#include <cmath>
#include <cstdlib>

#include "harness.h"

namespace {

using namespace gnomon;
using namespace gnomon::fuzzers;

void check_round_trip(const Number& number, NumberMeaning meaning) {
  const auto back = Number::parse(number.to_text(), meaning);
  require(back.has_value() && *back == number, "to_text() reads back to another value");
  if (const auto text = number.to_text(meaning)) {
    const auto again = Number::parse(*text, meaning);
    require(again.has_value() && *again == number, "to_text(meaning) reads back to another value");
  }
  require(number.sign() == sgn(number.exact()), "sign");
  require(number.is_zero() == (number.sign() == 0), "is_zero");
  Number copy = number;
  const Number moved = std::move(copy);
  require(moved == number, "a copy is another number");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(text_of(data, size));
  bool underflow = false;
  const auto as_double = Number::parse(text, NumberMeaning::kDouble, &underflow);
  const auto as_decimal = Number::parse(text, NumberMeaning::kDecimal);
  if (as_double) {
    // The grammar is a part of strtod's, which also knows hexadecimal digits, NaN and infinity.
    char* end = nullptr;
    const double expected = std::strtod(text.c_str(), &end);
    require(end == text.c_str() + text.size(), "strtod does not read all of it");
    require(as_double->nearest() == expected, "not the double that strtod reads");
    require(as_double->exact() == mpq_class(expected), "not exactly the double");
    require(as_double->is_double(), "no double");
    check_round_trip(*as_double, NumberMeaning::kDouble);
  } else {
    require(!as_double.error().what.empty(), "an error without words");
  }
  if (as_decimal) {
    check_round_trip(*as_decimal, NumberMeaning::kDecimal);
    if (as_double) {
      require(as_decimal->nearest() == as_double->nearest(), "nearest double");
    } else {
      require(std::isinf(as_decimal->nearest()), "a decimal that is no double, and no overflow");
    }
  } else {
    require(!as_double || as_decimal.error().code == ErrorCode::kLimit, "a double and no decimal");
  }
  return 0;
}
