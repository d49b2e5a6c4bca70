// SPDX-License-Identifier: GPL-3.0-or-later
// Slater 1992, Tables 1 and 2: ten rooms under a lamp at the ceiling, one outside before the
// doorway, and both; recursive tetrahedra. CPU time of the shadows without the scene BSP, as in the
// paper, which every method starts from.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "answers.h"
#include "papers.h"
#include "parts.h"
#include "scene/base/output_file.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

struct PrintedRoom {
  double polygons, pieces;
  ByMethod<double> one_lamp, two_lamps;  // seconds
};
constexpr std::array<PrintedRoom, 10> kPrinted{{{138, 228, {.6, .8, 1.2}, {2.5, 2.6, 4.0}},
                                                {174, 308, {.8, .9, 1.3}, {3.2, 3.2, 4.7}},
                                                {192, 358, {1.4, 1.2, 1.7}, {5.8, 4.9, 6.3}},
                                                {210, 412, {1.0, 1.1, 1.4}, {4.3, 3.9, 4.8}},
                                                {228, 438, {1.6, 1.3, 1.7}, {6.8, 5.5, 7.0}},
                                                {264, 542, {1.8, 1.5, 1.9}, {8.2, 6.3, 7.0}},
                                                {246, 614, {2.7, 1.8, 2.4}, {10.8, 7.9, 9.6}},
                                                {264, 668, {2.4, 1.7, 2.2}, {9.4, 7.0, 8.3}},
                                                {282, 694, {3.1, 2.0, 2.5}, {12.2, 8.7, 10.4}},
                                                {318, 798, {3.5, 2.1, 2.6}, {14.0, 9.6, 10.7}}}};

struct PrintedTetrahedron {
  std::int64_t level;
  double polygons, pieces;
  ByMethod<double> seconds;
};
constexpr std::array<PrintedTetrahedron, 3> kPrintedTetrahedra{
    {{3, 65, 83, {.2, .3, .4}},
     {4, 257, 299, {1.9, 1.6, 1.6}},
     {5, 1025, 1135, {21.3, 10.8, 7.3}}}};

/// What the parameter `lights` of the rooms takes.
struct Lamps {
  std::int64_t value;
  std::string name;
};
const std::array<Lamps, 3> kLamps{{{1, "one lamp"}, {3, "doorway lamp"}, {2, "both lamps"}}};
constexpr std::array<KernelId, 2> kKernels = {KernelId::kDouble, KernelId::kPlane};

ShadowOptions options_for(std::string_view method, KernelId kernel, bool combined) {
  ShadowOptions options = paper_options({});
  options.method.point = *method_by_name(method);
  options.method.options.roots = Roots::kFed;
  options.kernel.id = kernel;
  options.output.combined = combined;
  options.tuning.jobs = 1;
  return options;
}

/// The least of so many runs of each method, in turn; seconds.
ByMethod<double> least_times(const PreparedScene& scene, KernelId kernel, int rounds) {
  ByMethod<double> least;
  least.fill(std::numeric_limits<double>::infinity());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t m = 0; m < kSlatersMethods.size(); ++m) {
      const ShadowResult result =
          shadows_or_stop(scene, options_for(kSlatersMethods[m], kernel, scene.lights.size() > 1));
      least[m] = std::min(least[m], result.shadow_seconds);
    }
  }
  return least;
}

std::vector<RoomSeries> printed_series() {
  RoomSeries one{"SparcStation 1+", kLamps[0].name, {}, {}},
      two{one.machine, kLamps[2].name, {}, {}};
  for (const PrintedRoom& room : kPrinted) {
    for (RoomSeries* series : {&one, &two}) {
      series->pieces.push_back(room.pieces);
      for (std::size_t m = 0; m < kSlatersMethods.size(); ++m) {
        series->milliseconds[m].push_back(1e3 *
                                          (series == &one ? room.one_lamp[m] : room.two_lamps[m]));
      }
    }
  }
  return {one, two};
}

