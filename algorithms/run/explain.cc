// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs methods on the kernel of watched runs: once to record, then once for each flipped decision.
#include "gnomon/algorithms/explain.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "algorithms/run/compute.h"
#include "algorithms/run/decision_effects.h"
#include "algorithms/run/on_every_kernel.h"
#include "kernel/watched/decision_watch.h"

namespace gnomon {
namespace {

/// What cannot be explained.
Expected<DecisionWatch::MakeRounded> checked(const PreparedScene& scene,
                                             const ShadowOptions& options,
                                             const LightList& lights) {
  const KernelInfo& kernel = kernel_info(options.kernel.id);
  const std::string name(kernel.name);
  if (kernel.exact) {
    return fail(ErrorCode::kUsage, "kernel " + name + " is exact",
                "a rounded kernel: only those differ from the exact answer");
  }
  for (const std::uint32_t light : lights) {
    const Method& method = method_info(method_of(scene.lights[light].type, options, false));
    if (method.explains) continue;
    return fail(ErrorCode::kUsage,
                "decisions of " + std::string(method.name) + " cannot be explained",
                "a method that asks the kernel for all of them");
  }
  static constexpr auto kMake = on_every_kernel<RoundedSpacesOf, CompiledFor::kRoundedKernels>();
  const auto make = kMake[static_cast<std::size_t>(options.kernel.id)];
  if (make == nullptr) {
    return fail(ErrorCode::kUsage, "kernel " + name + " was not built",
                "another kernel, or a build with GNOMON_CGAL_KERNELS");
  }
  return make;
}

bool can_be_flipped(const DifferingDecision& decision) {
  switch (decision.predicate) {
    case Predicate::kSceneBsp:
      return decision.corner.source != kMadeVertex;
    case Predicate::kThreePoints:
      return decision.exact != Side::kOn;
    default:
      return true;
  }
}

class Explaining {
 public:
  Explaining(const PreparedScene& scene, const ShadowOptions& options, const ExplainOptions& wanted,
             LightList lights, DecisionWatch::MakeRounded make)
      : scene_(scene),
        options_(options),
        wanted_(wanted),
        lights_(std::move(lights)),
        recording_(make, wanted.only_first) {
    options_.tuning.jobs = 1;
    options_.output = {};
    options_.control.light_done = nullptr;
    options_.control.progress = nullptr;
  }

  Expected<Explanation> run() {
    if (auto recorded = record(); !recorded) return tl::unexpected<Error>(recorded.error());
    Explanation result;
    result.asked = recording_.asked();
    result.decisions = recording_.differing();
    if (!result.decisions.empty()) result.first = result.decisions.front();
    if (wanted_.only_first) return result;
    std::ranges::stable_sort(result.decisions, std::ranges::greater{}, &DifferingDecision::ulps);
    result.groups = grouped(result.decisions, scene_);
    result.cannot_be_flipped = static_cast<std::uint64_t>(
        std::ranges::count_if(result.decisions, std::not_fn(can_be_flipped)));
    if (wanted_.flips == 0) return result;
    if (auto control = check_control(); !control) return tl::unexpected<Error>(control.error());
    if (auto flipped = flip_all(result); !flipped) return tl::unexpected<Error>(flipped.error());
    const auto kernel = run_kernel();
    if (!kernel) return tl::unexpected<Error>(kernel.error());
    result.kernel = *kernel;
    return result;
  }

 private:
  /// The exact run, light by light.
  Expected<void> record() {
    const DecisionWatch::Scope scope(recording_);
    recording_.stop_with(outside(), ~std::uint64_t{0});
    for (const std::uint32_t light : lights_) {
      recording_.begin_light(light);
      const std::uint64_t before = recording_.decisions();
      auto result = compute(light, &recording_.stop(), watched_function);
      if (wanted_.only_first && !recording_.differing().empty()) return {};
      if (!result) return tl::unexpected<Error>(result.error());
      exact_.push_back(std::move(*result));
      exact_decisions_.push_back(recording_.decisions() - before);
      progress();
    }
    return {};
  }

  Expected<LightResult> compute(std::uint32_t light, const std::atomic<bool>* stop,
                                MethodLookup lookup) {
    options_.lights = {light};
    ShadowOptions options = options_;
    options.control.interrupted = stop;
    auto result = compute_with(scene_, options, Rules{}, lookup);
    if (!result) return tl::unexpected<Error>(result.error());
    return std::move(result->lights.front());
  }

