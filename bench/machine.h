// SPDX-License-Identifier: GPL-3.0-or-later
// What the figures were taken on.
#ifndef GNOMON_BENCH_MACHINE_H
#define GNOMON_BENCH_MACHINE_H

#include <cstddef>
#include <string>

namespace gnomon::bench {

/// Processor, compiler, flags and commit, one line each.
std::string machine_text();
/// CPU time of this process in seconds.
double cpu_seconds();
/// Bytes that the allocator has given out.
std::size_t bytes_in_use();

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_MACHINE_H
