// SPDX-License-Identifier: GPL-3.0-or-later
// Success proven by borders against success measured: on the same claims both give one verdict, and
// what borders bound holds what the overlay of exact regions measures.
#ifndef GNOMON_FUZZ_CHECK_BORDER_CHECK_H
#define GNOMON_FUZZ_CHECK_BORDER_CHECK_H

#include <cstdint>
#include <optional>
#include <string>

#include "fuzz/check/judged_scene.h"

namespace gnomon::fuzz {

/// Where the two ways differ.
struct BorderContradiction {
  std::string kind;            // "verdict" or "bounds"
  std::string light, polygon;  // empty for a verdict
  std::string text;            // one sentence
};

/// Judges `claims` in both ways, at a tolerance and a width that `seed` chooses, so that some are
/// met by little and some are missed by little: from 1e-2 to 1e-16 of a polygon and to 1e-13 of the
/// scene's diagonal, since widths are measured to 2^-46 of the size of their region. Errors: those
/// of oracle::certify().
Expected<std::optional<BorderContradiction>> border_contradiction(const JudgedScene& scene,
                                                                  const Claims& claims,
                                                                  std::uint64_t seed);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_BORDER_CHECK_H
