// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/shadows.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/partition/import_export.h"
#include "algorithms/run/canonical_order.h"
#include "algorithms/run/compute.h"
#include "algorithms/run/methods.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

MethodId method_of(LightType light, const ShadowOptions& options, bool together) {
  const ShadowOutput& output = options.output;
  const bool shares_alone = !output.points && !output.exact_points && !output.exact_fractions;
  if (light == LightType::kArea) {
    if (options.method.area != MethodId::kAutomatic) return options.method.area;
    // Other kernels have every receiver cut by either method.
    const bool by_contour =
        shares_alone && !output.combined && options.kernel.id == KernelId::kPlane;
    return by_contour ? MethodId::kContour : MethodId::kReceiver;
  }
  if (options.method.point != MethodId::kAutomatic) return options.method.point;
  if (together) return MethodId::kSvbsp;
  const bool exact = kernel_info(options.kernel.id).exact;
  return shares_alone && exact ? MethodId::kContour : MethodId::kSectors;
}

namespace {

/// Lights that one call of a method classifies.
struct MethodRun {
  bool by_receiver = false;
  LightList lights;
};

/// A method that takes area lights works receiver by receiver in three dimensions, and so do its
/// point lights, but for contour, which sees those from the light; the others work in the space of
/// one light.
bool is_by_receiver(LightType light, const ShadowOptions& options) {
  const MethodId method = method_of(light, options, false);
  return light == LightType::kArea ||
         (method != MethodId::kContour && method_info(method).lights.area);
}

/// One run for each way to shadows, light space first. Who takes lights one by one takes them in
/// order: then a run ends where the way changes.
std::vector<MethodRun> runs_of(const PreparedScene& scene, const ShadowOptions& options,
                               const LightList& lights) {
  std::vector<MethodRun> runs;
  for (const std::uint32_t light : lights) {
    const bool by_receiver = is_by_receiver(scene.lights[light].type, options);
    auto own = options.control.light_done && !runs.empty() ? runs.end() - 1 : runs.begin();
    own = std::ranges::find(own, runs.end(), by_receiver, &MethodRun::by_receiver);
    if (own == runs.end()) own = runs.insert(runs.end(), {by_receiver, {}});
    own->lights.push_back(light);
  }
  if (runs.empty()) runs.emplace_back();
  if (!options.control.light_done) std::ranges::sort(runs, {}, &MethodRun::by_receiver);
  return runs;
}

/// Adds what another run found.
void join(ShadowResult& result, ShadowResult run) {
  std::ranges::move(run.lights, std::back_inserter(result.lights));
  if (!run.combined.empty()) {
    result.combined = std::move(run.combined);
    result.combined_points = std::move(run.combined_points);
    result.combined_exact_points = std::move(run.combined_exact_points);
  }
  if (!run.overlay.empty()) {
    result.overlay = std::move(run.overlay);
    result.overlay_points = std::move(run.overlay_points);
    result.overlay_exact_points = std::move(run.overlay_exact_points);
  }
  result.scene_bsp_seconds += run.scene_bsp_seconds;
  result.shadow_seconds += run.shadow_seconds;
  result.stages += run.stages;
  result.bsp_nodes += run.bsp_nodes;
  result.bsp_fragments += run.bsp_fragments;
  result.bsp_depth = std::max(result.bsp_depth, run.bsp_depth);
  if (run.together.trees > 0) result.together = run.together;
}

/// What a lamp or a panel cannot do together with others.
Expected<void> check_together(const ShadowOptions& options, const LightList& lights) {
  if (options.method.area == MethodId::kPieces) {
    return fail(ErrorCode::kUsage, "pieces of lights have no classes together", "whole lights");
  }
  if (options.method.options.cover == Cover::kOverlay) {
    return fail(ErrorCode::kUsage, "shadows of area lights cannot be painted on shadows",
                "point and directional lights alone, or cover=partition");
  }
  if (lights.size() > 64) {
    return fail(ErrorCode::kLimit, std::to_string(lights.size()) + " lights together",
                "at most 64");
  }
  return {};
}

/// All lights, by as many runs as it takes; what it says of them is in the order of lights.
class Computation {
 public:
  Computation(const PreparedScene& scene, const ShadowOptions& options, const Rules& rules,
              const LightList& lights, MethodLookup lookup)
      : scene_(scene),
        options_(options),
        own_(options),
        rules_(rules),
        lights_(lights),
        lookup_(lookup),
        runs_(runs_of(scene, options, lights)) {
    by_receiver_ = std::ranges::any_of(runs_, &MethodRun::by_receiver);
    own_.method.area = method_of(LightType::kArea, options, false);
    if (options.control.light_done) {
      own_.control.light_done = [this](LightResult&& light) {
        light.method = method(light.light);
        return options_.control.light_done(std::move(light));
      };
    }
  }

