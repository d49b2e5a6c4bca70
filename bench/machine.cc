// SPDX-License-Identifier: GPL-3.0-or-later
#include "machine.h"

#include <fmt/format.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

namespace gnomon::bench {

std::string machine_text() {
  std::string processor = "unknown processor", line;
  std::ifstream cpuinfo("/proc/cpuinfo");
  while (std::getline(cpuinfo, line)) {
    if (line.starts_with("model name") && line.find(": ") != std::string::npos) {
      processor = line.substr(line.find(": ") + 2);
      break;
    }
  }
#if defined(__clang__)
  const std::string compiler = fmt::format("clang {}", __clang_version__);
#else
  const std::string compiler = fmt::format("g++ {}", __VERSION__);
#endif
  const char* commit = std::getenv("GNOMON_BENCH_COMMIT");
  return fmt::format("machine:  {}, {} processors\ncompiler: {}\nflags:    {}\ncommit:   {}\n",
                     processor, std::thread::hardware_concurrency(), compiler, GNOMON_BENCH_FLAGS,
                     commit == nullptr ? "unknown (run through ./dev bench)" : commit);
}

double cpu_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

std::size_t bytes_in_use() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

}  // namespace gnomon::bench
