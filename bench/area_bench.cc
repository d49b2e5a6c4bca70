// SPDX-License-Identifier: GPL-3.0-or-later
// Area lights: exact classes against the same code in doubles and on CGAL's lazy numbers, growth of
// both algorithms from ten to thirty thousand polygons under a small and a large light, and Figure
// 8 of Chin & Feiner 1992 beside our scenes of the same kind.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "answers.h"
#include "child.h"
#include "gnomon/algorithms/illumination.h"
#include "gnomon/algorithms/shading_mesh.h"
#include "machine.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"
#include "verdicts.h"

namespace gnomon::bench {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

/// Index into area_algorithms().
std::size_t receiver_index() {
  return static_cast<std::size_t>(
      std::ranges::find(area_algorithms(), MethodId::kReceiver, &NamedAlgorithm::algorithm) -
      area_algorithms().begin());
}

std::vector<std::string> names() {
  std::vector<std::string> result;
  for (const NamedAlgorithm& algorithm : area_algorithms()) result.push_back(algorithm.name);
  return result;
}

ShadowOptions options_for(MethodId algorithm, KernelId kernel, bool identity = false) {
  ShadowOptions options;
  options.method.area = algorithm;
  options.kernel.id = kernel;
  options.kernel.identity = identity;
  options.tuning.jobs = 1;
  return options;
}

/// The longest side of the box of all polygons, scene units.
double scene_width(const PreparedScene& scene) {
  std::array<double, 3> low{}, high{};
  bool first = true;
  for (const VertexId vertex : scene.loop_vertices) {
    const std::array<double, 3>& p = scene.geometry.positions[vertex];
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = first ? p[k] : std::min(low[k], p[k]);
      high[k] = first ? p[k] : std::max(high[k], p[k]);
    }
    first = false;
  }
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

/// Bits of the widest integers that decided anything.
std::string widest_stage(const StageCounts& stages) {
  static const char* const kNames[] = {"64", "128", "256", "512", "1024", "GMP"};
  const auto counts = stages.by_width();
  std::string widest = "-";
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) widest = kNames[i];
  }
  return widest;
}

struct Choice {
  std::string title;
  std::string generator;
  Parameters parameters;
};

/// A family at about so many polygons. area_size: hundredths of the scene's width.
Choice choice_of(const std::string& family, std::int64_t polygons, std::int64_t size) {
  Parameters parameters{{"area", 1}, {"area_size", size}};
  if (family == "city") {
    parameters["n"] = std::max<std::int64_t>(2, polygons / 5);
  } else if (family == "quads") {
    parameters["n"] = polygons - 1;
  } else {
    parameters["n"] = std::max<std::int64_t>(12, polygons);
  }
  return {fmt::format("{}, {} light", family == "slater-room" ? "room" : family,
                      size <= 2 ? "small" : "large"),
          family, parameters};
}