  Expected<ShadowResult> run() {
    if (by_receiver_ && options_.output.combined) {
      if (const auto checked = check_together(options_, lights_); !checked) {
        return tl::unexpected<Error>(checked.error());
      }
    }
    ShadowResult result = empty_result(options_);
    bool combined = options_.output.combined;
    std::size_t done = 0;
    for (const MethodRun& run : runs_) {
      const bool has_combined = combined && run.by_receiver == by_receiver_;
      auto found = run_method(run, done, has_combined ? lights_ : LightList{});
      if (!found) return found;
      if (has_combined) combined = false;
      done += run.lights.size();
      join(result, std::move(*found));
    }
    for (LightResult& light : result.lights) light.method = method(light.light);
    if (runs_.size() > 1) sort_by_place(result.lights);
    add_names(result);
    return result;
  }

 private:
  MethodId method_of_type(LightType type) const {
    return method_of(type, options_, options_.output.combined && !by_receiver_);
  }
  MethodId method(std::uint32_t light) const { return method_of_type(scene_.lights[light].type); }

  /// Each run tells of its share of the work; the lights count alike.
  Expected<ShadowResult> run_method(const MethodRun& run, std::size_t done,
                                    const LightList& combined) {
    if (options_.control.progress && runs_.size() > 1) {
      const double all = static_cast<double>(lights_.size());
      const double from = static_cast<double>(done) / all;
      const double share = static_cast<double>(run.lights.size()) / all;
      own_.control.progress = [=, this](double own) {
        options_.control.progress(from + share * own);
      };
    }
    const double start = cpu_seconds();
    MethodId method = run.by_receiver ? own_.method.area : method_of_type(LightType::kPoint);
    // What contour leaves open is for the same run to cut.
    if (run.by_receiver && method == MethodId::kContour) method = MethodId::kReceiver;
    Expected<ShadowResult> result =
        lookup_(method, options_.kernel.id)({scene_, own_, rules_, run.lights, combined});
    if (result && run.by_receiver) result->shadow_seconds = cpu_seconds() - start;
    return result;
  }

  void sort_by_place(std::vector<LightResult>& results) const {
    std::vector<std::size_t> place(scene_.lights.size());
    for (std::size_t i = lights_.size(); i-- > 0;) place[lights_[i]] = i;
    std::ranges::stable_sort(results, {},
                             [&](const LightResult& light) { return place[light.light]; });
  }

  /// Names the methods: of light space first, then of point and of area lights.
  void add_names(ShadowResult& result) const {
    const auto add = [&](MethodId method) {
      const std::string own = method_text(method, options_.method.options);
      if (result.algorithm == own) return;
      result.algorithm += (result.algorithm.empty() ? "" : "+") + own;
    };
    if (!std::ranges::all_of(runs_, &MethodRun::by_receiver)) {
      add(method_of_type(LightType::kPoint));
    }
    for (const bool area : {false, true}) {
      const bool is_there = std::ranges::any_of(runs_, [&](const MethodRun& run) {
        return run.by_receiver && std::ranges::any_of(run.lights, [&](std::uint32_t light) {
                 return scene_.lights[light].has_area() == area;
               });
      });
      if (is_there) add(area ? own_.method.area : options_.method.point);
    }
  }

  const PreparedScene& scene_;
  const ShadowOptions& options_;
  ShadowOptions own_;  // with the shares of progress, and the names of methods
  const Rules& rules_;
  const LightList& lights_;
  MethodLookup lookup_;
  std::vector<MethodRun> runs_;
  bool by_receiver_ = false;  // some of the runs are
};

}  // namespace

bool has_kernel(KernelId kernel) { return method_function(MethodId::kSectors, kernel) != nullptr; }

Expected<LightList> select_lights(const PreparedScene& scene, const ShadowOptions& options) {
  if (const auto environment = check_fp_environment(); !environment) {
    return tl::unexpected<Error>(environment.error());
  }
  LightList lights = options.lights;
  if (lights.empty()) {
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) lights.push_back(i);
  }
  for (const std::uint32_t light : lights) {
    if (light >= scene.lights.size()) {
      return fail(ErrorCode::kUsage, "there is no light " + std::to_string(light),
                  "an index below " + std::to_string(scene.lights.size()));
    }
  }
  if (!(options.kernel.thickness >= 0) || options.kernel.thickness >= 1) {
    return fail(ErrorCode::kUsage, "plane thickness " + std::to_string(options.kernel.thickness),
                "a fraction of the scene's diagonal, 0 <= thickness < 1");
  }
  return lights;
}