std::string joined(const ByMethod<double>& values, const char* form) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : " / ") + fmt::format(fmt::runtime(form), value);
  }
  return text;
}

/// One row: least squares over the pieces, and what the times are to each other.
std::vector<std::string> fit_row(const RoomSeries& series) {
  ByMethod<double> slope, exponent;
  for (std::size_t m = 0; m < kSlatersMethods.size(); ++m) {
    slope[m] = line_through(series.pieces, series.milliseconds[m]).slope;
    exponent[m] = growth_exponent(series.pieces, series.milliseconds[m]);
  }
  const std::vector<double>&tiling = series.milliseconds[1], &svbsp = series.milliseconds[2];
  std::vector<double> gaps;
  for (std::size_t i = 0; i < tiling.size(); ++i) gaps.push_back(svbsp[i] - tiling[i]);
  const auto [least, most] = std::ranges::minmax(gaps);
  const auto share = [&](double gap) { return 100 * gap / tiling.back(); };
  return {
      series.machine + ", " + series.lamps,
      joined(slope, slope[0] < .1 ? "{:.4f}" : "{:.1f}"),
      joined(exponent, "{:.2f}"),
      fmt::format("{:.2f} to {:.2f}", series.milliseconds[0].front() / svbsp.front(),
                  series.milliseconds[0].back() / svbsp.back()),
      fmt::format("{:.2f} to {:.2f}", tiling.front() / svbsp.front(), tiling.back() / svbsp.back()),
      fmt::format("{:.0f} to {:.0f} %", share(least), share(most))};
}

std::vector<RoomSeries> measured_rooms(Extent extent) {
  const int rounds = extent == Extent::kShort ? 1 : 5;
  fmt::print(
      "\nSlater 1992, Table 1: rooms (`slater-room:room=1` to 10). Pieces: of the scene BSP of all "
      "polygons, in order of\ninput, the room before its furniture (roots=fed), polygon by polygon "
      "outside first (roots=outside), with roots that\nare chosen, and printed. Milliseconds of "
      "CPU, basic / tiling / svbsp with roots=fed, least of {} runs, without the\nscene BSP; "
      "cover=partition, no prefix, no merging. Printed: seconds.\n",
      rounds);
  Table table({"polygons", "pieces, fed", "outside", "chosen", "printed", "lamps", "facing",
               "double, ms", "plane, ms", "printed, s"});
  std::vector<RoomSeries> all;
  for (const KernelId kernel : kKernels) {
    for (const Lamps& lamps : kLamps) {
      all.push_back({std::string(kernel_info(kernel).name), lamps.name, {}, {}});
    }
  }
  for (std::size_t room = 0; room < kPrinted.size(); ++room) {
    if (extent == Extent::kShort && room > 0 && room + 1 < kPrinted.size()) continue;
    const PrintedRoom& printed = kPrinted[room];
    for (std::size_t l = 0; l < kLamps.size(); ++l) {
      const PreparedScene scene =
          make_scene("slater-room",
                     {{"room", static_cast<std::int64_t>(room + 1)}, {"lights", kLamps[l].value}});
      const std::uint64_t pieces = scene_bsp_pieces(scene, Roots::kFed);
      std::vector<std::string> cells = {std::to_string(scene.parts.size()),
                                        std::to_string(pieces),
                                        std::to_string(scene_bsp_pieces(scene, Roots::kOutside)),
                                        std::to_string(scene_bsp_pieces(scene)),
                                        fmt::format("{:.0f}", printed.pieces),
                                        kLamps[l].name};
      std::string facing;
      for (const LightResult& light :
           shadows_or_stop(scene, options_for("svbsp", KernelId::kDouble, false)).lights) {
        facing += (facing.empty() ? "" : ",") + std::to_string(light.facing_parts);
      }
      cells.push_back(facing);
      for (std::size_t k = 0; k < kKernels.size(); ++k) {
        RoomSeries& series = all[k * kLamps.size() + l];
        ByMethod<double> times = least_times(scene, kKernels[k], rounds);
        for (std::size_t m = 0; m < times.size(); ++m) {
          times[m] *= 1e3;
          series.milliseconds[m].push_back(times[m]);
        }
        series.pieces.push_back(static_cast<double>(pieces));
        cells.push_back(joined(times, "{:.2f}"));
      }
      cells.push_back(l == 0   ? joined(printed.one_lamp, "{:.1f}")
                      : l == 2 ? joined(printed.two_lamps, "{:.1f}")
                               : "-");
      table.add(std::move(cells));
    }
  }
  table.print();
  return all;
}

