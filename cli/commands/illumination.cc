// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon illumination: what points of a polygon see and receive of an area light, truly and by each
// kernel.
#include <algorithm>
#include <memory>
#include <optional>

#include "cli/common/algorithm_choice.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/kernel_choices.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "cli/common/receiver_argument.h"
#include "cli/common/scene_options.h"
#include "comparison/received_light/received_light.h"
#include "gnomon/scene/light_arguments.h"

namespace gnomon::cli {

namespace {

using comparison::FoundLight;
using comparison::KernelReceipt;
using comparison::PointSight;
using comparison::ReceivedLight;
using comparison::ReceivedLightReport;

struct IlluminationOptions {
  SceneOptions scene;
  std::vector<std::string> kernels;
  std::string algorithm{kAutomaticName};
  std::string on;
  std::vector<std::string> at;
  std::size_t samples = 0;
  std::uint64_t seed = 1;
  double tolerance = 1e-9;
  std::string json;
};

constexpr std::size_t kDefaultSamples = 64;

Expected<comparison::LitSide> lit_side(const IlluminationOptions& options,
                                       const LoadedScene& loaded) {
  comparison::LitSide side;
  std::size_t area_lights = 0;
  for (const std::uint32_t light : loaded.lights) {
    if (!loaded.scene.lights[light].has_area()) continue;
    ++area_lights;
    side.light = light;
  }
  if (area_lights != 1) {
    return fail(ErrorCode::kUsage, std::to_string(area_lights) + " area lights",
                area_lights == 0 ? "one; --area gives one" : "one; --light chooses it");
  }
  const ReceiverArgument on = parse_receiver(options.on, loaded.scene);
  const auto polygon = std::ranges::find(loaded.scene.polygons, on.polygon, &Polygon::id);
  if (polygon == loaded.scene.polygons.end()) {
    return fail(ErrorCode::kUsage, "--on: there is no polygon '" + on.polygon + "'",
                "the id of a polygon");
  }
  side.polygon = static_cast<std::uint32_t>(polygon - loaded.scene.polygons.begin());
  side.side = on.side;
  if (side.side == Side::kBack && !loaded.scene.is_two_sided(*polygon)) {
    return fail(ErrorCode::kUsage, "--on: polygon '" + on.polygon + "' has one side",
                "its front, or a polygon of two sides");
  }
  if (loaded.prepared.first_part[side.polygon] == loaded.prepared.first_part[side.polygon + 1]) {
    return fail(ErrorCode::kUsage, "--on: polygon '" + on.polygon + "' has no area",
                "a polygon that was not dropped");
  }
  return side;
}

Expected<std::vector<Position>> points_of(const IlluminationOptions& options,
                                          const LoadedScene& loaded, const ReceivedLight& light) {
  std::vector<Position> points;
  for (const std::string& text : options.at) {
    auto point = parse_position(text, loaded.scene.numbers, "--at");
    if (!point) return tl::unexpected(std::move(point.error()));
    points.push_back(*std::move(point));
  }
  const std::size_t count =
      options.samples == 0 && points.empty() ? kDefaultSamples : options.samples;
  for (Position& point : light.spread_points(count, options.seed)) {
    points.push_back(std::move(point));
  }
  return points;
}

class IlluminationRun {
 public:
  IlluminationRun(const IlluminationOptions& options, const LoadedScene& loaded,
                  const ReceivedLight& light, const AlgorithmChoice& algorithm)
      : options_(options), light_(light), algorithm_(algorithm), progress_("illumination") {
    report_.scene = &loaded.scene;
    report_.receiver = light.receiver();
    report_.tolerance = options.tolerance;
    report_.list_points = !options.at.empty();
  }

  /// An interruption is no error once a point was judged. Errors: those of points.
  Expected<void> run(const std::vector<Position>& points, const std::vector<KernelChoice>& kernels);
  const ReceivedLightReport& report() const { return report_; }
  int status() const;

 private:
  void run_kernel(const KernelChoice& kernel, const PointSight& point, const PreparedScene& scene,
                  KernelReceipt& receipt) const;
  Expected<void> run_point(const Position& position, const std::vector<KernelChoice>& kernels);