namespace {

/// Where a rounded kernel gives up, if not before: its cuts may make children that are both the
/// parent, and so never come to an end (docs: kernels). Each receiver cut along all edges of the
/// scene has fewer fragments.
std::uint64_t most_fragments_of_rounded(const PreparedScene& scene) {
  constexpr std::uint64_t kLeast = 200'000;
  return std::max<std::uint64_t>(kLeast, scene.parts.size() * scene.loop_vertices.size());
}

/// Lights that contour does not know: with a region, and eyes where some parts cast no shadow.
bool need_fragments(const PreparedScene& scene, const LightList& lights) {
  const bool all_cast = std::ranges::all_of(scene.parts, &Part::casts);
  return std::ranges::any_of(lights, [&](std::uint32_t light) {
    return !scene.lights[light].region.empty() || (scene.lights[light].is_eye && !all_cast);
  });
}

/// Steps are those of several point and directional lights together, by svbsp.
Expected<void> check_steps(const PreparedScene& scene, const ShadowOptions& options,
                           const LightList& lights) {
  if (options.steps.empty()) return {};
  if (!options.output.combined || !options.control.step_done || options.control.light_done) {
    return fail(ErrorCode::kUsage, "lights move one by one",
                "lights together, and who takes the steps");
  }
  const MethodId method = method_of(LightType::kPoint, options, true);
  if (!method_info(method).moves_lights) {
    return fail(ErrorCode::kUsage,
                "lights that move need svbsp, not " + std::string(method_info(method).name),
                "svbsp");
  }
  const auto check = [&](const LightList& step) -> Expected<void> {
    if (step.size() != lights.size()) {
      return fail(ErrorCode::kUsage, "a step of " + std::to_string(step.size()) + " lights",
                  std::to_string(lights.size()));
    }
    for (const std::uint32_t light : step) {
      if (light < scene.lights.size() && !scene.lights[light].has_area()) continue;
      return fail(ErrorCode::kUsage, "light " + std::to_string(light) + " of a step",
                  "a point or directional light of the scene");
    }
    return {};
  };
  for (const LightList& step : options.steps) {
    if (auto checked = check(step); !checked) return checked;
  }
  return check(lights);
}

Expected<ShadowResult> compute_checked(const PreparedScene& scene, const ShadowOptions& options,
                                       const Rules& rules, const LightList& lights,
                                       MethodLookup lookup) {
  if (!has_kernel(options.kernel.id)) {
    return fail(ErrorCode::kUsage,
                "kernel " + std::string(kernel_info(options.kernel.id).name) + " was not built",
                "another kernel, or a build with GNOMON_CGAL_KERNELS");
  }
  if (kernel_info(options.kernel.id).exact) {
    return Computation(scene, options, rules, lights, lookup).run();
  }
  const CanonicalOrder order(scene, options.method.options.order == InsertionOrder::kFile);
  ShadowOptions own = options;
  own.limits.fragments = std::min(own.limits.fragments, most_fragments_of_rounded(scene));
  if (options.control.light_done) {
    own.control.light_done = [&](LightResult&& light) {
      order.restore(light);
      return options.control.light_done(std::move(light));
    };
  }
  if (options.control.step_done) {
    own.control.step_done = [&](const ShadowResult& step) {
      ShadowResult restored = step;
      order.restore(restored);
      return options.control.step_done(restored);
    };
  }
  Expected<ShadowResult> result = Computation(order.scene(), own, rules, lights, lookup).run();
  if (result) {
    order.restore(*result);
  } else if (result.error().code == ErrorCode::kLimit && lights.size() <= 64) {
    result.error().what = "gave up: " + result.error().what;
    result.error().expected = "cuts that come to an end, which a rounded kernel does not promise";
  }
  return result;
}

}  // namespace

Expected<ShadowResult> compute_with(const PreparedScene& scene, const ShadowOptions& options,
                                    const Rules& rules, MethodLookup lookup) {
  const Expected<LightList> lights = select_lights(scene, options);
  if (!lights) return tl::unexpected<Error>(lights.error());
  if (const auto checked = check_steps(scene, options, *lights); !checked) {
    return tl::unexpected<Error>(checked.error());
  }
  if (!need_fragments(scene, *lights)) {
    return compute_checked(scene, options, rules, *lights, lookup);
  }
  if (options.method.point == MethodId::kContour) {
    return fail(ErrorCode::kUsage,
                "contour knows neither regions of lights nor polygons that hide and cast nothing",
                "another method, such as sectors");
  }
  ShadowOptions own = options;
  if (own.method.point == MethodId::kAutomatic) {
    own.method.point = own.output.combined ? MethodId::kSvbsp : MethodId::kSectors;
  }
  return compute_checked(scene, own, rules, *lights, lookup);
}

Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options) {
  return compute_with(scene, options, Rules{});
}

}  // namespace gnomon
