// SPDX-License-Identifier: GPL-3.0-or-later
// Every kernel on every scene, in one run: the ratios are what counts.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "answers.h"
#include "gnomon/algorithms/shadows.h"
#include "parts.h"
#include "scenes.h"
#include "table.h"
#include "timing.h"

namespace gnomon::bench {
namespace {

struct Runner {
  std::string name;  // "plane/sectors"
  KernelId kernel;
  bool identity;
  bool slow;  // numbers on the heap: fewer repetitions
  MethodId algorithm = MethodId::kAutomatic;
};

/// Every kernel with each algorithm, one algorithm after the other.
const std::vector<Runner>& runners() {
  static const std::vector<Runner> kRunners = [] {
    const std::array<Runner, 8> kernels{{{"float", KernelId::kFloat, false, false},
                                         {"double", KernelId::kDouble, false, false},
                                         {"double+identity", KernelId::kDouble, true, false},
                                         {"longdouble", KernelId::kLongDouble, false, false},
                                         {"epick", KernelId::kEpick, false, false},
                                         {"epeck", KernelId::kEpeck, false, true},
                                         {"rational", KernelId::kRational, false, true},
                                         {"plane", KernelId::kPlane, true, false}}};
    std::vector<Runner> all;
    for (const NamedAlgorithm& algorithm : algorithms()) {
      for (Runner runner : kernels) {
        runner.name += "/" + algorithm.name;
        runner.algorithm = algorithm.algorithm;
        all.push_back(std::move(runner));
      }
    }
    return all;
  }();
  return kRunners;
}

struct SceneChoice {
  std::string title;
  std::string generator;
  Parameters parameters, short_parameters;
};

const std::vector<SceneChoice>& scene_choices() {
  static const std::vector<SceneChoice> kScenes = {
      {"generic quads", "quads", {{"n", 1000}}, {{"n", 60}}},
      {"grid city", "city", {{"n", 600}}, {{"n", 20}}},
      {"recursive tetrahedron", "tetra", {{"level", 5}}, {{"level", 3}}},
      {"lattice soup", "lattice", {{"n", 60}, {"size", 12}}, {{"n", 16}, {"size", 4}}},
      {"panels a hair off a wall", "near-coplanar", {{"n", 60}}, {{"n", 12}}},
  };
  return kScenes;
}

std::string algorithm_name(MethodId algorithm) {
  for (const NamedAlgorithm& named : algorithms()) {
    if (named.algorithm == algorithm) return named.name;
  }
  return {};
}

ShadowOptions options_of(const Runner& runner) {
  ShadowOptions options;
  options.kernel.id = runner.kernel;
  options.kernel.identity = runner.identity;
  options.method.point = runner.algorithm;
  options.tuning.jobs = 1;
  return options;
}

/// Keeps the CPU time of every repetition, by benchmark name.
class TimeCollector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && !run.error_occurred) {
        seconds_[run.run_name.function_name].push_back(run.GetAdjustedCPUTime() * 1e-9);
      }
    }
  }
  /// Of the repetitions; nothing if the benchmark did not run.
  std::optional<double> median_of(const std::string& name) const {
    const auto found = seconds_.find(name);
    if (found == seconds_.end() || found->second.empty()) return std::nullopt;
    return median(found->second);
  }

 private:
  std::map<std::string, std::vector<double>> seconds_;
};

std::string name_of(const SceneChoice& scene, const Runner& runner) {
  return scene.generator + "/" + runner.name;
}

struct Measured {
  PreparedScene scene;
  std::map<std::string, ShadowResult> results;  // of the timed runs, by runner
  std::set<std::string> gave_up;                // runners of rounded kernels whose cuts never end
};

/// False if a rounded kernel gave up, which none promises not to do.
bool run(Measured& measured, const Runner& runner) {
  Expected<ShadowResult> result = compute_shadows(measured.scene, options_of(runner));
  if (!result && result.error().code == ErrorCode::kLimit && !kernel_info(runner.kernel).exact) {
    measured.gave_up.insert(runner.name);
    return false;
  }
  benchmark::DoNotOptimize(result);
  measured.results[runner.name] =
      result ? *std::move(result) : shadows_or_stop(measured.scene, options_of(runner));
  return true;
}

