// SPDX-License-Identifier: LGPL-3.0-or-later
// Digits and characters eight at a time, as the bytes of one integer: numbers of different lengths
// then take one way through the code, where a loop over their digits would be mispredicted at each
// end.
#ifndef GNOMON_SCENE_JSON_EIGHT_CHARACTERS_H
#define GNOMON_SCENE_JSON_EIGHT_CHARACTERS_H

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace gnomon::eight_characters {

inline constexpr std::uint64_t kEveryByte = 0x0101010101010101u;
inline constexpr std::uint64_t kHighBits = 0x80 * kEveryByte;

/// Eight bytes, the first of them lowest.
inline std::uint64_t load_eight(const char* at) {
  std::uint64_t word = 0;
  std::memcpy(&word, at, sizeof word);
  if constexpr (std::endian::native == std::endian::big) word = __builtin_bswap64(word);
  return word;
}

/// The number of bytes below the lowest one that is marked by its high bit.
inline std::ptrdiff_t bytes_below(std::uint64_t marks) { return std::countr_zero(marks) >> 3; }

/// Marks bytes that are no decimal digits, given the text XOR "00000000"; exact up to the lowest.
inline std::uint64_t no_digits(std::uint64_t word) {
  return ((word + 0x76 * kEveryByte) | word) & kHighBits;
}

/// The number whose decimal digits are the bytes of a word, the first digit lowest.
inline std::uint64_t value_of_digits(std::uint64_t word) {
  word = (word * 10 + (word >> 8)) & 0x00ff00ff00ff00ffu;
  word = (word * 100 + (word >> 16)) & 0x0000ffff0000ffffu;
  return (word * 10000 + (word >> 32)) & 0xffffffffu;
}

/// Marks the bytes at which the run of a string's plain characters ends: the quote, a backslash,
/// control characters and whatever is not ASCII; exact up to the lowest.
inline std::uint64_t not_plain(std::uint64_t word) {
  const auto equal = [word](unsigned char c) {
    const std::uint64_t difference = word ^ (c * kEveryByte);
    return (difference - kEveryByte) & ~difference;
  };
  return (equal('"') | equal('\\') | ((word - 0x20 * kEveryByte) & ~word) | word) & kHighBits;
}

inline constexpr std::uint64_t kPowersOfTen[] = {1,      10,      100,      1000,     10000,
                                                 100000, 1000000, 10000000, 100000000};

}  // namespace gnomon::eight_characters

#endif  // GNOMON_SCENE_JSON_EIGHT_CHARACTERS_H