  /// A run in which nothing is flipped changes nothing, or no flipped run says anything.
  Expected<void> check_control() {
    const auto effect = run_flipped({}, std::nullopt);
    if (!effect) return tl::unexpected<Error>(effect.error());
    if (effect->changes()) {
      return fail(ErrorCode::kUsage, "a run without any flipped decision is not the exact run",
                  "the same shares: a bug of this program, please report it");
    }
    return {};
  }

  /// One by one, then all that can be flipped.
  Expected<void> flip_all(Explanation& result) {
    DecisionWatch::Flips all;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < result.decisions.size(); ++i) {
      const DifferingDecision& decision = result.decisions[i];
      if (!can_be_flipped(decision)) continue;
      all.emplace(decision.question, decision.flip);
      if (chosen.size() < wanted_.flips) chosen.push_back(i);
    }
    steps_ += chosen.size();
    for (const std::size_t i : chosen) {
      const DifferingDecision& decision = result.decisions[i];
      const auto effect = run_flipped({{decision.question, decision.flip}}, decision.light);
      if (!effect) return tl::unexpected<Error>(effect.error());
      result.flipped.push_back({i, *effect});
      progress();
    }
    if (all.empty()) return {};
    const auto together = run_flipped(all, std::nullopt);
    if (!together) return tl::unexpected<Error>(together.error());
    result.together = *together;
    return {};
  }

  /// Under one light, or under all. A flipped run that asks far more than the exact one has lost
  /// its way in contradictions.
  Expected<RunEffect> run_flipped(const DecisionWatch::Flips& flips,
                                  const std::optional<std::uint32_t>& light) {
    constexpr std::uint64_t kTimes = 4, kAtLeast = 100'000;
    RunEffect effect;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      if (light && *light != lights_[i]) continue;
      DecisionWatch watch(flips);
      const DecisionWatch::Scope scope(watch);
      watch.begin_light(lights_[i]);
      watch.stop_with(outside(), kTimes * exact_decisions_[i] + kAtLeast);
      const auto result = compute(lights_[i], &watch.stop(), watched_function);
      if (!result) {
        if (is_interrupted()) return tl::unexpected<Error>(result.error());
        effect.ended = false;
        continue;
      }
      add_changes(exact_[i], *result, effect);
    }
    return effect;
  }

  Expected<RunEffect> run_kernel() {
    RunEffect effect;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const auto result = compute(lights_[i], outside(), method_function);
      if (result) {
        add_changes(exact_[i], *result, effect);
      } else if (is_interrupted()) {
        return tl::unexpected<Error>(result.error());
      } else {
        effect.ended = false;
      }
    }
    return effect;
  }

  const std::atomic<bool>* outside() const { return control_.interrupted; }
  bool is_interrupted() const { return outside() != nullptr && outside()->load(); }
  void progress() {
    ++done_;
    if (control_.progress) {
      control_.progress(static_cast<double>(done_) / static_cast<double>(steps_));
    }
  }

  const PreparedScene& scene_;
  ShadowOptions options_;
  RunControl control_ = options_.control;  // of the caller
  const ExplainOptions& wanted_;
  LightList lights_;
  DecisionWatch recording_;
  std::vector<LightResult> exact_;  // of lights_
  std::vector<std::uint64_t> exact_decisions_;
  std::uint64_t done_ = 0, steps_ = lights_.size() + 1;
};

}  // namespace

std::uint64_t Explanation::times() const {
  return std::accumulate(
      decisions.begin(), decisions.end(), std::uint64_t{0},
      [](std::uint64_t sum, const DifferingDecision& decision) { return sum + decision.times; });
}

Expected<Explanation> explain(const PreparedScene& scene, const ShadowOptions& options,
                              const ExplainOptions& wanted) {
  auto lights = select_lights(scene, options);
  if (!lights) return tl::unexpected<Error>(lights.error());
  const auto make = checked(scene, options, *lights);
  if (!make) return tl::unexpected<Error>(make.error());
  return Explaining(scene, options, wanted, std::move(*lights), *make).run();
}

}  // namespace gnomon
