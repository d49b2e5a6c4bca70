// SPDX-License-Identifier: LGPL-3.0-or-later
#include "result/told_shares.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include "gnomon/scene/number.h"

namespace gnomon {

namespace {

constexpr const char* kForms = "a number, \"p/q\", or an object with \"fraction\" or \"area\"";

/// How a decimal was written.
struct Digits {
  int last = 0;         // the last digit stands for 10^last
  int significant = 0;  // from the first that is not 0 on
};

/// Requires: a text that Number::parse() takes.
Digits digits_of(std::string_view text) {
  // Far beyond what numbers may be; a zero may have any exponent.
  constexpr int kMost = 8192;
  Digits digits;
  const std::size_t mark = text.find_first_of("eE");
  if (mark != std::string_view::npos) {
    std::string_view power = text.substr(mark + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    const auto [end, failure] =
        std::from_chars(power.data(), power.data() + power.size(), digits.last);
    if (failure != std::errc()) digits.last = power.starts_with('-') ? -kMost : kMost;
    text = text.substr(0, mark);
  }
  digits.last = std::clamp(digits.last, -kMost, kMost);
  bool decimals = false;
  for (const char c : text) {
    if (c == '.') decimals = true;
    if (c < '0' || c > '9') continue;
    if (decimals) --digits.last;
    if (digits.significant > 0 || c != '0') ++digits.significant;
  }
  return digits;
}

/// Half of 10^power.
mpq_class half_unit(int power) {
  mpz_class ten;
  mpz_ui_pow_ui(ten.get_mpz_t(), 10, static_cast<unsigned long>(std::abs(power)));
  mpq_class half = power < 0 ? mpq_class(1, ten) : mpq_class(ten);
  half /= 2;
  return half;
}

/// Of a polygon: the distance of doubles at 1; of an area as large as the value, the same of it.
mpq_class least_rounding(const mpq_class& value, bool is_area) {
  const mpq_class least = 0x1p-52;
  return is_area ? mpq_class(least * abs(value)) : least;
}

// As many digits as every double keeps in text and back, and no more.
constexpr int kDigitsOfDouble = 15;

bool is_whole(const ToldShare& share) {
  return !share.is_area && share.rounding != 0 && (share.value == 0 || share.value == 1);
}

class ToldShareReader {
 public:
  explicit ToldShareReader(const JsonFields& fields) : fields_(fields) {}

  Expected<ToldShare> read(const Json& value, LightState state, const std::string& pointer) const {
    if (!value.IsObject()) return amount(value, state, false, pointer);
    for (const char* key : {"fraction", "area"}) {
      const auto found = value.FindMember(key);
      if (found == value.MemberEnd()) continue;
      return amount(found->value, state, *key == 'a', pointer + '/' + key);
    }
    return unknown(value, pointer);
  }

 private:
  tl::unexpected<Error> unknown(const Json& value, const std::string& pointer) const {
    return fields_.wrong(ErrorCode::kFormat, pointer,
                         JsonFields::form_of(value) + " is no share of the polygon", kForms);
  }

  Expected<ToldShare> amount(const Json& value, LightState state, bool is_area,
                             const std::string& pointer) const {
    ToldShare share;
    share.state = state;
    share.is_area = is_area;
    std::string_view text = JsonFields::number_text(value);
    if (text.empty()) {
      text = JsonFields::string_text(value);
      if (auto rational = parse_rational(text)) {
        share.value = std::move(*rational);
        share.text = text;
        return share;
      }
    }
    if (text.empty()) return unknown(value, pointer);
    const Expected<Number> number = Number::parse(text, NumberMeaning::kDecimal);
    if (!number && number.error().code == ErrorCode::kLimit) {
      return fields_.wrong(ErrorCode::kLimit, pointer, number.error().what,
                           number.error().expected);
    }
    if (!number) return unknown(value, pointer);
    share.value = number->exact();
    share.text = text;
    share.rounding =
        std::max(half_unit(digits_of(text).last), least_rounding(share.value, is_area));
    return share;
  }

  const JsonFields& fields_;
};

}  // namespace

Expected<std::vector<ToldShare>> read_told_shares(const JsonFields& fields, const Json& polygon,
                                                  const std::string& pointer) {
  std::vector<ToldShare> shares;
  for (const LightState state :
       {LightState::kLit, LightState::kShadow, LightState::kPenumbra, LightState::kUmbra}) {
    const auto found = polygon.FindMember(name_of(state));
    if (found == polygon.MemberEnd()) continue;
    Expected<ToldShare> share = ToldShareReader(fields).read(
        found->value, state, fmt::format("{}/{}", pointer, name_of(state)));
    if (!share) return tl::unexpected(share.error());
    shares.push_back(std::move(*share));
  }
  return shares;
}

void finish_told_shares(std::vector<ClaimedLight>& lights) {
  const auto for_each_rounded = [&](const auto& act) {
    for (ClaimedLight& light : lights) {
      for (ClaimedPolygon& polygon : light.polygons) {
        for (ToldShare& share : polygon.told) {
          if (share.rounding != 0) act(share);
        }
      }
    }
  };
  int last = 0, significant = 0;
  bool doubles = false;
  for_each_rounded([&](const ToldShare& share) {
    const Digits digits = digits_of(share.text);
    doubles = doubles || digits.significant >= kDigitsOfDouble;
    if (share.is_area) return;
    last = std::min(last, digits.last);
    significant = std::max(significant, digits.significant);
  });
  constexpr int kAlone = -9;
  const mpq_class of_zero = half_unit(last == 0 ? kAlone : last);
  const mpq_class of_one =
      last == 0 ? half_unit(kAlone) : half_unit(std::max(last, 1 - significant));
  for_each_rounded([&](ToldShare& share) {
    share.is_double = doubles;
    if (!is_whole(share)) return;
    const mpq_class least = least_rounding(share.value, false);
    share.rounding = std::max(share.value == 0 ? of_zero : of_one, least);
  });
  for (ClaimedLight& light : lights) {
    for (ClaimedPolygon& polygon : light.polygons) {
      for (const ToldShare& share : polygon.told) {
        if (share.is_area || share.state != LightState::kLit) continue;
        polygon.share.lower = mpq_class(share.value - share.rounding).get_d();
        polygon.share.upper = mpq_class(share.value + share.rounding).get_d();
      }
    }
  }
}

}  // namespace gnomon
