// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/pixels.h"

#include <string>
#include <utility>

#include "algorithms/partition/import_export.h"
#include "algorithms/partition/run_task.h"
#include "algorithms/run/compute.h"
#include "algorithms/run/compute_pixels.h"
#include "algorithms/run/methods.h"
#include "algorithms/run/sampled_fragments.h"
#include "gnomon/algorithms/shadows.h"
#include "kernel/signs/fp_environment.h"

namespace gnomon {
namespace {

constexpr std::size_t kMostLights = 64;  // bits of a sample

Expected<std::vector<std::uint32_t>> lights_of(const PreparedScene& scene,
                                               const PixelOptions& options) {
  std::vector<std::uint32_t> lights = options.lights;
  if (lights.empty()) {
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l) lights.push_back(l);
  }
  for (const std::uint32_t light : lights) {
    if (light >= scene.lights.size()) {
      return fail(ErrorCode::kUsage, "there is no light " + std::to_string(light),
                  "an index below " + std::to_string(scene.lights.size()));
    }
    if (scene.lights[light].has_area()) {
      return fail(ErrorCode::kUsage, "area lights have no exact samples",
                  "point and directional lights");
    }
  }
  if (lights.size() > kMostLights) {
    return fail(ErrorCode::kLimit, std::to_string(lights.size()) + " lights in one picture",
                "at most " + std::to_string(kMostLights));
  }
  return lights;
}

ShadowOptions shadow_options_of(const PixelOptions& options,
                                const std::vector<std::uint32_t>& lights) {
  ShadowOptions shadows;
  shadows.kernel = options.kernel;
  shadows.method.point = options.method;
  shadows.method.options = options.options;
  shadows.lights = lights;
  shadows.output.points = true;
  shadows.output.exact_points = kernel_info(options.kernel.id).exact;
  shadows.output.stage_counts = options.stage_counts;
  shadows.tuning.jobs = options.jobs;
  shadows.control.interrupted = options.control.interrupted;
  return shadows;
}

/// What a method of object space found, at the samples that see something.
Expected<PixelWork> sample_fragments(const PixelTask& task, Pixels& pixels) {
  const Method& method = method_info(task.options.method);
  if (!method.makes_fragments) {
    return fail(ErrorCode::kUsage,
                std::string(method.name) + " makes no fragments, and so has nothing to sample",
                "another method");
  }
  const std::vector<std::uint32_t> no_lights;
  const PixelTask visible{task.scene, task.frame, task.options, task.rules, no_lights, task.sink};
  auto work = pixel_function(MethodId::kZbuffer, task.options.kernel.id)(visible);
  if (!work || task.lights.empty()) return work;
  const auto result =
      compute_with(task.scene, shadow_options_of(task.options, task.lights), task.rules);
  if (!result) return tl::unexpected(result.error());
  SampledFragments fragments(task.scene, task.frame, *result);
  for (std::uint32_t j = 0; j < pixels.height; ++j) {
    if (task.interrupted()) return stopped_by(RunOutcome::kInterrupted, {});
    for (std::uint32_t i = 0; i < pixels.width; ++i) {
      const std::size_t s = pixels.index({i, j});
      if (pixels.part[s] == Pixels::kNoPart) continue;
      pixels.lit_by[s] = fragments.lights_at(pixels.part[s], {i, j});
    }
  }
  work->work = {};
  for (const LightResult& light : result->lights) work->work += light.work;
  work->stages += result->stages;
  return work;
}

}  // namespace

Expected<Pixels> compute_pixels_with(const PreparedScene& scene, const ImageFrame& frame,
                                     const PixelOptions& options, const Rules& rules) {
  if (const auto environment = check_fp_environment(); !environment) {
    return tl::unexpected<Error>(environment.error());
  }
  if (!has_kernel(options.kernel.id)) {
    return fail(ErrorCode::kUsage,
                "kernel " + std::string(kernel_info(options.kernel.id).name) + " was not built",
                "another kernel, or a build with GNOMON_CGAL_KERNELS");
  }
  auto lights = lights_of(scene, options);
  if (!lights) return tl::unexpected(std::move(lights.error()));
  const KernelInfo& kernel = kernel_info(options.kernel.id);
  Pixels pixels;
  pixels.kernel = kernel.name;
  pixels.algorithm = method_text(options.method, options.options);
  pixels.exact = kernel.exact;
  pixels.width = frame.width;
  pixels.height = frame.height;
  pixels.lights = *lights;
  PixelSink sink(pixels, options.caster_counts && method_info(options.method).counts_casters);
  const double start = cpu_seconds();
  const PixelTask task{scene, frame, options, rules, *lights, sink};
  const PixelFunction own = pixel_function(options.method, options.kernel.id);
  const auto work = own != nullptr ? own(task) : sample_fragments(task, pixels);
  if (!work) return tl::unexpected(work.error());
  pixels.seconds = cpu_seconds() - start;
  pixels.work = work->work;
  pixels.stages = work->stages;
  pixels.table_seconds = work->table_seconds;
  pixels.lookup_seconds = work->lookup_seconds;
  return pixels;
}

Expected<Pixels> compute_pixels(const PreparedScene& scene, const ImageFrame& frame,
                                const PixelOptions& options) {
  return compute_pixels_with(scene, frame, options, Rules{});
}

}  // namespace gnomon
