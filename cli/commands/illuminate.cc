// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/illuminate.h"

#include <cmath>
#include <cstdio>
#include <vector>

#include "cli/common/algorithm_choice.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "cli/common/result_shape.h"
#include "gnomon/algorithms/illumination.h"
#include "gnomon/scene/number.h"
#include "report/meshes/shaded_mesh_files.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

/// A step of a grid as the decimal that was typed.
Expected<mpq_class> parse_step(const std::string& option, const std::string& text) {
  const auto number = Number::parse(text, NumberMeaning::kDecimal);
  if (!number || number->sign() < 0) {
    return fail(ErrorCode::kUsage, option + " '" + text + "' is no length",
                "a number of scene units, 0 for no grid");
  }
  return number->exact();
}

Expected<void> parse_grid(const std::string& text, ShadingOptions& options) {
  if (text.empty()) return {};
  const std::size_t comma = text.find(',');
  auto lit = parse_step("--grid", text.substr(0, comma));
  if (!lit) return tl::unexpected(std::move(lit.error()));
  options.lit_step = *lit;
  options.penumbra_step = *lit / 2;
  if (comma == std::string::npos) return {};
  auto penumbra = parse_step("--grid", text.substr(comma + 1));
  if (!penumbra) return tl::unexpected(std::move(penumbra.error()));
  options.penumbra_step = *penumbra;
  return {};
}

Expected<ShadingOptions> shading_options(const IlluminateOptions& options,
                                         const LoadedScene& loaded) {
  ShadingOptions shading;
  if (auto done = parse_grid(options.grid, shading); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  // A scene of doubles has its 0.3 at the nearest double, and wants the grid's line there.
  shading.round_lines = loaded.scene.numbers == NumberMeaning::kDouble;
  shading.tolerance = options.adaptive;
  shading.ambient = options.ambient;
  return shading;
}

const Light& light_of(const LoadedScene& loaded, std::uint32_t light) {
  return loaded.scene.lights[loaded.prepared.lights[light].light];
}

}  // namespace

CLI::Option* add_illuminate_options(CLI::App& command, IlluminateOptions& options,
                                    const std::string& description) {
  CLI::Option* illuminate = command.add_flag("--illuminate", options.illuminate, description);
  const auto add = [&](CLI::Option* option) { option->needs(illuminate); };
  add(command
          .add_option(
              "--grid", options.grid,
              "Cut lit fragments by a grid of step LIT, those in penumbra of step PENUMBRA\n"
              "[half of LIT]; scene units, 0 for no grid")
          ->type_name("LIT[,PENUMBRA]"));
  add(command
          .add_option("--adaptive", options.adaptive,
                      "Cut fragments where linear interpolation is off by more than this fraction\n"
                      "of what they receive")
          ->check(not_negative())
          ->type_name("TOL"));
  add(command
          .add_option("--ambient", options.ambient,
                      "What every point receives besides, and all that the umbra has [0]")
          ->check(not_negative())
          ->type_name("F"));
  add(command
          .add_option("--exposure", options.exposure,
                      "White is 1 / F of illumination [the largest of the mesh]")
          ->check(not_negative())
          ->type_name("F"));
  add(command.add_flag("--tint", options.tint,
                       "Colour by class: lit yellow, penumbra grey, umbra blue"));
  return illuminate;
}

void add_mesh_option(CLI::App& command, IlluminateOptions& options, CLI::Option* illuminate) {
  CLI::Option* mesh =
      command.add_option("--mesh", options.mesh,
                         "The illuminated fragments as a mesh with a colour a vertex: .ply, .gltf "
                         "or .glb");
  mesh->needs(illuminate)->type_name("FILE");
  command
      .add_flag("--plain-ply", options.plain_ply,
                "PLY of single precision, without the numbers of triangles, which meshio, PCL and "
                "the like do not read")
      ->needs(mesh);
}

