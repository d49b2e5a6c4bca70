// SPDX-License-Identifier: GPL-3.0-or-later
// The words of gnomon_bench's command line, read.
#ifndef GNOMON_BENCH_ARGUMENTS_H
#define GNOMON_BENCH_ARGUMENTS_H

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::bench {

enum class Extent {
  kShort,  // seconds: smaller scenes, for continuous integration
  kUsual,
  kLong,  // a million polygons, slow exact kernels at full size, more repetitions
};

struct Arguments {
  Extent extent = Extent::kUsual;
  std::vector<std::string> parts;  // as named, each once; none: those that run usually
  std::string against;             // another build's gnomon command, or empty
  std::string plots;               // a folder for the figures of the papers, or empty
  bool json = false;
  bool help = false;

  bool names(std::string_view part) const { return std::ranges::count(parts, part) > 0; }
};

struct ArgumentsRead {
  Arguments arguments;
  std::string complaint;  // what is wrong; empty: nothing
};

/// `words`: without the program's name. `parts`: the names of all parts.
ArgumentsRead read_arguments(std::span<const std::string_view> words,
                             std::span<const std::string_view> parts);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_ARGUMENTS_H
