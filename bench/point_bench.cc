// SPDX-License-Identifier: GPL-3.0-or-later
// Point lights: the overhead of exactness against the same code in doubles, other exact numbers,
// other ways to the same areas, growth, a million polygons, two threads, and what the core was to
// reach of each. One function a group of rows; each prints its details, and all fill one table of
// verdicts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "answers.h"
#include "child.h"
#include "contest.h"
#include "gnomon/algorithms/method.h"
#include "machine.h"
#include "parts.h"
#include "peers/peer.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"
#include "verdicts.h"

namespace gnomon::bench {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct Sized {
  std::string title;
  SceneRecipe recipe;
};

std::vector<std::string> algorithm_names() {
  std::vector<std::string> names;
  for (const NamedAlgorithm& algorithm : algorithms()) names.push_back(algorithm.name);
  return names;
}

void print_scene(const std::string& title, const PreparedScene& scene, double prepare_seconds) {
  fmt::print("\n{}: {} polygons, grid of {} bits, prepared in {} ms\n", title,
             grouped(scene.parts.size()), scene.position_bits, short_number(1e3 * prepare_seconds));
}

PreparedScene prepared_and_printed(const Sized& choice) {
  const Scene scene = generated(choice.recipe);
  const double start = cpu_seconds();
  PreparedScene prepared = prepared_or_stop(scene);
  print_scene(choice.title, prepared, cpu_seconds() - start);
  return prepared;
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return "-";
  return fmt::format("{:.2f}", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

/// Share of decisions by stage, and memory: kernel plane, both algorithms.
void print_statistics(const PreparedScene& scene, const SceneRecipe& recipe) {
  Table table({"decisions %", "identity", "filter", "64 bits", "128", "256", "512", "more",
               "decisions", "fragments", "per polygon", "bytes/polygon"});
  for (const NamedAlgorithm& algorithm : algorithms()) {
    ShadowOptions options = options_for(algorithm.algorithm, KernelId::kPlane);
    options.output.stage_counts = true;
    const ShadowResult result = shadows_or_stop(scene, options);
    const ChildReport child = run_in_child(recipe, algorithm.algorithm, 1);
    const StageCounts& stages = result.stages;
    const std::uint64_t all = stages.total(), fragments = total_fragments(result);
    const auto polygons = static_cast<double>(scene.parts.size());
    table.add({algorithm.name, percent(stages.identity, all), percent(stages.filter, all),
               percent(stages.exact64, all), percent(stages.exact128, all),
               percent(stages.exact256, all), percent(stages.exact512, all),
               percent(stages.exact1024 + stages.unbounded, all), grouped(all), grouped(fragments),
               short_number(static_cast<double>(fragments) / polygons),
               short_number(static_cast<double>(child.shadow_bytes) / polygons)});
  }
  table.print();
}

std::vector<Sized> overhead_scenes(Extent extent) {
  const bool small = extent == Extent::kShort;
  const std::int64_t quads = small ? 300 : 10000, houses = small ? 100 : 24000;
  return {{"quads", {"quads", {{"n", quads}}, Coordinates::kGrid}},
          {"city, decimals", {"city", {{"n", houses}}, Coordinates::kDecimals}},
          {"city, doubles", {"city", {{"n", houses}}, Coordinates::kDoubles}}};
}

/// Plane against the same code on doubles: fragments with their points, and areas alone.
bool measure_overhead(Extent extent, Verdicts& verdicts) {
  const Target with_identity{"at most 1.25x", 1.25}, without_identity{"below 1x", 1};
  fmt::print(
      "\nPlane against double, default thickness. CPU ms with everything put out (fragments and\n"
      "their points), and of it the scene BSP and the points; x: against double of the same\n"
      "algorithm, with identity and without; areas: the same without points.\n");
  bool good = true;
  struct Row {
    std::string name;
    KernelId kernel;
    bool identity;
  };
  const std::vector<Row> rows = {{"double", KernelId::kDouble, false},
                                 {"double+identity", KernelId::kDouble, true},
                                 {"plane", KernelId::kPlane, true}};
  for (const Sized& choice : overhead_scenes(extent)) {
    const PreparedScene scene = prepared_and_printed(choice);
    Contest contest(scene);
    for (const NamedAlgorithm& algorithm : algorithms()) {
      for (const Row& row : rows) {
        ShadowOptions options = options_for(algorithm.algorithm, row.kernel, row.identity);
        contest.enter(options);
        // A method of shares alone runs twice alike.
        options.output.points = method_info(algorithm.algorithm).makes_fragments;
        contest.enter(options);
      }
    }
    contest.run(extent == Extent::kLong ? 7 : 3);
    Table table({"kernel/algorithm", "CPU ms", "BSP", "points", "x identity", "x without",
                 "areas ms", "x identity", "x without", "fragments"});
    // Areas alone, then with points.
    std::vector<double> identity_ratios[2], plain_ratios[2];
    const ShadowResult* first = nullptr;
    std::size_t at = 0;  // the algorithm's first entry; each kernel has two
    for (const NamedAlgorithm& algorithm : algorithms()) {
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t areas = at + 2 * i, points = areas + 1;
        const ShadowResult& result = contest.result(points);
        table.add({rows[i].name + "/" + algorithm.name, short_number(1e3 * contest.cpu(points)),
                   short_number(1e3 * result.scene_bsp_seconds),
                   short_number(1e3 * (contest.cpu(points) - contest.cpu(areas))),
                   short_number(contest.ratio(points, at + 3)),
                   short_number(contest.ratio(points, at + 1)),
                   short_number(1e3 * contest.cpu(areas)),
                   short_number(contest.ratio(areas, at + 2)),
                   short_number(contest.ratio(areas, at)), grouped(total_fragments(result))});
      }
      const bool has_points = method_info(algorithm.algorithm).makes_fragments;
      for (std::size_t points = 0; points < 2; ++points) {
        const bool measured = points == 0 || has_points;
        identity_ratios[points].push_back(measured ? contest.ratio(at + 4 + points, at + 2 + points)
                                                   : kNothing);
        plain_ratios[points].push_back(measured ? contest.ratio(at + 4 + points, at + points)
                                                : kNothing);
      }
      const ShadowResult& own = contest.result(at + 4);
      if (first == nullptr) first = &own;
      if (!enclosures_overlap(*first, own)) {
        fmt::print("{}: THE ALGORITHMS' CERTIFIED BOUNDS DO NOT OVERLAP\n", algorithm.name);
        good = false;
      }
      at += 2 * rows.size();
    }
    table.print();
    print_statistics(scene, choice.recipe);
    const std::string title = fmt::format("{}, {}", choice.title, grouped(scene.parts.size()));
    for (std::size_t points = 0; points < 2; ++points) {
      const std::string kind = points == 0 ? "" : ", points too";
      verdicts.add("plane / double+identity" + kind, title, with_identity, identity_ratios[points]);
      verdicts.add("plane / double" + kind, title, without_identity, plain_ratios[points]);
    }
  }
  return good;
}

/// Plane against EPECK and rationals, areas alone; all must give the same fractions.
bool measure_exact_kernels(Extent extent, Verdicts& verdicts) {
  const Target target{"at least 100x", 100, true};
  fmt::print(
      "\nPlane against the same code on other exact numbers: CPU ms of classes and areas.\n");
  const bool full = extent == Extent::kLong;
  const std::int64_t quads = extent == Extent::kShort ? 100
                             : full                   ? 10000
                                                      : 2000,
                     houses = extent == Extent::kShort ? 40
                              : full                   ? 24000
                                                       : 1200;
  const std::vector<Sized> choices = {
      {"quads", {"quads", {{"n", quads}}, Coordinates::kGrid}},
      {"city, decimals", {"city", {{"n", houses}}, Coordinates::kDecimals}}};
  const std::vector<std::pair<std::string, KernelId>> kernels = {
      {"plane", KernelId::kPlane}, {"epeck", KernelId::kEpeck}, {"rational", KernelId::kRational}};
  bool good = true;
  for (const Sized& choice : choices) {
    const PreparedScene scene = prepared_and_printed(choice);
    Contest contest(scene);
    for (const NamedAlgorithm& algorithm : algorithms()) {
      for (const auto& [name, kernel] : kernels) {
        contest.enter(options_for(algorithm.algorithm, kernel));
      }
    }
    contest.run(full ? 1 : 3);
    Table table({"kernel/algorithm", "CPU ms", "x plane", "answer"});
    std::vector<std::vector<double>> ratios(kernels.size());
    std::string checksum;
    for (std::size_t a = 0; a < algorithms().size(); ++a) {
      const std::size_t plane = a * kernels.size();
      for (std::size_t k = 0; k < kernels.size(); ++k) {
        const double ratio = contest.ratio(plane + k, plane);
        ratios[k].push_back(ratio);
        std::string answer = "bounds overlap";
        if (!full) {
          ShadowOptions options = options_for(algorithms()[a].algorithm, kernels[k].second);
          options.output.exact_fractions = true;
          const ExactAnswers answers = exact_answers(shadows_or_stop(scene, options));
          answer = answers.checksum;
          if (checksum.empty()) checksum = answer;
          good = good && answers.sums_to_one && answer == checksum;
        } else if (!enclosures_overlap(contest.result(0), contest.result(plane + k))) {
          answer = "BOUNDS DO NOT OVERLAP";
          good = false;
        }
        table.add({kernels[k].first + "/" + algorithms()[a].name,
                   short_number(1e3 * contest.cpu(plane + k)), short_number(ratio), answer});
      }
    }
    table.print();
    const std::string title = fmt::format("{}, {}", choice.title, grouped(scene.parts.size()));
    for (std::size_t k = 1; k < kernels.size(); ++k) {
      verdicts.add(kernels[k].first + " / plane", title, target, ratios[k]);
    }
  }
  return good;
}

/// One peer against plane on one scene. False if their answers differ.
bool measure_peer(const Peer& peer, const PreparedScene& scene, const std::vector<double>& areas,
                  int rounds, Table& table, std::vector<double>& ratios) {
  std::vector<ShadowResult> results(algorithms().size());
  PeerResult own;
  std::vector<std::function<void()>> work;
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    work.emplace_back([&, a] {
      results[a] = shadows_or_stop(scene, options_for(algorithms()[a].algorithm, KernelId::kPlane));
    });
  }
  work.emplace_back([&] { own = peer.run(scene, 0); });
  const std::vector<Times> times = interleaved(work, rounds);
  bool good = true;
  double worst_sum = 0, worst_part = 0;
  for (const ShadowResult& result : results) {
    const LightResult& light = result.lights[0];
    const double sum = lit_area(light, areas);
    worst_sum = std::max(worst_sum, std::fabs(own.lit_area - sum) / sum);
    for (std::size_t i = 0; i < own.lit.size(); ++i) {
      worst_part = std::max(worst_part, std::fabs(own.lit[i] - light.parts[i].lit.middle()));
    }
  }
  if (!(worst_sum <= peer.sum_tolerance && worst_part <= peer.part_tolerance)) good = false;
  ratios.clear();
  std::vector<std::string> row = {peer.name, short_number(median(times.back().cpu))};
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    ratios.push_back(median_ratio(times.back().cpu, times[a].cpu));
    row.push_back(short_number(median(times[a].cpu)));
    row.push_back(short_number(ratios.back()));
  }
  row.push_back(own.work);
  row.push_back(fmt::format("{:.0e}", worst_sum));
  row.push_back(own.lit.empty() ? "-" : fmt::format("{:.0e}", worst_part));
  row.push_back(good ? "agrees" : "DIFFERS");
  table.add(std::move(row));
  return good;
}