void fits(const std::vector<RoomSeries>& printed, const std::vector<RoomSeries>& ours) {
  fmt::print(
      "\nThe same, fitted by least squares over the pieces: basic / tiling / svbsp. Ratios: in the "
      "first room to the last.\nGap: svbsp less tiling, as a share of tiling in the last room, "
      "least "
      "to most of all rooms.\n");
  Table table({"", "ms a piece", "exponents", "basic / svbsp", "tiling / svbsp", "gap"});
  for (const auto* all : {&printed, &ours}) {
    for (const RoomSeries& series : *all) table.add(fit_row(series));
  }
  table.print();
}

void tetrahedra(Extent extent) {
  const int rounds = extent == Extent::kShort ? 1 : 5;
  fmt::print(
      "\nSlater 1992, Table 2: recursive tetrahedron on a ground, as above. Exponents: from 257 to "
      "1,025 polygons.\n");
  Table table({"polygons", "pieces, fed", "printed", "double, ms", "plane, ms", "printed, s"});
  std::array<std::vector<ByMethod<double>>, kKernels.size()> times;
  for (const PrintedTetrahedron& printed : kPrintedTetrahedra) {
    if (extent == Extent::kShort && printed.level == 5) continue;
    const PreparedScene scene = make_scene("tetra", {{"level", printed.level}, {"ground", 1}});
    std::vector<std::string> cells = {std::to_string(scene.parts.size()),
                                      std::to_string(scene_bsp_pieces(scene, Roots::kFed)),
                                      fmt::format("{:.0f}", printed.pieces)};
    for (std::size_t k = 0; k < kKernels.size(); ++k) {
      ByMethod<double> own = least_times(scene, kKernels[k], rounds);
      for (double& time : own) time *= 1e3;
      cells.push_back(joined(own, "{:.2f}"));
      times[k].push_back(own);
    }
    cells.push_back(joined(printed.seconds, "{:.1f}"));
    table.add(std::move(cells));
  }
  if (extent != Extent::kShort) {
    const double decades =
        std::log(kPrintedTetrahedra[2].polygons / kPrintedTetrahedra[1].polygons);
    const auto exponents = [&](const ByMethod<double>& from, const ByMethod<double>& to) {
      ByMethod<double> result;
      for (std::size_t m = 0; m < result.size(); ++m)
        result[m] = std::log(to[m] / from[m]) / decades;
      return joined(result, "{:.2f}");
    };
    table.add({"exponents", "", "", exponents(times[0][1], times[0][2]),
               exponents(times[1][1], times[1][2]),
               exponents(kPrintedTetrahedra[1].seconds, kPrintedTetrahedra[2].seconds)});
  }
  table.print();
}

}  // namespace

bool slater_times(Extent extent, const std::string& plots) {
  const std::vector<RoomSeries> printed = printed_series(), ours = measured_rooms(extent);
  fits(printed, ours);
  tetrahedra(extent);
  if (plots.empty()) return true;
  const std::string file = plots + "/slater-rooms.svg";
  const Expected<void> written = write_file(file, slater_figures(printed, ours));
  if (!written) {
    fmt::print(stderr, "gnomon_bench: {}\n", to_string(written.error()));
    return false;
  }
  fmt::print("\nFigures 9 to 12: {}\n", file);
  return true;
}

}  // namespace gnomon::bench