Expected<void> ask_for_illumination(const IlluminateOptions& options, const LoadedScene& loaded,
                                    const std::string& algorithm, ShadowOptions& shadows) {
  if (!options.illuminate) return {};
  if (auto shading = shading_options(options, loaded); !shading) {
    return tl::unexpected(std::move(shading.error()));
  }
  if (!options.mesh.empty()) {
    if (auto format = report::mesh_file_format(options.mesh); !format) {
      return tl::unexpected(std::move(format.error()));
    }
  }
  if (!kernel_info(shadows.kernel.id).exact) {
    return needs_exact_kernel("--illuminate", std::string(kernel_info(shadows.kernel.id).name));
  }
  if (loaded.lights.size() > 64) {
    return fail(ErrorCode::kUsage,
                "--illuminate: " + std::to_string(loaded.lights.size()) + " lights",
                "at most 64; --light chooses some");
  }
  for (const std::uint32_t light : loaded.lights) {
    const Light& one = light_of(loaded, light);
    if (!one.region.empty()) {
      return fail(ErrorCode::kUsage, "--illuminate: light " + one.id + " shines in a region alone",
                  "lights without a region; --light chooses some");
    }
    if (!std::isfinite(one.intensity.nearest())) {
      return fail(ErrorCode::kUsage,
                  "--illuminate: the intensity of light " + one.id + " is beyond all doubles",
                  "a smaller one");
    }
  }
  shadows.output.exact_points = true;
  if (loaded.lights.size() > 1) {
    // Fragments that have one class by each light come of the pipeline alone.
    const auto choice = parse_algorithm_choice(
        algorithm, {{"--illuminate with several lights", true, &Method::combines_lights}});
    if (!choice) return tl::unexpected(choice.error());
    if (algorithm == kAutomaticName) shadows.method.point = MethodId::kAutomatic;
    shadows.output.combined = true;
  }
  return {};
}

Expected<ShadingMesh> classified_and_shaded(const IlluminateOptions& options,
                                            const LoadedScene& loaded, const std::string& algorithm,
                                            unsigned jobs) {
  ShadowOptions shadows;
  shadows.lights = loaded.lights;
  shadows.tuning.jobs = jobs;
  shadows.control.interrupted = &interrupted();
  if (auto done = ask_for_illumination(options, loaded, algorithm, shadows); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  const auto result = compute_shadows(loaded.prepared, shadows);
  if (!result) return tl::unexpected(result.error());
  return shaded(options, loaded, *result);
}

Expected<ShadingMesh> shaded(const IlluminateOptions& options, const LoadedScene& loaded,
                             const ShadowResult& result) {
  auto shading = shading_options(options, loaded);
  if (!shading) return tl::unexpected(std::move(shading.error()));
  std::vector<Illuminator> illuminators;
  for (const LightResult& light : result.lights) {
    illuminators.emplace_back(loaded.prepared, light.light,
                              light_of(loaded, light.light).intensity.nearest());
  }
  ProgressBar progress("illumination");
  shading->progress = progress.callback();
  shading->interrupted = &interrupted();
  return make_shading_mesh(
      loaded.prepared, result,
      [&](const ShadeRequest& asked) {
        const Illumination found = illuminators[asked.light].at(asked.part, asked.side, asked.point,
                                                                asked.unobstructed, asked.inwards);
        return PointShade{found.value, found.error_bound};
      },
      *shading);
}

namespace {

Expected<void> write_mesh(const IlluminateOptions& options, const LoadedScene& loaded,
                          const ShadingMesh& mesh) {
  const auto format = report::mesh_file_format(options.mesh);
  if (!format) return tl::unexpected(format.error());
  report::ShadedMeshOptions file_options;
  file_options.exposure = options.exposure;
  file_options.tint = options.tint;
  file_options.plain_ply = options.plain_ply;
  const auto text =
      report::shaded_mesh_text(loaded.scene, loaded.prepared, mesh, *format, file_options);
  if (!text) return tl::unexpected(text.error());
  return write_output(options.mesh, *text);
}

std::string shading_statistics(const LoadedScene& loaded, const ShadingMesh& mesh) {
  using report::grouped;
  using report::rounded;
  const ShadingStats& stats = mesh.stats;
  std::string text = "mesh: " + grouped(stats.fragments) + " fragments, " + grouped(stats.faces) +
                     " faces, " + grouped(stats.vertices) + " vertices; gridding " +
                     rounded(stats.grid_seconds, 3) + " s\n";
  for (const LightShadingStats& light : stats.lights) {
    const auto three = [](std::uint64_t lit, std::uint64_t penumbra, std::uint64_t umbra) {
      return grouped(lit) + " lit, " + grouped(penumbra) + " penumbra, " + grouped(umbra) +
             " umbra";
    };
    text += "light " + light_of(loaded, light.light).id + ": vertices " +
            three(light.lit, light.penumbra, light.umbra) + "; illuminated " +
            three(light.illuminated_lit, light.illuminated_penumbra, light.illuminated_umbra) +
            "; illumination " + rounded(light.seconds, 3) + " s, error at most " +
            rounded(light.largest_error, 3) + '\n';
  }
  return text;
}

}  // namespace

Expected<void> illuminate(const IlluminateOptions& options, const LoadedScene& loaded,
                          const ShadowResult& result) {
  if (!options.illuminate) return {};
  const auto mesh = shaded(options, loaded, result);
  if (!mesh) return tl::unexpected(mesh.error());
  if (!options.mesh.empty()) {
    if (auto done = write_mesh(options, loaded, *mesh); !done) return done;
  }
  if (options.stats) {
    const std::string text = shading_statistics(loaded, *mesh);
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
  return {};
}

}  // namespace gnomon::cli