bool measure_peers(Extent extent, Verdicts& verdicts) {
  if (peers().empty()) {
    fmt::print("\nPeers were not built: ./dev bench --peers\n");
    return true;
  }
  fmt::print(
      "\nPeers: CPU seconds from the prepared scene to the lit area of every facing polygon; x: "
      "the\n"
      "peer's time over plane's. Differences: of the whole lit area (relative), of one polygon's\n"
      "fraction.\n");
  const bool small = extent == Extent::kShort;
  const std::vector<Sized> choices = {
      {"quads", {"quads", {{"n", small ? 200 : 10000}}, Coordinates::kGrid}},
      {"tetrahedron", {"tetra", {{"level", small ? 3 : 7}}, Coordinates::kGrid}}};
  std::vector<Target> targets = {
      {"at least 50x", 50, true}, {"at least 0.67x", 1 / 1.5, true}, {"above 1x", 1, true}};
  bool good = true;
  for (const Sized& choice : choices) {
    const PreparedScene scene = prepared_and_printed(choice);
    const std::vector<double> areas = part_areas(scene);
    std::vector<std::string> header = {"peer", "CPU s"};
    for (const NamedAlgorithm& algorithm : algorithms()) {
      header.push_back(algorithm.name);
      header.push_back("x");
    }
    header.insert(header.end(), {"work", "sum off", "part off", "answer"});
    Table table(std::move(header));
    const std::string title = fmt::format("{}, {}", choice.title, grouped(scene.parts.size()));
    std::vector<double> ratios;
    for (std::size_t i = 0; i < peers().size(); ++i) {
      const int rounds = extent == Extent::kLong ? 7 : 3;
      good = measure_peer(peers()[i], scene, areas, rounds, table, ratios) && good;
      verdicts.add(peers()[i].name + " / plane", title, targets[i], ratios);
    }
    table.print();
  }
  return good;
}