  const IlluminationOptions& options_;
  const ReceivedLight& light_;
  const AlgorithmChoice& algorithm_;
  ProgressBar progress_;
  ReceivedLightReport report_;
};

void IlluminationRun::run_kernel(const KernelChoice& kernel, const PointSight& point,
                                 const PreparedScene& scene, KernelReceipt& receipt) const {
  if (!receipt.error.empty()) return;
  ShadowOptions shadows;
  algorithm_.apply(shadows.method);
  shadows.tuning.jobs = 1;
  shadows.kernel.id = kernel.kernel;
  shadows.kernel.identity = kernel.identity;
  if (kernel.thin) shadows.kernel.thickness = 0;
  const Expected<FoundLight> found = light_.found(point, scene, shadows);
  if (found) {
    comparison::add_to(receipt, report_.points.size(), point, *found);
  } else {
    receipt.error = to_string(found.error());
  }
}

Expected<void> IlluminationRun::run_point(const Position& position,
                                          const std::vector<KernelChoice>& kernels) {
  auto point = light_.at(position);
  if (!point) return tl::unexpected(std::move(point.error()));
  const auto scene = light_.scene_of(*point);
  if (!scene) return tl::unexpected(scene.error());
  for (std::size_t k = 0; k < kernels.size(); ++k) {
    run_kernel(kernels[k], *point, *scene, report_.kernels[k]);
  }
  report_.points.push_back(*std::move(point));
  return {};
}

Expected<void> IlluminationRun::run(const std::vector<Position>& points,
                                    const std::vector<KernelChoice>& kernels) {
  for (const KernelChoice& kernel : kernels) {
    KernelReceipt receipt;
    receipt.kernel = kernel.name();
    receipt.algorithm = method_info(algorithm_.point).name;
    receipt.exact = kernel.exact();
    receipt.counts = !options_.kernels.empty() || kernel.kernel != KernelId::kFloat;
    report_.kernels.push_back(std::move(receipt));
  }
  for (const Position& position : points) {
    if (interrupted()) {
      report_.interrupted = true;
      if (report_.points.empty()) return fail(ErrorCode::kInterrupted, "interrupted");
      break;
    }
    if (auto done = run_point(position, kernels); !done) return done;
    progress_.show(static_cast<double>(report_.points.size()) / static_cast<double>(points.size()));
  }
  progress_.clear();
  return {};
}

int IlluminationRun::status() const {
  if (report_.interrupted) return kInterruptedStatus;
  const auto& kernels = report_.kernels;
  // The integral of an exact kernel is in doubles too: its shares alone must be exact.
  if (std::ranges::any_of(kernels, &KernelReceipt::differs)) return kDisagree;
  const bool failed = std::ranges::any_of(kernels, [&](const KernelReceipt& kernel) {
    return kernel.counts && kernel.failed(options_.tolerance);
  });
  return failed ? kFailed : kDone;
}

Expected<AlgorithmChoice> chosen_algorithm(const IlluminationOptions& options) {
  auto algorithm =
      parse_algorithm_choice(options.algorithm, {{"fragments", true, &Method::makes_fragments}});
  if (!algorithm) return algorithm;
  if (algorithm->paints()) {
    return fail(ErrorCode::kUsage, "--algorithm " + options.algorithm + " paints shadows over lit",
                "cover=partition: what is seen is summed fragment by fragment");
  }
  return algorithm;
}

Expected<int> run_illumination(const IlluminationOptions& options) {
  const auto algorithm = chosen_algorithm(options);
  if (!algorithm) return tl::unexpected(algorithm.error());
  const ThreadLimit threads(options.scene.jobs);
  const auto loaded = load_scene(options.scene, true);
  if (!loaded) return tl::unexpected(loaded.error());
  warn_of_intent(*loaded);
  const auto side = lit_side(options, *loaded);
  if (!side) return tl::unexpected(side.error());
  const auto kernels = chosen_kernels(options.kernels, loaded->prepared.parts.size());
  if (!kernels) return tl::unexpected(kernels.error());
  const auto light = ReceivedLight::make(loaded->scene, loaded->prepared, *side);
  if (!light) return tl::unexpected(light.error());
  const auto points = points_of(options, *loaded, *light);
  if (!points) return tl::unexpected(points.error());

  IlluminationRun run(options, *loaded, *light, *algorithm);
  if (auto done = run.run(*points, *kernels); !done) return tl::unexpected(std::move(done.error()));
  if (options.json != "-") {
    if (auto done = write_output({}, comparison::received_light_text(run.report())); !done) {
      return tl::unexpected(std::move(done.error()));
    }
  }
  if (!options.json.empty()) {
    if (auto done = write_output(options.json, comparison::received_light_json(run.report()));
        !done) {
      return tl::unexpected(std::move(done.error()));
    }
  }
  return run.status();
}

}  // namespace

void add_illumination_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<IlluminationOptions>();
  CLI::App& command = *app.add_subcommand(
      "illumination", "What points see and receive of an area light, truly and by each kernel");
  command.footer(
      "The light becomes the receiver and each point its lamp; what is lit of the light is what\n"
      "the point sees, and the contour integral over it is what it receives. Shares are judged\n"
      "against the exact ones, and what is received against a value with a proven bound.\n\n"
      "Examples:\n"
      "  gnomon illumination room.json --on floor\n"
      "  gnomon illumination room.json --on floor --at 1,2,0 --at 3,1,0 --kernel double\n"
      "  gnomon illumination room.json --on shelf:back --light panel --samples 1000 --kernel all");
  add_scene_options(command, options->scene);
  command
      .add_option("--on", options->on,
                  "The polygon that receives: what is before its front or, with :back, behind it")
      ->required()
      ->type_name("ID[:back]");
  repeatable(command.add_option("--at", options->at, "A point of its plane (repeatable)"))
      ->type_name("X,Y,Z");
  command
      .add_option("--samples", options->samples,
                  "Points spread over the polygon [64 where none is named by --at]")
      ->type_name("N");
  command.add_option("--seed", options->seed, "Which points those are")
      ->type_name("S")
      ->default_str("1");
  add_kernels_option(command, options->kernels);
  add_algorithm_option(command, options->algorithm, "How the visible part of the light is found.");
  command
      .add_option("--tolerance", options->tolerance,
                  "Error that is tolerated: of the light's area, and of what is received without\n"
                  "casters")
      ->check(not_negative())
      ->type_name("F")
      ->default_str("1e-9");
  command.add_option("--json", options->json, "Write all as JSON; - is standard output")
      ->type_name("FILE");
  command.callback([options, &action] {
    action = [options] {
      const auto status = run_illumination(*options);
      return status ? *status : static_cast<int>(report_error(status.error()));
    };
  });
}

}  // namespace gnomon::cli
