// SPDX-License-Identifier: LGPL-3.0-or-later
// Rationals in messages for people: exactly where that is short, else as a double would be printed.
#ifndef GNOMON_SCENE_RATIONAL_TEXT_H
#define GNOMON_SCENE_RATIONAL_TEXT_H

#include <gmpxx.h>

#include <cstddef>
#include <cstdio>
#include <string>

namespace gnomon {

/// "3/208"; "about 0.0144230769230769" where the fraction has more than 24 characters.
inline std::string text_for_people(const mpq_class& value) {
  constexpr std::size_t kMost = 24;
  std::string exact = value.get_str();
  if (exact.size() <= kMost) return exact;
  char rounded[40];
  std::snprintf(rounded, sizeof rounded, "about %.15g", value.get_d());
  return rounded;
}

}  // namespace gnomon

#endif  // GNOMON_SCENE_RATIONAL_TEXT_H
