// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef GNOMON_CLI_COMMON_HEAP_H
#define GNOMON_CLI_COMMON_HEAP_H

namespace gnomon::cli {

/// Makes the memory that a large scene needs cheap: most is taken from one heap in large pages,
/// and is kept when it is freed. Otherwise every array is given back to the system as soon as it
/// is freed and taken anew, and the first touch of each small page takes 1.5 to 2 us, of which
/// 10,000 polygons need some 6,000. Only where nobody limits the memory of the process, for the
/// heap's addresses are asked for beforehand; the memory itself is not. Call it before the first
/// large allocation.
void prefer_a_heap_in_large_pages();

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_HEAP_H