/// Plane against doubles with and without identity, and against epeck; exact answers must agree.
bool measure_ratios(Extent extent, Verdicts& verdicts) {
  fmt::print(
      "\nArea lights: CPU ms of classes and areas on one thread, and against double with identity\n"
      "by the same algorithm; exact stage and largest integers of plane.\n");
  const bool small = extent == Extent::kShort;
  const std::int64_t size = small ? 200 : 3000;
  bool good = true;
  struct Row {
    std::string name;
    KernelId kernel;
    bool identity;
  };
  const std::vector<Row> rows = {{"double", KernelId::kDouble, false},
                                 {"double+identity", KernelId::kDouble, true},
                                 {"plane", KernelId::kPlane, true}};
  for (const std::string family : {"quads", "city"}) {
    for (const std::int64_t light : {1, 50}) {
      const Choice choice = choice_of(family, size, light);
      const PreparedScene scene = make_scene(choice.generator, choice.parameters);
      fmt::print("\n{}: {} polygons, grid of {} bits\n", choice.title, grouped(scene.parts.size()),
                 scene.position_bits);
      Table table({"kernel/algorithm", "CPU ms", "x identity", "fragments", "nodes", "exact %",
                   "widest", "answer"});
      std::vector<double> double_ratios, epeck_ratios;
      std::string checksum;
      for (const NamedAlgorithm& algorithm : area_algorithms()) {
        std::vector<ShadowResult> results(rows.size());
        std::vector<std::function<void()>> work;
        for (std::size_t i = 0; i < rows.size(); ++i) {
          work.emplace_back([&, i] {
            results[i] = shadows_or_stop(
                scene, options_for(algorithm.algorithm, rows[i].kernel, rows[i].identity));
          });
        }
        const std::vector<Times> times = interleaved(work, extent == Extent::kLong ? 7 : 3);
        ShadowOptions exactly = options_for(algorithm.algorithm, KernelId::kPlane);
        exactly.output.exact_fractions = true;
        exactly.output.stage_counts = true;
        const ShadowResult exact = shadows_or_stop(scene, exactly);
        const ExactAnswers answers = exact_answers(exact);
        if (checksum.empty()) checksum = answers.checksum;
        good = good && answers.sums_to_one && answers.checksum == checksum;
        for (std::size_t i = 0; i < rows.size(); ++i) {
          const bool plane = rows[i].kernel == KernelId::kPlane;
          const StageCounts& stages = exact.stages;
          table.add({rows[i].name + "/" + algorithm.name, short_number(1e3 * median(times[i].cpu)),
                     short_number(median_ratio(times[i].cpu, times[1].cpu)),
                     grouped(total_fragments(results[i])), grouped(results[i].lights[0].tree_nodes),
                     plane ? fmt::format("{:.3f}", 100.0 * static_cast<double>(stages.exact()) /
                                                       static_cast<double>(stages.total()))
                           : "-",
                     plane ? widest_stage(stages) : "-", plane ? answers.checksum : "-"});
        }
        double_ratios.push_back(median_ratio(times[2].cpu, times[1].cpu));
      }
      // epeck on a smaller scene of the same kind, by the default algorithm.
      const Choice less = choice_of(family, small ? 60 : 600, light);
      const PreparedScene less_scene = make_scene(less.generator, less.parameters);
      std::vector<ShadowResult> results(2);
      const std::vector<Times> times = interleaved(
          {[&] {
             results[0] =
                 shadows_or_stop(less_scene, options_for(MethodId::kReceiver, KernelId::kPlane));
           },
           [&] {
             results[1] =
                 shadows_or_stop(less_scene, options_for(MethodId::kReceiver, KernelId::kEpeck));
           }},
          extent == Extent::kLong ? 3 : 1);
      const bool overlap = enclosures_overlap(results[0], results[1]);
      good = good && overlap;
      const double epeck = median_ratio(times[1].cpu, times[0].cpu);
      table.add({fmt::format("epeck/receiver, {} polygons", grouped(less_scene.parts.size())),
                 short_number(1e3 * median(times[1].cpu)), "-",
                 grouped(total_fragments(results[1])), "-", "-", "-",
                 overlap ? "bounds overlap" : "BOUNDS DO NOT OVERLAP"});
      table.print();
      const std::string title = fmt::format("{}, {}", choice.title, grouped(scene.parts.size()));
      verdicts.add("plane / double+identity", title, {"at most 1.3x", 1.3}, double_ratios);
      verdicts.add("epeck / plane",
                   fmt::format("{}, {}", less.title, grouped(less_scene.parts.size())),
                   {"at least 50x", 50, true}, {kNotMeasured, epeck});
    }
  }
  return good;
}

