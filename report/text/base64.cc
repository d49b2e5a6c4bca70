// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/text/base64.h"

#include <cstdint>
#include <string_view>

namespace gnomon::report {

std::string base64_of(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  constexpr std::size_t kGroup = 3, kDigitsOfGroup = 4;
  constexpr unsigned kBits = 6, kMask = 63, kByte = 8;
  std::string text;
  text.reserve((bytes.size() + kGroup - 1) / kGroup * kDigitsOfGroup);
  for (std::size_t i = 0; i < bytes.size(); i += kGroup) {
    std::uint32_t group = 0;
    const std::size_t have = bytes.size() - i < kGroup ? bytes.size() - i : kGroup;
    for (std::size_t k = 0; k < kGroup; ++k) {
      group = group << kByte | (k < have ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    }
    for (std::size_t k = 0; k < kDigitsOfGroup; ++k) {
      const auto shift = static_cast<unsigned>(kDigitsOfGroup - 1 - k) * kBits;
      text += k <= have ? kDigits[group >> shift & kMask] : '=';
    }
  }
  return text;
}

}  // namespace gnomon::report
