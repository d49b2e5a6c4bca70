// SPDX-License-Identifier: GPL-3.0-or-later
// 64 bits of a text (FNV-1a), the same on every machine: for names and for what was tried before,
// where nobody means harm.
#ifndef GNOMON_FUZZ_TEXT_TEXT_HASH_H
#define GNOMON_FUZZ_TEXT_TEXT_HASH_H

#include <cstdint>
#include <string_view>

namespace gnomon::fuzz {

inline std::uint64_t text_hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_TEXT_TEXT_HASH_H
