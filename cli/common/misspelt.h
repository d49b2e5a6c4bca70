// SPDX-License-Identifier: GPL-3.0-or-later
// "did you mean certify?": the word that someone perhaps meant.
#ifndef GNOMON_CLI_COMMON_MISSPELT_H
#define GNOMON_CLI_COMMON_MISSPELT_H

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

/// The word nearest to what was typed, by letters left out, added, replaced or swapped with the
/// next: at most one of three of them may be wrong. Empty if no word is so near.
std::string nearest_word(std::string_view typed, const std::vector<std::string>& words);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_MISSPELT_H