bool measure_growth(Extent extent, Verdicts& verdicts) {
  fmt::print(
      "\nGrowth: city in random order, one thread, each run in a process of its own. CPU "
      "seconds.\n");
  std::vector<std::int64_t> houses = {2000, 6000, 20000, 60000, 200000};
  if (extent == Extent::kShort) houses = {100, 200, 400};
  Table table({"algorithm", "polygons", "prepare", "scene BSP", "shadows", "all", "us/polygon",
               "fragments", "peak MB", "bytes/polygon"});
  std::vector<double> exponents;
  for (const NamedAlgorithm& algorithm : algorithms()) {
    std::vector<double> sizes, seconds;
    for (const std::int64_t n : houses) {
      const ChildReport run =
          run_in_child({"city", {{"n", n}}, Coordinates::kGrid}, algorithm.algorithm, 1);
      const auto polygons = static_cast<double>(run.polygons);
      sizes.push_back(polygons);
      seconds.push_back(run.cpu());
      table.add({algorithm.name, grouped(run.polygons), short_number(run.prepare_cpu),
                 short_number(run.scene_bsp_cpu), short_number(run.shadow_cpu - run.scene_bsp_cpu),
                 short_number(run.cpu()), short_number(1e6 * run.cpu() / polygons),
                 grouped(run.fragments), short_number(static_cast<double>(run.peak_bytes) * 1e-6),
                 short_number(static_cast<double>(run.shadow_bytes) / polygons)});
    }
    exponents.push_back(growth_exponent(sizes, seconds));
  }
  table.print();
  verdicts.add(
      "growth",
      fmt::format("city, {} to {} houses", grouped(static_cast<std::uint64_t>(houses.front())),
                  grouped(static_cast<std::uint64_t>(houses.back()))),
      {"at most n^1.15", 1.15, false, Unit::kExponent}, exponents);
  return true;
}

