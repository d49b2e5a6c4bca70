// SPDX-License-Identifier: GPL-3.0-or-later
// What the parts of `gnomon_bench papers` share: the setting of the papers' programs, and Slater's
// rooms.
#ifndef GNOMON_BENCH_PAPERS_H
#define GNOMON_BENCH_PAPERS_H

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "arguments.h"
#include "gnomon/algorithms/shadows.h"

namespace gnomon::bench {

/// No balanced prefix, no merging of sibling fragments.
ShadowOptions paper_options(std::vector<std::uint32_t> lights);
/// The same in doubles without identity: an edge that a split made gets a plane and a node of its
/// own, as every edge does in the paper's program; with identity it is the plane that split it.
ShadowOptions plane_of_every_edge(ShadowOptions options);

/// "ours / printed".
std::string beside(const std::string& ours, const std::string& printed);

/// Slater's three, in his order.
inline constexpr std::array<std::string_view, 3> kSlatersMethods = {"basic", "tiling", "svbsp"};
template <class T>
using ByMethod = std::array<T, kSlatersMethods.size()>;

/// Times of his methods in one setting over rooms, as printed or as measured.
struct RoomSeries {
  std::string machine;         // "SparcStation 1+", or a kernel
  std::string lamps;           // "one lamp", ...
  std::vector<double> pieces;  // of the scene BSP
  ByMethod<std::vector<double>> milliseconds;
};

/// His Tables 1 and 2, timed again on rooms and tetrahedra of ours, and fits as he gives them. If
/// `plots` is not empty his Figures 9 to 12 are written to that folder. False if a file cannot be
/// written.
bool slater_times(Extent extent, const std::string& plots);

/// Figures 9 to 12: what he printed, and ours beside it, as SVG. `ours`: kernels and lamps as
/// slater_times() measures them.
std::string slater_figures(const std::vector<RoomSeries>& printed,
                           const std::vector<RoomSeries>& ours);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_PAPERS_H
