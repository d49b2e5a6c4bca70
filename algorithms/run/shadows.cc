// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/shadows.h"

#include <algorithm>
#include <utility>

#include "algorithms/partition/import_export.h"
#include "algorithms/run/area_kernels.h"
#include "algorithms/run/light_selection.h"
#include "algorithms/run/shadow_kernels.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {
namespace {

using ShadowFunction = ShadowOutcome (*)(const PreparedScene&, const ShadowOptions&,
                                         const LightList&);
/// The two instantiations of a kernel.
struct KernelFunctions {
  ShadowFunction shadows = nullptr;
  AreaFunction area = nullptr;
};

KernelFunctions functions_of(KernelId kernel) {
  switch (kernel) {
    case KernelId::kFloat:
      return {shadows_float, area_float};
    case KernelId::kDouble:
      return {shadows_double, area_double};
    case KernelId::kLongDouble:
      return {shadows_long_double, area_long_double};
#ifndef GNOMON_NO_CGAL_KERNELS
    case KernelId::kEpick:
      return {shadows_epick, area_epick};
    case KernelId::kEpeck:
      return {shadows_epeck, area_epeck};
#else
    case KernelId::kEpick:
    case KernelId::kEpeck:
      break;
#endif
    case KernelId::kRational:
      return {shadows_rational, area_rational};
    case KernelId::kPlane:
      return {shadows_plane, area_plane};
  }
  return {};
}

/// Mistakes that a wrapper of the kernel makes are in sources of their own.
KernelFunctions functions_of(KernelId kernel, Mutation mutation) {
  switch (mutation) {
    case Mutation::kPlanesFromFragments:
      return {shadows_planes_from_fragments, area_double};
    case Mutation::kVerticesPerSide:
      return {shadows_vertices_per_side, area_vertices_per_side};
    default:
      return functions_of(kernel);
  }
}

/// Which lights are found receiver by receiver, and which by the algorithms of light space.
struct LightsByWay {
  LightList light_space, by_receiver;
};

LightsByWay split_by_way(const PreparedScene& scene, const ShadowOptions& options,
                         const LightList& lights) {
  LightsByWay result;
  for (const std::uint32_t light : lights) {
    const bool area = scene.lights[light].type == LightType::kArea;
    const bool by_receiver = area || options.algorithm == Algorithm::kReceiver;
    (by_receiver ? result.by_receiver : result.light_space).push_back(light);
  }
  return result;
}

std::string_view name_of(AreaAlgorithm algorithm) {
  switch (algorithm) {
    case AreaAlgorithm::kReceiver:
      return "receiver";
    case AreaAlgorithm::kMerged:
      return "merged";
    case AreaAlgorithm::kPieces:
      return "pieces";
  }
  return {};
}

/// Adds what was found receiver by receiver to the result of the other lights, in order.
void join(ShadowResult& result, AreaOutcome area, const ShadowOptions& options,
          const LightList& lights) {
  for (LightResult& light : area.lights) result.lights.push_back(std::move(light));
  const auto place = [&](const LightResult& light) {
    return std::find(lights.begin(), lights.end(), light.light) - lights.begin();
  };
  std::stable_sort(result.lights.begin(), result.lights.end(),
                   [&](const LightResult& a, const LightResult& b) { return place(a) < place(b); });
  const std::string own(
      options.algorithm == Algorithm::kReceiver ? "receiver" : name_of(options.area_algorithm));
  result.algorithm =
      result.algorithm.empty() || result.algorithm == own ? own : result.algorithm + "+" + own;
  if (!area.combined.empty()) {
    result.combined = std::move(area.combined);
    result.combined_points = std::move(area.combined_points);
    result.combined_exact_points = std::move(area.combined_exact_points);
  }
  result.stages += area.stages;
}

}  // namespace

bool has_kernel(KernelId kernel) { return functions_of(kernel).shadows != nullptr; }

Expected<std::vector<std::uint32_t>> select_lights(const PreparedScene& scene,
                                                   const ShadowOptions& options) {
  if (const auto environment = check_fp_environment(); !environment) {
    return tl::unexpected<Error>(environment.error());
  }
  std::vector<std::uint32_t> lights = options.lights;
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
  const Algorithm algorithm =
      options.algorithm == Algorithm::kAutomatic ? Algorithm::kSectors : options.algorithm;
  for (const std::uint32_t light : lights) {
    const bool applies = scene.lights[light].type == LightType::kArea
                             ? applies_to(options.mutation, options.kernel, options.area_algorithm)
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

Expected<ShadowResult> compute_checked(const PreparedScene& scene, const ShadowOptions& options,
                                       const LightList& lights) {
  const KernelFunctions functions = functions_of(options.kernel, options.mutation);
  if (functions.shadows == nullptr) {
    return fail(ErrorCode::kUsage,
                "kernel " + std::string(kernel_info(options.kernel).name) + " was not built",
                "another kernel, or a build with GNOMON_CGAL_KERNELS");
  }
  const LightsByWay ways = split_by_way(scene, options, lights);
  if (ways.by_receiver.empty()) return functions.shadows(scene, options, lights);
  if (options.combined && options.area_algorithm == AreaAlgorithm::kPieces) {
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
  own.combined = false;
  if (options.progress) {
    own.progress = [&](double done) { options.progress(share * done); };
  }
  ShadowResult result;
  if (!ways.light_space.empty()) {
    ShadowOutcome light_space = functions.shadows(scene, own, ways.light_space);
    if (!light_space) return light_space;
    result = std::move(*light_space);
  } else {
    const KernelInfo& kernel = kernel_info(options.kernel);
    result.kernel = kernel.name;
    result.exact = kernel.exact;
    result.identity = options.identity || kernel.exact;
    result.thickness = kernel.exact ? 0 : options.thickness;
  }
  if (options.progress) {
    own.progress = [&](double done) { options.progress(share + (1 - share) * done); };
  }
  const double start = cpu_seconds();
  Expected<AreaOutcome> area =
      functions.area(scene, own, ways.by_receiver, options.combined ? lights : LightList{});
  if (!area) return tl::unexpected<Error>(area.error());
  join(result, std::move(*area), options, lights);
  result.shadow_seconds += cpu_seconds() - start;
  return result;
}

}  // namespace

Expected<ShadowResult> compute_shadows(const PreparedScene& scene, const ShadowOptions& options) {
  const Expected<std::vector<std::uint32_t>> lights = select_lights(scene, options);
  if (!lights) return tl::unexpected<Error>(lights.error());
  if (options.mutation == Mutation::kNone) return compute_checked(scene, options, *lights);
  if (const auto checked = check_mutation(scene, options, *lights); !checked) {
    return tl::unexpected<Error>(checked.error());
  }
  return compute_checked(scene, with_thickness_of(options), *lights);
}

}  // namespace gnomon
