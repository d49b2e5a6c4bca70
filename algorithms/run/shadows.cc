// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/shadows.h"

#include <algorithm>
#include <string>
#include <utility>

#include "algorithms/partition/import_export.h"
#include "algorithms/run/by_receiver.h"
#include "algorithms/run/compute.h"
#include "algorithms/run/methods.h"
#include "algorithms/sectors/by_sectors.h"
#include "algorithms/svbsp/by_svbsp.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {

struct FragmentPlanesKernel;
struct SplitVerticesKernel;

MethodId method_of(LightType light, const ShadowOptions& options, bool together) {
  if (light == LightType::kArea) return options.area_algorithm;
  if (options.algorithm != MethodId::kAutomatic) return options.algorithm;
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

/// Adds what was found receiver by receiver to the result of the other lights, in order.
void join(ShadowResult& result, ShadowResult by_receiver, const ShadowOptions& options,
          const LightList& lights) {
  for (LightResult& light : by_receiver.lights) result.lights.push_back(std::move(light));
  const auto place = [&](const LightResult& light) {
    return std::find(lights.begin(), lights.end(), light.light) - lights.begin();
  };
  std::stable_sort(result.lights.begin(), result.lights.end(),
                   [&](const LightResult& a, const LightResult& b) { return place(a) < place(b); });
  const std::string own(method_info(options.algorithm == MethodId::kReceiver
                                        ? MethodId::kReceiver
                                        : options.area_algorithm)
                            .name);
  result.algorithm =
      result.algorithm.empty() || result.algorithm == own ? own : result.algorithm + "+" + own;
  if (!by_receiver.combined.empty()) {
    result.combined = std::move(by_receiver.combined);
    result.combined_points = std::move(by_receiver.combined_points);
    result.combined_exact_points = std::move(by_receiver.combined_exact_points);
  }
  result.stages += by_receiver.stages;
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
  if (!(options.thickness >= 0) || options.thickness >= 1) {
    return fail(ErrorCode::kUsage, "plane thickness " + std::to_string(options.thickness),
                "a fraction of the scene's diagonal, 0 <= thickness < 1");
  }
  return lights;
}

namespace {

/// Refuses a mutation that would do nothing, or that nobody has thought about.
Expected<void> check_mutation(const PreparedScene& scene, const ShadowOptions& options,
                              const LightList& lights) {
  const std::string name = "mutation " + std::string(name_of(options.mutation));
  if (options.combined) return fail(ErrorCode::kUsage, name + " of lights together", "one by one");
  if (options.mutation == Mutation::kThicknessTooSmall && options.thickness == 0) {
    return fail(ErrorCode::kUsage, name + " of planes that have no thickness", "a thickness");
  }
  const MethodId algorithm = method_of(LightType::kPoint, options, false);
  for (const std::uint32_t light : lights) {
    const bool applies =
        scene.lights[light].type == LightType::kArea
            ? applies_to_area(options.mutation, options.kernel, options.area_algorithm)
            : applies_to(options.mutation, options.kernel, algorithm);
    if (applies) return {};
  }
  return fail(ErrorCode::kUsage, name + " changes nothing",
              "a kernel, an algorithm and a light that it applies to (docs/bug-zoo.md)");
}

/// The options under which planes are as thick as the mutation has them.
ShadowOptions with_thickness_of(const ShadowOptions& options) {
  ShadowOptions own = options;
  if (options.mutation == Mutation::kThicknessTooLarge) own.thickness = kThicknessTooLarge;
  if (options.mutation == Mutation::kThicknessTooSmall) own.thickness = 0;
  return own;
}

MethodFunction planes_from_fragments(MethodId method, KernelId kernel) {
  return method == MethodId::kSvbsp ? &BySvbsp<FragmentPlanesKernel>::run
                                    : method_function(method, kernel);
}
MethodFunction vertices_per_side(MethodId method, KernelId) {
  switch (method) {
    case MethodId::kSectors:
      return &BySectors<SplitVerticesKernel>::run;
    case MethodId::kSvbsp:
      return &BySvbsp<SplitVerticesKernel>::run;
    default:
      return &ByReceiver<SplitVerticesKernel>::run;
  }
}

/// Mistakes that a wrapper of the kernel makes are in sources of their own.
MethodLookup lookup_of(Mutation mutation) {
  if (mutation == Mutation::kPlanesFromFragments) return planes_from_fragments;
  if (mutation == Mutation::kVerticesPerSide) return vertices_per_side;
  return method_function;
}

Expected<ShadowResult> compute_checked(const PreparedScene& scene, const ShadowOptions& options,
                                       const Rules& rules, const LightList& lights,
                                       MethodLookup lookup) {
  if (!has_kernel(options.kernel)) {
    return fail(ErrorCode::kUsage,
                "kernel " + std::string(kernel_info(options.kernel).name) + " was not built",
                "another kernel, or a build with GNOMON_CGAL_KERNELS");
  }
  const LightList together = options.combined ? lights : LightList{};
  const Ways ways = split_by_way(scene, options, lights);
  if (ways.by_receiver.empty()) {
    const MethodId method = method_of(LightType::kPoint, options, options.combined);
    return lookup(method, options.kernel)({scene, options, rules, lights, together});
  }
  if (options.combined && options.area_algorithm == MethodId::kPieces) {
    return fail(ErrorCode::kUsage, "pieces of lights have no classes together", "whole lights");
  }
  if (options.combined && lights.size() > 64) {
    return fail(ErrorCode::kLimit, std::to_string(lights.size()) + " lights together",
                "at most 64");
  }
  // Each way tells of its share of the work; the lights count alike.
  const double share =
      static_cast<double>(ways.light_space.size()) / static_cast<double>(lights.size());
  ShadowOptions own = options;
  if (options.progress) {
    own.progress = [&](double done) { options.progress(share * done); };
  }
  ShadowResult result = empty_result(options);
  const LightList none;
  if (!ways.light_space.empty()) {
    const MethodId method = method_of(LightType::kPoint, options, false);
    auto light_space = lookup(method, options.kernel)({scene, own, rules, ways.light_space, none});
    if (!light_space) return light_space;
    result = std::move(*light_space);
  }
  if (options.progress) {
    own.progress = [&](double done) { options.progress(share + (1 - share) * done); };
  }
  const double start = cpu_seconds();
  auto by_receiver = lookup(options.area_algorithm,
                            options.kernel)({scene, own, rules, ways.by_receiver, together});
  if (!by_receiver) return by_receiver;
  join(result, std::move(*by_receiver), options, lights);
  result.shadow_seconds += cpu_seconds() - start;
  return result;
}

}  // namespace

Expected<ShadowResult> compute_with(const PreparedScene& scene, const ShadowOptions& options,
                                    const Rules& rules, MethodLookup lookup) {
  const Expected<LightList> lights = select_lights(scene, options);
  if (!lights) return tl::unexpected<Error>(lights.error());
  if (options.mutation == Mutation::kNone) {
    return compute_checked(scene, options, rules, *lights, lookup);
  }
  if (const auto checked = check_mutation(scene, options, *lights); !checked) {
    return tl::unexpected<Error>(checked.error());
  }
  return compute_checked(scene, with_thickness_of(options), rules, *lights,
                         lookup_of(options.mutation));
}

Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options) {
  return compute_with(scene, options, Rules{});
}

}  // namespace gnomon
