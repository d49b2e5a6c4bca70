// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon lines --check: hidden lines held against the oracle.
#ifndef GNOMON_CLI_COMMANDS_LINES_CHECK_H
#define GNOMON_CLI_COMMANDS_LINES_CHECK_H

#include <cstdint>
#include <optional>
#include <string>

#include "gnomon/algorithms/hidden_lines.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::cli {

struct LinesVerdict {
  std::uint64_t edges = 0, points = 0;  // that were judged
  std::uint64_t every = 1;              // every so-manieth edge was
  std::uint64_t wrong = 0;
  /// The first edge that is wrong: "edge 17: found 0 to 1; the oracle has 0 to 1/2, 1 to 1".
  std::optional<std::string> first_wrong;
};

/// All parts of each edge against those that the oracle finds from each polygon by itself, and the
/// middle of each part against the segment from it to the eye. Above 10^7 pairs of an edge and a
/// polygon every n-th edge is judged. Errors: kInterrupted.
Expected<LinesVerdict> check_lines(const PreparedScene& scene, const PreparedLight& light,
                                   const HiddenLines& lines);

/// "12,345 edges, 23,456 points: identical".
std::string verdict_text(const LinesVerdict& verdict);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_LINES_CHECK_H
