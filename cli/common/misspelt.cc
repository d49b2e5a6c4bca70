// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/misspelt.h"

#include <algorithm>
#include <cstddef>

namespace gnomon::cli {

namespace {

/// Reference: F. J. Damerau, A technique for computer detection and correction of spelling errors,
/// 1964, in the form that swaps no letters that were changed (optimal string alignment).
std::size_t mistakes_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest_word(std::string_view typed, const std::vector<std::string>& words) {
  std::string nearest;
  std::size_t least = typed.size() / 3 + 1;
  for (const std::string& word : words) {
    const std::size_t mistakes = mistakes_between(typed, word);
    if (mistakes >= least) continue;
    least = mistakes;
    nearest = word;
  }
  return nearest;
}

}  // namespace gnomon::cli