void register_runs(const SceneChoice& choice, Measured& measured, Extent extent) {
  for (const Runner& runner : runners()) {
    benchmark::RegisterBenchmark(name_of(choice, runner).c_str(),
                                 [&measured, runner](benchmark::State& state) {
                                   for (auto _ : state) {
                                     if (!run(measured, runner)) {
                                       state.SkipWithError("gave up");
                                       break;
                                     }
                                   }
                                 })
        ->Unit(benchmark::kNanosecond)
        ->MinTime(extent == Extent::kShort ? 0.01 : 0.1)
        ->Repetitions(extent == Extent::kShort || runner.slow ? 3 : 7);
  }
}

/// Prints one scene's table. False if exact kernels disagree.
bool report(const SceneChoice& choice, const Measured& measured, const TimeCollector& times) {
  const PreparedScene& scene = measured.scene;
  fmt::print("\n{}: {} polygons, {} light{}, grid of {} bits\n", choice.title,
             grouped(scene.parts.size()), scene.lights.size(), scene.lights.size() == 1 ? "" : "s",
             scene.position_bits);
  std::optional<ExactAnswers> reference;
  std::map<std::string, ExactAnswers> answers;
  bool good = true;
  for (const Runner& runner : runners()) {
    if (!kernel_info(runner.kernel).exact || !measured.results.contains(runner.name)) continue;
    ShadowOptions options = options_of(runner);
    options.output.exact_fractions = true;
    ExactAnswers own = exact_answers(shadows_or_stop(scene, options));
    if (!own.sums_to_one) {
      fmt::print("{}: lit and shadow do not add up to exactly 1\n", runner.name);
      good = false;
    }
    if (!reference) reference = own;
    if (own.checksum != reference->checksum) good = false;
    answers.emplace(runner.name, std::move(own));
  }
  Table table({"kernel/algorithm", "CPU ms", "x double", "BSP ms", "fragments", "exact %",
               "wrong parts", "worst", "answer"});
  for (const Runner& runner : runners()) {
    if (measured.gave_up.contains(runner.name)) {
      table.add({runner.name, "gave up", "-", "-", "-", "-", "-", "-", ""});
      continue;
    }
    const auto found = measured.results.find(runner.name);
    const std::optional<double> time = times.median_of(name_of(choice, runner));
    if (found == measured.results.end() || !time) continue;
    const ShadowResult& result = found->second;
    const std::optional<double> base =
        times.median_of(choice.generator + "/double/" + algorithm_name(runner.algorithm));
    std::string exact_share = "-", wrong = "-", worst = "-", answer;
    if (runner.kernel == KernelId::kPlane) {
      ShadowOptions options = options_of(runner);
      options.output.stage_counts = true;
      const StageCounts stages = shadows_or_stop(scene, options).stages;
      // A method may have decided nothing.
      if (stages.total() > 0) {
        exact_share = fmt::format("{:.2f}", 100.0 * static_cast<double>(stages.exact()) /
                                                static_cast<double>(stages.total()));
      }
    }
    if (const auto own = answers.find(runner.name); own != answers.end()) {
      answer = own->second.checksum;
    } else if (reference) {
      const Deviation off = deviation(result, *reference);
      wrong = grouped(off.wrong_parts);
      worst = off.wrong_parts == 0 ? "-" : fmt::format("{:.0e}", off.largest);
      answer = std::isfinite(off.sum) ? fmt::format("sum {:.6f}", off.sum) : "not a number";
    }
    table.add({runner.name, short_number(1e3 * *time), base ? short_number(*time / *base) : "-",
               short_number(1e3 * result.scene_bsp_seconds), grouped(total_fragments(result)),
               exact_share, wrong, worst, answer});
  }
  table.print();
  if (reference) {
    double sum = 0;
    for (const double lit : reference->lit) sum += lit;
    fmt::print("exact: sum {:.6f}{}\n", sum, good ? "" : "; EXACT KERNELS DISAGREE");
  }
  return good;
}

}  // namespace

bool run_kernels(Extent extent) {
  std::vector<std::unique_ptr<Measured>> measured;
  for (const SceneChoice& choice : scene_choices()) {
    measured.push_back(std::make_unique<Measured>());
    measured.back()->scene = make_scene(
        choice.generator, extent == Extent::kShort ? choice.short_parameters : choice.parameters);
    register_runs(choice, *measured.back(), extent);
  }
  TimeCollector times;
  benchmark::RunSpecifiedBenchmarks(&times);
  fmt::print(
      "\nKernels: CPU time, median of the repetitions, of scene BSP, shadows and certified "
      "areas;\nshare of decisions left to the exact stage; parts whose lit fraction is off "
      "by more than {:g}.\n",
      kWrongBeyond);
  bool good = true;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    good = report(scene_choices()[i], *measured[i], times) && good;
  }
  return good;
}

}  // namespace gnomon::bench
