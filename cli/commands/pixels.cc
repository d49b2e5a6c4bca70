// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon pixels: exact samples of a picture, as a file gnomon-pixels or a PNG.
#include "gnomon/algorithms/pixels.h"

#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/common/algorithm_choice.h"
#include "cli/common/camera_options.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/pixel_method.h"
#include "cli/common/progress.h"
#include "cli/common/scene_options.h"
#include "gnomon/kernel/kernel_choice.h"
#include "gnomon/scene/digest.h"
#include "report/pixels/pixel_claims_of.h"
#include "report/pixels/pixels_json.h"
#include "report/pixels/png_picture.h"
#include "report/text/count_text.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::cli {

namespace {

struct PixelsOptions {
  SceneOptions scene;
  CameraOptions camera;
  std::string kernel{kernel_info(kDefaultExactKernel).name};
  std::string algorithm{"zbuffer"};
  bool stats = false;
  std::string output;
};

enum class Form : std::uint8_t { kJson, kPng };

Expected<Form> form_of(const std::string& output) {
  const std::string extension = std::filesystem::path(output).extension().string();
  if (extension == ".png") return Form::kPng;
  if (output.empty() || output == "-" || extension == ".json") return Form::kJson;
  return fail(ErrorCode::kUsage, "-o " + output + ": neither a picture nor a file of samples",
              "a name that ends in .png or .json");
}

std::string statistics(const Pixels& pixels, const Method& method) {
  const double samples = static_cast<double>(pixels.part.size());
  std::string text = "kernel " + pixels.kernel + ", algorithm " + pixels.algorithm + '\n';
  const std::string work = report::work_text(method.counters, pixels.work);
  if (!work.empty()) {
    text += report::wrapped("work: " + work, report::TextTable::kWidth, 2, 4);
  }
  if (pixels.stages.total() > 0) {
    text += "decisions: " + report::grouped(pixels.stages.total()) + ", exact stage " +
            report::percent(static_cast<double>(pixels.stages.exact()) /
                            static_cast<double>(pixels.stages.total())) +
            ", exactly zero " + report::grouped(pixels.stages.exactly_zero) + '\n';
  }
  text += "CPU seconds: " + report::rounded(pixels.seconds, 3);
  if (pixels.seconds > 0) {
    text += ", " + report::rounded(samples / pixels.seconds, 3) + " samples a second";
  }
  text += '\n';
  if (pixels.table_seconds > 0) {
    text += "of these the table: " + report::rounded(pixels.table_seconds, 3) +
            ", look-ups: " + report::rounded(pixels.lookup_seconds, 3);
    const std::uint64_t look_ups = pixels.work[Counter::kLookUps];
    if (look_ups > 0) {
      text += ", " +
              report::rounded(1e6 * pixels.lookup_seconds / static_cast<double>(look_ups), 3) +
              " microseconds each";
    }
    text += '\n';
  }
  return text;
}

Expected<void> write(const PixelsOptions& options, Form form, const LoadedScene& loaded,
                     const PixelClaims& claims) {
  if (form == Form::kPng) {
    const auto picture = report::png_picture(loaded.prepared, claims);
    if (!picture) return tl::unexpected(picture.error());
    return write_output(options.output, *picture);
  }
  auto output = Output::open(options.output);
  if (!output) return tl::unexpected(std::move(output.error()));
  if (auto done = report::write_pixels_json(*output, loaded.scene, claims); !done) return done;
  return output->finish();
}

Expected<void> sample(const PixelsOptions& options) {
  const auto form = form_of(options.output);
  if (!form) return tl::unexpected(form.error());
  const auto kernel = parse_kernel_choice(options.kernel);
  if (!kernel) return tl::unexpected(kernel.error());
  const auto method = parse_pixel_method(options.algorithm);
  if (!method) return tl::unexpected(method.error());
  const ThreadLimit threads(options.scene.jobs);
  const auto loaded = load_scene(options.scene, false);
  if (!loaded) return tl::unexpected(loaded.error());
  const auto camera = camera_of(options.camera, *loaded);
  if (!camera) return tl::unexpected(camera.error());
  const auto view = prepare_view(loaded->scene, *camera);
  if (!view) return tl::unexpected(view.error());
  PixelOptions pixel_options;
  pixel_options.kernel.id = kernel->kernel;
  pixel_options.kernel.identity = kernel->identity;
  if (kernel->thin) pixel_options.kernel.thickness = 0;
  pixel_options.method = method->id;
  pixel_options.options = method->values;
  pixel_options.lights = loaded->lights;
  pixel_options.scene = &loaded->scene;
  pixel_options.stage_counts = options.stats;
  pixel_options.jobs = options.scene.jobs;
  pixel_options.control.interrupted = &interrupted();
  ProgressBar progress("samples");
  pixel_options.control.progress = progress.callback();
  const auto pixels = compute_pixels(view->scene, view->frame, pixel_options);
  progress.clear();
  if (!pixels) return tl::unexpected(pixels.error());
  PixelClaims claims = report::pixel_claims_of(*pixels, view->scene, *camera);
  claims.geometry = geometry_digest(loaded->scene);
  const std::string text = "camera: " + camera_text(*camera, loaded->scene) + '\n' +
                           (options.stats ? statistics(*pixels, method_info(method->id)) : "");
  std::fwrite(text.data(), 1, text.size(), stderr);
  return write(options, *form, *loaded, claims);
}

}  // namespace

void add_pixels_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<PixelsOptions>();
  CLI::App& command = *app.add_subcommand(
      "pixels", "Exact samples of a picture: what is seen, and which lights reach it");
  command.footer(
      "The camera as it is exactly, in integers, goes to standard error and into the file.\n"
      "gnomon certify SCENE --pixels FILE judges such a file, ours or another program's.\n\n"
      "Examples:\n"
      "  gnomon pixels room.json --eye 9,-7,6 --look-at 2,2,1 -o room.png\n"
      "  gnomon pixels room.json --algorithm svbsp --kernel double -o room.pixels.json");
  add_scene_options(command, options->scene);
  add_camera_options(command, options->camera);
  add_kernel_option(command, options->kernel);
  add_pixel_algorithm_option(command, options->algorithm);
  command.add_flag("--stats", options->stats,
                   "Print counts, times and, for plane, who decided, to standard error");
  command
      .add_option("-o,--output", options->output,
                  "A picture (.png) or the samples (.json); JSON on standard output if absent")
      ->type_name("FILE");
  command.callback([options, &action] {
    action = [options] {
      const auto done = sample(*options);
      return done ? kDone : report_error(done.error());
    };
  });
}

}  // namespace gnomon::cli
