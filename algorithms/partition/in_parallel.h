// SPDX-License-Identifier: LGPL-3.0-or-later
// Work on ranges, in one call or on the threads of the arena that the caller is in.
#ifndef GNOMON_ALGORITHMS_PARTITION_IN_PARALLEL_H
#define GNOMON_ALGORITHMS_PARTITION_IN_PARALLEL_H

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstdint>

namespace gnomon {

/// Calls body(begin, end) for ranges of [0, n): one of all of it if `jobs` is 1, else several, at
/// the same time, of about `grain` and more.
template <class Body>
void in_parallel(unsigned jobs, std::uint32_t n, std::uint32_t grain, const Body& body) {
  if (jobs == 1 || n <= grain) {
    if (n > 0) body(std::uint32_t{0}, n);
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, n, grain),
                    [&](const auto& range) { body(range.begin(), range.end()); });
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_PARTITION_IN_PARALLEL_H
