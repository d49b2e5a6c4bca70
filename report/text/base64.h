// SPDX-License-Identifier: GPL-3.0-or-later
// Arrays of numbers as base64 (RFC 4648) of their little-endian bytes: what pages hold by the
// million.
#ifndef GNOMON_REPORT_TEXT_BASE64_H
#define GNOMON_REPORT_TEXT_BASE64_H

#include <bit>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>

namespace gnomon::report {

std::string base64_of(std::span<const std::byte> bytes);

template <class Number>
requires(std::is_arithmetic_v<Number>) std::string base64_of(std::span<const Number> numbers) {
  static_assert(std::endian::native == std::endian::little);
  return base64_of(std::as_bytes(numbers));
}

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_TEXT_BASE64_H
