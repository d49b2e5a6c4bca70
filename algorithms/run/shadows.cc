// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/shadows.h"

#include <algorithm>
#include <string>
#include <utility>

#include "algorithms/partition/import_export.h"
#include "algorithms/run/compute.h"
#include "algorithms/run/methods.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

MethodId method_of(LightType light, const ShadowOptions& options, bool together) {
  if (light == LightType::kArea) return options.method.area;
  if (options.method.point != MethodId::kAutomatic) return options.method.point;
  return together ? MethodId::kSvbsp : MethodId::kSectors;
}

namespace {

/// Lights that one run classifies; each way to shadows has a run of its own.
struct Ways {
  LightList light_space, by_receiver;
};

/// A method that takes area lights works receiver by receiver in three dimensions, and so do its
/// point lights; the others work in the space of one light.
bool is_by_receiver(LightType light, const ShadowOptions& options) {
  return method_info(method_of(light, options, false)).lights.area;
}

Ways split_by_way(const PreparedScene& scene, const ShadowOptions& options,
                  const LightList& lights) {
  Ways result;
  for (const std::uint32_t light : lights) {
    const bool by_receiver = is_by_receiver(scene.lights[light].type, options);
    (by_receiver ? result.by_receiver : result.light_space).push_back(light);
  }
  return result;
}

/// Names a method in the result, after those that are named there.
void add_name(ShadowResult& result, MethodId method, const MethodOptionValues& values) {
  const std::string own = method_text(method, values);
  if (result.algorithm == own) return;
  result.algorithm += (result.algorithm.empty() ? "" : "+") + own;
}

/// Adds what was found receiver by receiver to the result of the other lights, in order.
void join(ShadowResult& result, ShadowResult by_receiver, const LightList& lights) {
  for (LightResult& light : by_receiver.lights) result.lights.push_back(std::move(light));
  const auto place = [&](const LightResult& light) {
    return std::find(lights.begin(), lights.end(), light.light) - lights.begin();
  };
  std::stable_sort(result.lights.begin(), result.lights.end(),
                   [&](const LightResult& a, const LightResult& b) { return place(a) < place(b); });
  if (!by_receiver.combined.empty()) {
    result.combined = std::move(by_receiver.combined);
    result.combined_points = std::move(by_receiver.combined_points);
    result.combined_exact_points = std::move(by_receiver.combined_exact_points);
  }
  result.stages += by_receiver.stages;
}

/// A method's result bears the name that its row has.
Expected<ShadowResult> run_method(MethodId method, MethodLookup lookup, const RunTask& task) {
  Expected<ShadowResult> result = lookup(method, task.options.kernel.id)(task);
  if (!result) return result;
  result->algorithm = method_text(method, task.options.method.options);
  for (LightResult& light : result->lights) light.method = method;
  return result;
}

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

Expected<ShadowResult> compute_checked(const PreparedScene& scene, const ShadowOptions& options,
                                       const Rules& rules, const LightList& lights,
                                       MethodLookup lookup) {
  if (!has_kernel(options.kernel.id)) {
    return fail(ErrorCode::kUsage,
                "kernel " + std::string(kernel_info(options.kernel.id).name) + " was not built",
                "another kernel, or a build with GNOMON_CGAL_KERNELS");
  }
  const LightList together = options.output.combined ? lights : LightList{};
  const Ways ways = split_by_way(scene, options, lights);
  if (ways.by_receiver.empty()) {
    const MethodId method = method_of(LightType::kPoint, options, options.output.combined);
    return run_method(method, lookup, {scene, options, rules, lights, together});
  }
  if (options.output.combined && options.method.area == MethodId::kPieces) {
    return fail(ErrorCode::kUsage, "pieces of lights have no classes together", "whole lights");
  }
  if (options.output.combined && options.method.options.cover == Cover::kOverlay) {
    return fail(ErrorCode::kUsage, "shadows of area lights cannot be painted on shadows",
                "point and directional lights alone, or cover=partition");
  }
  if (options.output.combined && lights.size() > 64) {
    return fail(ErrorCode::kLimit, std::to_string(lights.size()) + " lights together",
                "at most 64");
  }
  // Each way tells of its share of the work; the lights count alike.
  const double share =
      static_cast<double>(ways.light_space.size()) / static_cast<double>(lights.size());
  ShadowOptions own = options;
  if (options.control.progress) {
    own.control.progress = [&](double done) { options.control.progress(share * done); };
  }
  ShadowResult result = empty_result(options);
  const LightList none;
  if (!ways.light_space.empty()) {
    const MethodId method = method_of(LightType::kPoint, options, false);
    auto light_space = run_method(method, lookup, {scene, own, rules, ways.light_space, none});
    if (!light_space) return light_space;
    result = std::move(*light_space);
  }
  if (options.control.progress) {
    own.control.progress = [&](double done) {
      options.control.progress(share + (1 - share) * done);
    };
  }
  const double start = cpu_seconds();
  auto by_receiver = lookup(options.method.area,
                            options.kernel.id)({scene, own, rules, ways.by_receiver, together});
  if (!by_receiver) return by_receiver;
  for (LightResult& light : by_receiver->lights) {
    const bool area = scene.lights[light.light].has_area();
    light.method = area ? options.method.area : options.method.point;
  }
  for (const bool area : {false, true}) {
    const bool is_there = std::ranges::any_of(ways.by_receiver, [&](std::uint32_t light) {
      return scene.lights[light].has_area() == area;
    });
    if (!is_there) continue;
    add_name(result, area ? options.method.area : options.method.point, options.method.options);
  }
  join(result, std::move(*by_receiver), lights);
  result.shadow_seconds += cpu_seconds() - start;
  return result;
}

}  // namespace

Expected<ShadowResult> compute_with(const PreparedScene& scene, const ShadowOptions& options,
                                    const Rules& rules, MethodLookup lookup) {
  const Expected<LightList> lights = select_lights(scene, options);
  if (!lights) return tl::unexpected<Error>(lights.error());
  return compute_checked(scene, options, rules, *lights, lookup);
}

Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options) {
  return compute_with(scene, options, Rules{});
}

}  // namespace gnomon
