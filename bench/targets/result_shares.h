// SPDX-License-Identifier: GPL-3.0-or-later
// The lit shares that a result file tells, whichever build wrote it.
#ifndef GNOMON_BENCH_TARGETS_RESULT_SHARES_H
#define GNOMON_BENCH_TARGETS_RESULT_SHARES_H

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::bench {

struct ResultShare {
  std::string exact;            // "p/q" as written; empty in a result with nearest doubles
  double lower = 0, upper = 0;  // certified bounds, where a number is written
};
/// By "light polygon side".
using ResultShares = std::map<std::string, ResultShare>;

/// None: this is no result of `gnomon shadows`, or one without lit shares.
std::optional<ResultShares> parse_shares(const std::string& text);
/// Ends the program with a message where there is nothing to read.
ResultShares read_shares(const std::string& path);

/// FNV-1a, 64 bits, of "light polygon side p/q" of all, in the order of these words.
std::string checksum(const ResultShares& shares);
/// Whether both tell of the same sides of the same polygons, and all bounds overlap.
bool bounds_overlap(const ResultShares& a, const ResultShares& b);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_TARGETS_RESULT_SHARES_H