/// CPU seconds, fragments, nodes and memory from 10 to 30,000 polygons, each run in a process of
/// its own.
bool measure_growth(Extent extent, Verdicts& verdicts) {
  fmt::print(
      "\nArea lights, growth: kernel plane, one thread, each run in a process of its own, the "
      "middle of three; CPU\nseconds of preparation and classes.\n");
  std::vector<std::int64_t> sizes = {10, 100, 1000, 10000, 30000};
  if (extent == Extent::kShort) sizes = {10, 50, 150};
  Table table(
      {"scene", "algorithm", "polygons", "CPU s", "us/polygon", "fragments", "nodes", "peak MB"});
  for (const std::string family : {"quads", "city", "slater-room"}) {
    for (const std::int64_t light : {1, 50}) {
      std::vector<double> exponents(area_algorithms().size(), kNotMeasured);
      std::vector<double> largest(area_algorithms().size(), kNotMeasured);
      std::string title;
      std::uint64_t most = 0;
      for (std::size_t a = 0; a < area_algorithms().size(); ++a) {
        std::vector<double> x, y;
        for (const std::int64_t n : sizes) {
          // The merged trees grow with the square where a large light's volumes all overlap.
          const std::int64_t limit = extent == Extent::kLong ? 10000 : 1000;
          if (area_algorithms()[a].algorithm == MethodId::kMerged && n > limit) continue;
          const Choice choice = choice_of(family, n, light);
          title = choice.title;
          // The middle of three: what else the machine does weighs most on the smallest.
          std::array<ChildReport, 3> runs;
          for (ChildReport& own : runs) {
            own = run_in_child({choice.generator, choice.parameters, Coordinates::kGrid},
                               MethodId::kSectors, 1, area_algorithms()[a].algorithm);
          }
          std::sort(runs.begin(), runs.end(),
                    [](const ChildReport& x, const ChildReport& y) { return x.cpu() < y.cpu(); });
          const ChildReport& run = runs[1];
          most = std::max(most, run.polygons);
          if (n >= 1000 || extent == Extent::kShort) {
            x.push_back(static_cast<double>(run.polygons));
            y.push_back(run.cpu());
          }
          largest[a] = run.cpu();
          table.add({choice.title, area_algorithms()[a].name, grouped(run.polygons),
                     short_number(run.cpu()),
                     short_number(1e6 * run.cpu() / static_cast<double>(run.polygons)),
                     grouped(run.fragments), grouped(run.nodes),
                     short_number(static_cast<double>(run.peak_bytes) * 1e-6)});
        }
        if (x.size() > 1) exponents[a] = growth_exponent(x, y);
      }
      verdicts.add("growth from 1,000", title, {"at most n^1.2", 1.2, false, Unit::kExponent},
                   exponents);
      if (family == std::string("city") && extent != Extent::kShort) {
        std::vector<double> seconds(area_algorithms().size(), kNotMeasured);
        seconds[receiver_index()] = largest[receiver_index()];
        verdicts.add("all classes, one core", fmt::format("{}, {}", title, grouped(most)),
                     {"at most 3 s", 3, false, Unit::kSeconds}, seconds);
      }
    }
  }
  table.print();
  return true;
}

/// What the paper prints of one plate, per light where it has two.
struct Plate {
  std::string name;
  std::string generator;
  Parameters parameters;
  std::vector<std::array<std::string, 6>> paper;  // one row a light: the columns after polygons
};