/// Wall seconds on all processors from the scene in memory to classes and areas, and peak memory.
bool measure_large(Extent extent, Verdicts& verdicts) {
  fmt::print(
      "\nLarge scenes: wall seconds on all processors, of preparation and shadows (classes and\n"
      "certified areas of all polygons); peak memory of the whole process. Median of {} runs, "
      "each\n"
      "in a process of its own.\n",
      extent == Extent::kLong ? 3 : 1);
  const bool small = extent == Extent::kShort;
  const std::int64_t houses = small ? 400 : 200000;
  struct Choice {
    Sized scene;
    double seconds;
  };
  const std::vector<Choice> choices = {
      {{"city", {"city", {{"n", houses}}, Coordinates::kGrid}}, 8},
      {{"quads", {"quads", {{"n", small ? 1000 : 1000000}}, Coordinates::kGrid}}, 8},
      {{"tetrahedron", {"tetra", {{"level", small ? 4 : 9}}, Coordinates::kGrid}}, 8},
      {{"tetrahedron", {"tetra", {{"level", small ? 5 : 10}}, Coordinates::kGrid}}, 8},
      {{"city, lamp inside", {"city", {{"n", houses}, {"inside", 1}}, Coordinates::kGrid}}, 3}};
  Table table({"scene", "algorithm", "polygons", "facing", "prepare s", "shadows s", "wall s",
               "CPU s", "BSP s", "fragments", "peak GB", "bytes/polygon"});
  bool good = true;
  for (const Choice& choice : choices) {
    std::vector<double> seconds, gigabytes;
    std::vector<ChildReport> last;
    for (const NamedAlgorithm& algorithm : algorithms()) {
      std::vector<double> walls;
      ChildReport run;
      for (int round = 0; round < (extent == Extent::kLong ? 3 : 1); ++round) {
        run = run_in_child(choice.scene.recipe, algorithm.algorithm, 0);
        walls.push_back(run.wall());
      }
      seconds.push_back(median(walls));
      gigabytes.push_back(static_cast<double>(run.peak_bytes) * 1e-9);
      table.add({choice.scene.title, algorithm.name, grouped(run.polygons), grouped(run.facing),
                 short_number(run.prepare_wall), short_number(run.shadow_wall),
                 short_number(seconds.back()), short_number(run.cpu()),
                 short_number(run.scene_bsp_cpu), grouped(run.fragments),
                 short_number(gigabytes.back()),
                 short_number(static_cast<double>(run.shadow_bytes) /
                              static_cast<double>(run.polygons))});
      last.push_back(run);
    }
    // The sums are rounded: a relative 1e-9 covers a million additions.
    const double slack = 1e-9 * last[0].lit_upper;
    for (const ChildReport& run : last) {
      if (run.lit_lower > last[0].lit_upper + slack || last[0].lit_lower > run.lit_upper + slack) {
        fmt::print("{}: THE ALGORITHMS' SUMS OF LIT FRACTIONS DIFFER\n", choice.scene.title);
        good = false;
      }
    }
    const std::string title = fmt::format("{}, {}", choice.scene.title, grouped(last[0].polygons));
    verdicts.add(
        "all classes and areas", title,
        {fmt::format("at most {} s", choice.seconds), choice.seconds, false, Unit::kSeconds},
        seconds);
    verdicts.add("peak memory", title, {"at most 2 GB", 2, false, Unit::kGigabytes}, gigabytes);
  }
  table.print();
  return good;
}

