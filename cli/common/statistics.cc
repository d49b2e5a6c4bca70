// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/statistics.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <span>

#include "gnomon/algorithms/method.h"
#include "gnomon/kernel/precision_plan.h"
#include "report/sides/polygon_sides.h"
#include "report/text/count_text.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::cli {

namespace {

using report::grouped;
using report::percent;
using report::rounded;

std::uint64_t peak_bytes() {
  constexpr std::uint64_t kUnit = 1024;  // of ru_maxrss
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * kUnit;
}

std::string phase(const std::string& name, const Seconds& seconds) {
  return name + ' ' + rounded(seconds.cpu, 3) + " (" + rounded(seconds.elapsed, 3) + ')';
}

std::string stages_text(const StageCounts& stages) {
  const auto share = [&](std::uint64_t count) {
    return percent(static_cast<double>(count) / static_cast<double>(stages.total()));
  };
  std::string text = grouped(stages.total()) + " decisions: by the filter " + share(stages.filter) +
                     ", by identity " + share(stages.identity) + ", exactly " +
                     share(stages.exact());
  std::string widths;
  const auto by_width = stages.by_width();
  for (std::size_t i = 0; i < by_width.size(); ++i) {
    if (by_width[i] == 0) continue;
    const auto width = static_cast<IntegerWidth>(i);
    widths += (widths.empty() ? " (" : ", ") + std::string(width_name(width)) +
              (width == IntegerWidth::kUnbounded ? ": " : " bits: ") + grouped(by_width[i]);
  }
  if (!widths.empty()) {
    text += widths + "), " + grouped(stages.exactly_zero) + " of these exactly zero";
  }
  return text + '\n';
}

/// Of lights together by svbsp.
std::string together_text(const ShadowResult& result) {
  const TogetherCounts& counts = result.together;
  if (counts.trees == 0) return {};
  return "lights together: " + grouped(result.combined.size()) + " fragments, " +
         grouped(counts.filters) + " loops filtered; trees of " + grouped(counts.tree_bytes) +
         " bytes, at most " + grouped(counts.tree_bytes_at_once) + " at one time\n";
}

/// What is counted of a light. Under area lights contour looks at volumes and at no intervals.
std::span<const Counter> counters_of(const LoadedScene& loaded, const LightResult& light) {
  static constexpr std::array kOfAreaByContour = {Counter::kVolumes, Counter::kSolids,
                                                  Counter::kVolumePlanes, Counter::kOpenPolygons};
  const bool has_area = loaded.prepared.lights[light.light].has_area();
  if (has_area && light.method == MethodId::kContour) return kOfAreaByContour;
  return method_info(light.method).counters;
}

}  // namespace

std::string statistics_text(const LoadedScene& loaded, const ShadowResult& result,
                            const PhaseTimes& times) {
  const bool has_bsp = result.bsp_nodes > 0;
  std::string text = "kernel " + result.kernel + ", algorithm " + result.algorithm + '\n';
  if (has_bsp) {
    text += "scene BSP: " + grouped(result.bsp_fragments) + " pieces, " +
            grouped(result.bsp_nodes) + " nodes, depth " + grouped(result.bsp_depth) + '\n';
  }
  for (const LightResult& light : result.lights) {
    const std::span<const Counter> counters = counters_of(loaded, light);
    const bool counts_nodes = has_bsp || std::ranges::count(counters, Counter::kNodes) > 0;
    text += "light " + report::light_name(loaded.scene, loaded.prepared, light) + ": " +
            grouped(light.facing_parts) + " parts and " + grouped(light.facing_edges) +
            " edges face it";
    if (method_info(light.method).makes_fragments) {
      text += ", " + grouped(light.tree_nodes) + (counts_nodes ? " tree nodes, " : " cells, ") +
              grouped(light.fragment_total) + " fragments";
    }
    text += '\n';
    const std::string work = report::work_text(counters, light.work);
    if (!work.empty()) {
      text += report::wrapped("work: " + work, report::TextTable::kWidth, 2, 4);
    }
  }
  text += together_text(result);
  if (result.stages.total() > 0) text += stages_text(result.stages);
  return text + times_text(loaded, times, has_bsp ? result.scene_bsp_seconds : 0);
}

std::string times_text(const LoadedScene& loaded, const PhaseTimes& times,
                       double scene_bsp_seconds) {
  std::string text = "CPU seconds (elapsed): " + phase("reading", loaded.reading) + ", " +
                     phase("preparation", loaded.preparation) + ", " +
                     phase("shadows", times.shadows);
  if (scene_bsp_seconds > 0) text += ", of these scene BSP " + rounded(scene_bsp_seconds, 3);
  text += ", " + phase("output", times.output) + '\n';
  const std::uint64_t peak = peak_bytes();
  text += "peak memory: " + grouped(peak >> 20) + " MiB";
  const std::size_t polygons = loaded.scene.polygons.size();
  // Below, the program itself is most of it.
  constexpr std::size_t kMany = 10'000;
  if (polygons >= kMany) text += ", " + grouped(peak / polygons) + " bytes a polygon";
  return text + '\n';
}

}  // namespace gnomon::cli