/// Figure 8: our scenes of the same kind and polygon counts; the positions are not published, so
/// that counts compare as orders of magnitude and ratios.
bool measure_figure8(Extent extent, Verdicts&) {
  fmt::print(
      "\nChin & Feiner 1992, Figure 8 (HP 9000/380; scenes not published: ours are of the same "
      "kind).\nSeconds: classification, gridding, illumination by each light. Vertices: lit / "
      "penumbra / umbra.\n");
  const std::vector<Plate> plates = {
      {"1, 2",
       "plates1",
       {},
       {{"0.3", "0.6", "2.2", "747", "1341 / 1668 / 231", "494 / 437 / 61"}}},
      {"3, 4",
       "room1992",
       {{"lights", 1}},
       {{"13.4", "5.3", "105.4", "3348", "3125 / 8556 / 3043", "1576 / 2512 / 839"}}},
      {"5",
       "room1992",
       {{"lights", 2}, {"playpen", 0}},
       {{"8.6", "10.2", "30.8", "4085", "6768 / 4627 / 5791", "2211 / 1140 / 1823"},
        {"", "", "37.9", "", "7969 / 5847 / 3370", "2608 / 1429 / 1132"}}},
      {"6",
       "room1992",
       {{"lights", 2}},
       {{"35.8", "23.2", "178.1", "9344", "10821 / 14938 / 13458", "3904 / 3839 / 4008"},
        {"", "", "247.2", "", "12599 / 16594 / 10024", "4352 / 4424 / 2944"}}}};
  Table table(
      {"plate", "polygons", "class. s", "grid s", "illum. s", "output", "vertices", "illuminated"});
  for (const Plate& plate : plates) {
    const Scene scene = generated({plate.generator, plate.parameters, Coordinates::kGrid});
    const PreparedScene prepared = prepared_or_stop(scene);
    ShadowOptions options = options_for(MethodId::kReceiver, KernelId::kPlane);
    options.output.exact_points = true;
    options.output.combined = prepared.lights.size() > 1;
    double start = cpu_seconds();
    const ShadowResult result = shadows_or_stop(prepared, options);
    const double classification = cpu_seconds() - start;
    std::vector<Illuminator> illuminators;
    for (std::uint32_t i = 0; i < prepared.lights.size(); ++i) {
      illuminators.emplace_back(prepared, i, scene.lights[i].intensity.nearest());
    }
    ShadingOptions shading;
    // About as fine as the paper's: a finer grid in penumbra.
    const double diagonal = scene_width(prepared);
    shading.lit_step = mpq_class(diagonal / (extent == Extent::kShort ? 4 : 10));
    shading.penumbra_step = shading.lit_step / 2;
    const Expected<ShadingMesh> mesh = make_shading_mesh(
        prepared, result,
        [&](const ShadeRequest& asked) {
          const Illumination found = illuminators[asked.light].at(
              asked.part, asked.side, asked.point, asked.unobstructed, asked.inwards);
          return PointShade{found.value, found.error_bound};
        },
        shading);
    if (!mesh) {
      fmt::print("plate {}: {}\n", plate.name, to_string(mesh.error()));
      return false;
    }
    for (std::size_t i = 0; i < plate.paper.size(); ++i) {
      std::vector<std::string> row = {i == 0 ? plate.name + " (paper)" : "", ""};
      row.insert(row.end(), plate.paper[i].begin(), plate.paper[i].end());
      table.add(std::move(row));
    }
    const ShadingStats& stats = mesh->stats;
    for (std::size_t i = 0; i < stats.lights.size(); ++i) {
      const LightShadingStats& light = stats.lights[i];
      const bool first = i == 0;
      table.add({first ? plate.name + " (ours)" : "", first ? grouped(prepared.parts.size()) : "",
                 first ? short_number(classification) : "",
                 first ? short_number(stats.grid_seconds) : "", short_number(light.seconds),
                 first ? grouped(stats.faces) : "",
                 fmt::format("{} / {} / {}", light.lit, light.penumbra, light.umbra),
                 fmt::format("{} / {} / {}", light.illuminated_lit, light.illuminated_penumbra,
                             light.illuminated_umbra)});
    }
  }
  table.print();
  return true;
}

}  // namespace

bool run_area(Extent extent) {
  Verdicts verdicts(fmt::format("Targets (verdict: algorithm {})", names()[receiver_index()]),
                    names(), receiver_index());
  bool good = true;
  for (const auto measure : {measure_ratios, measure_growth, measure_figure8}) {
    good = measure(extent, verdicts) && good;
  }
  verdicts.print();
  return good;
}

}  // namespace gnomon::bench