/// Two threads against one; the answers must be equal to the last bit.
bool measure_threads(Extent extent, Verdicts& verdicts) {
  const SceneRecipe recipe{
      "city", {{"n", extent == Extent::kShort ? 200 : 24000}}, Coordinates::kGrid};
  const PreparedScene scene = prepared_and_printed({"Threads, city", recipe});
  Contest contest(scene);
  for (const NamedAlgorithm& algorithm : algorithms()) {
    ShadowOptions options = options_for(algorithm.algorithm, KernelId::kPlane);
    contest.enter(options);
    options.tuning.jobs = 2;
    contest.enter(options);
  }
  contest.run(extent == Extent::kShort ? 3 : 7);
  Table table({"algorithm", "one thread, wall ms", "two threads", "x", "answer"});
  std::vector<double> ratios;
  bool good = true;
  for (std::size_t a = 0; a < algorithms().size(); ++a) {
    const auto &one = contest.result(2 * a).lights[0].parts,
               &two = contest.result(2 * a + 1).lights[0].parts;
    bool same = one.size() == two.size();
    for (std::size_t i = 0; same && i < one.size(); ++i) {
      same = one[i].lit.lower == two[i].lit.lower && one[i].lit.upper == two[i].lit.upper &&
             one[i].fragment_count == two[i].fragment_count;
    }
    good = good && same;
    ratios.push_back(contest.wall_ratio(2 * a, 2 * a + 1));
    table.add({algorithms()[a].name, short_number(1e3 * contest.wall(2 * a)),
               short_number(1e3 * contest.wall(2 * a + 1)), short_number(ratios.back()),
               same ? "same" : "DIFFERS"});
    // The SVBSP takes no threads.
    if (algorithms()[a].algorithm == MethodId::kSvbsp) ratios.back() = kNothing;
  }
  table.print();
  verdicts.add("two threads / one", fmt::format("city, {}", grouped(scene.parts.size())),
               {"at least 1.7x", 1.7, true}, ratios);
  return good;
}

}  // namespace

bool run_point(Extent extent) {
  Verdicts verdicts(
      fmt::format("Targets (verdict: algorithm {})", algorithms()[default_algorithm()].name),
      algorithm_names(), default_algorithm());
  bool good = true;
  for (const auto measure : {measure_overhead, measure_exact_kernels, measure_peers, measure_growth,
                             measure_large, measure_threads}) {
    good = measure(extent, verdicts) && good;
  }
  verdicts.print();
  return good;
}

}  // namespace gnomon::bench
