// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are broken a little, by rule.
#ifndef GNOMON_TESTS_SCENE_IO_MUTATED_H
#define GNOMON_TESTS_SCENE_IO_MUTATED_H

#include <algorithm>
#include <random>
#include <string>
#include <string_view>

namespace gnomon {

/// The text with one to four bytes or short runs changed, doubled, lost or cut off.
inline std::string mutated(const std::string& text, std::mt19937_64& random) {
  static constexpr std::string_view kTelling = "0123456789+-.eE,:[]{}\" \n\\#/vfxnaif\0\xFF";
  std::string result = text;
  for (auto n = random() % 4 + 1; n > 0 && !result.empty(); --n) {
    const std::size_t at = random() % result.size();
    const std::size_t length = std::min<std::size_t>(random() % 12, result.size() - at);
    switch (random() % 6) {
      case 0:
        result[at] = static_cast<char>(random());
        break;
      case 1:
      case 2:
        result[at] = kTelling[random() % kTelling.size()];
        break;
      case 3:
        result.erase(at, length);
        break;
      case 4:
        result.insert(at, result.substr(random() % result.size(), length));
        break;
      default:
        result.resize(at);
        break;
    }
  }
  return result;
}

}  // namespace gnomon

#endif  // GNOMON_TESTS_SCENE_IO_MUTATED_H
