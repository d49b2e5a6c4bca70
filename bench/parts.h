// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the benchmark program; each prints its tables and returns whether all held.
#ifndef GNOMON_BENCH_PARTS_H
#define GNOMON_BENCH_PARTS_H

#include <cstdint>
#include <string>

#include "arguments.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/scene/prepare.h"

namespace gnomon::bench {

/// Every kernel on every scene: time, ratio to double, fragments, exact stage, answer. False if the
/// exact kernels' answers differ.
bool run_kernels(Extent extent);
/// Thickness of the rounded kernels' planes against wrong parts, over families of small scenes.
bool run_thickness(Extent extent);
/// Chin & Feiner 1989 and Slater 1992, ours beside what they print. `plots`: a folder for Slater's
/// figures; empty: none are written. False if one cannot be written.
bool run_papers(Extent extent, const std::string& plots);
/// Crow 1977, the comparison of the three classes: storage, time, growth, lines of code.
bool run_classes(Extent extent);
/// Thakur, Cheng & Miura: look-ups and times of their objects, their cubes beside other methods.
/// False if an order of drawing changes a sample, or near polygons first cost more look-ups.
bool run_ridge(Extent extent);
/// Several lights together: one of them moves, their orders, what trees grow from and what is kept.
bool run_lights(Extent extent);
/// Splits, depth, memory and time of the scene BSP.
bool run_scene_bsp(Extent extent);
/// Point lights: doubles, other exact numbers, peers, growth, a million polygons, threads, and what
/// the core was to reach there. False if answers differ, of exact kernels, of the methods, or of a
/// peer beyond its tolerance; a missed target is none of these.
bool run_point(Extent extent);
/// The targets of speed: ratios of this build to another one, measured in turn, and to peers.
/// `against`: that build's gnomon command; empty: its ratios are not measured. `json`: the rows as
/// JSON instead of tables. False if answers differ; a missed target is none of these.
bool run_targets(Extent extent, const std::string& against, bool json);
/// Area lights: ratios, growth, and Figure 8 of Chin & Feiner 1992. False if answers differ.
bool run_area(Extent extent);
/// Scenes that are known to hurt, n = 250 to 4,000: pieces, time, growth.
bool run_pitfalls(Extent extent);
/// Every system on every kernel, on the papers' scenes and families of hard ones, in one table.
/// False if an exact kernel is not confirmed, or exact answers differ.
bool run_systems(Extent extent);
/// Samples a second of pictures, and the oracle's time; run_systems() ends with it. False if an
/// exact sample is wrong.
bool run_pictures(Extent extent);
/// Pieces of the scene BSP of all polygons, kernel plane.
std::uint64_t scene_bsp_pieces(const PreparedScene& scene, Roots roots = Roots::kChosen);

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_PARTS_H
