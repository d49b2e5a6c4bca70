// SPDX-License-Identifier: GPL-3.0-or-later
// What a result says in sixteen letters: of the fractions of all parts, not of fragments, which
// methods cut differently.
#ifndef GNOMON_COMPARISON_ANSWER_CHECKSUM_H
#define GNOMON_COMPARISON_ANSWER_CHECKSUM_H

#include <string>

#include "gnomon/algorithms/shadow_result.h"

namespace gnomon::comparison {

/// FNV-1a, 64 bits, of "light part p/q", and of penumbras, of every part. Requires: the result was
/// computed with exact_fractions on an exact kernel. All right answers have the same.
std::string exact_checksum(const ShadowResult& result);
/// The same of the shortest decimals of rounded fractions.
std::string rounded_checksum(const ShadowResult& result);

}  // namespace gnomon::comparison

#endif  // GNOMON_COMPARISON_ANSWER_CHECKSUM_H
