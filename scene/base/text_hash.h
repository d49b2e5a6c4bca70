// SPDX-License-Identifier: LGPL-3.0-or-later
// 64 bits of a text (FNV-1a), the same on every machine: for names and for what was tried before,
// where nobody means harm.
#ifndef GNOMON_SCENE_BASE_TEXT_HASH_H
#define GNOMON_SCENE_BASE_TEXT_HASH_H

#include <cstdint>
#include <string_view>

namespace gnomon {

/// The hash of a text that comes in parts.
class TextHash {
 public:
  void add(unsigned char byte) { hash_ = (hash_ ^ byte) * 0x100000001b3u; }
  void add(std::string_view part) {
    for (const char c : part) add(static_cast<unsigned char>(c));
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

inline std::uint64_t text_hash(std::string_view text) {
  TextHash hash;
  hash.add(text);
  return hash.value();
}

}  // namespace gnomon

#endif  // GNOMON_SCENE_BASE_TEXT_HASH_H
