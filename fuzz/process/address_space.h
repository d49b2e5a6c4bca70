// SPDX-License-Identifier: GPL-3.0-or-later
// How much address space this process has taken: limits are set on top of it, since with sanitizers
// it is terabytes before anything is done.
#ifndef GNOMON_FUZZ_PROCESS_ADDRESS_SPACE_H
#define GNOMON_FUZZ_PROCESS_ADDRESS_SPACE_H

#include <unistd.h>

#include <cstdint>
#include <fstream>

namespace gnomon::fuzz {

/// The size in bytes; 0 where the system does not tell.
inline std::uint64_t address_space_taken() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages = 0;
  file >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_PROCESS_ADDRESS_SPACE_H
