// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon lines: a drawing of the scene by its edges, with what hides each part of them (Appel
// 1967).
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

#include "cli/commands/lines_check.h"
#include "cli/common/camera_options.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/scene_options.h"
#include "gnomon/algorithms/facing_sides.h"
#include "gnomon/algorithms/hidden_lines.h"
#include "gnomon/scene/digest.h"
#include "report/lines/lines_json.h"
#include "report/lines/lines_picture.h"
#include "report/text/number_text.h"

namespace gnomon::cli {

namespace {

struct LinesOptions {
  SceneOptions scene;
  CameraOptions camera;
  bool hidden = false, check = false, stats = false;
  std::string output;
};

enum class LinesForm : std::uint8_t { kJson, kSvg };

Expected<LinesForm> lines_form(const LinesOptions& options) {
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension == ".svg") return LinesForm::kSvg;
  if (!options.output.empty() && options.output != "-" && extension != ".json") {
    return fail(ErrorCode::kUsage,
                "-o " + options.output + ": neither a drawing nor a file of lines",
                "a name that ends in .svg or .json");
  }
  if (options.hidden) {
    return fail(ErrorCode::kUsage, "--hidden is of drawings", "-o FILE.svg");
  }
  return LinesForm::kJson;
}

/// The lights whose shadows are drawn. Errors: kUsage for an area light that was asked for, and for
/// a light with a region.
Expected<std::vector<std::uint32_t>> lights_with_counts(const LinesOptions& options,
                                                        const LoadedScene& loaded) {
  std::vector<std::uint32_t> lights;
  for (const std::uint32_t light : loaded.lights) {
    const PreparedLight& prepared = loaded.prepared.lights[light];
    const std::string& id = loaded.scene.lights[light].id;
    if (prepared.has_area()) {
      if (options.scene.lights.empty()) {
        warn("light " + id + " has an area, and dashes nothing");
        continue;
      }
      return fail(ErrorCode::kUsage, "light " + id + " has an area",
                  "point and directional lights");
    }
    if (!prepared.region.empty()) {
      return fail(ErrorCode::kUsage, "light " + id + " shines in a region alone",
                  "lights that shine everywhere");
    }
    lights.push_back(light);
  }
  return lights;
}

/// The scene on a grid that holds the eye, which is its last light.
Expected<PreparedScene> prepared_with_eye(Scene scene, const Position& position) {
  Light eye;
  eye.id = kEyeId;
  eye.position = position;
  eye.is_eye = true;
  scene.lights.push_back(std::move(eye));
  return prepare(scene);
}

std::string work_text(const std::string& name, const HiddenLines& lines) {
  return name + ": " + report::grouped(lines.facing_polygons) + " polygons face, " +
         report::grouped(lines.contour_edges) + " contour edges, " +
         report::grouped(lines.contour_tests) + " tests of contour edges, " +
         report::grouped(lines.polygon_tests) + " of polygons, " +
         report::grouped(lines.breakpoints) + " breakpoints, " + report::grouped(lines.counted) +
         " starts counted, " + report::grouped(lines.handed_on) + " handed on\n";
}

class LinesRun {
 public:
  LinesRun(const LinesOptions& options, const LoadedScene& loaded, const PreparedScene& prepared)
      : options_(options), loaded_(loaded), prepared_(prepared) {}

  Expected<void> find(const ExactCamera& camera, const std::vector<std::uint32_t>& lights) {
    drawn_.camera = camera;
    drawn_.geometry = geometry_digest(loaded_.scene);
    const PreparedLight& eye = prepared_.lights.back();
    drawn_.edges = outline_edges(prepared_, facing_sides(prepared_, eye.point));
    for (const OutlineEdge& edge : drawn_.edges) edges_.push_back(edge.edge);
    auto seen = count("eye", eye);
    if (!seen) return tl::unexpected(std::move(seen.error()));
    drawn_.seen = *std::move(seen);
    for (const std::uint32_t light : lights) {
      auto lines = count("light " + loaded_.scene.lights[light].id, prepared_.lights[light]);
      if (!lines) return tl::unexpected(std::move(lines.error()));
      drawn_.shadowed.push_back({light, *std::move(lines)});
    }
    return {};
  }

  Expected<void> write(LinesForm form) const {
    auto output = Output::open(options_.output);
    if (!output) return tl::unexpected(std::move(output.error()));
    if (form == LinesForm::kSvg) {
      report::lines_picture(prepared_, drawn_, options_.hidden,
                            loaded_.scene.name + ", hidden lines")
          .write(*output);
    } else {
      auto done = report::write_lines_json(*output, loaded_.scene, prepared_, drawn_);
      if (!done) return done;
    }
    return output->finish();
  }

  const std::string& statistics() const { return statistics_; }
  bool disagrees() const { return disagrees_; }

 private:
  Expected<HiddenLines> count(const std::string& name, const PreparedLight& from) {
    Stopwatch stopwatch;
    HiddenLineOptions options;
    options.interrupted = &interrupted();
    auto lines = hidden_lines(prepared_, from, edges_, options);
    if (!lines) return lines;
    statistics_ += work_text(name, *lines);
    statistics_ += "  CPU seconds: " + report::rounded(stopwatch.lap().cpu, 3) + '\n';
    if (!options_.check) return lines;
    const auto verdict = check_lines(prepared_, from, *lines);
    if (!verdict) return tl::unexpected(verdict.error());
    say(name + ": " + verdict_text(*verdict));
    disagrees_ = disagrees_ || verdict->wrong > 0;
    return lines;
  }

  const LinesOptions& options_;
  const LoadedScene& loaded_;
  const PreparedScene& prepared_;
  report::DrawnLines drawn_;
  std::vector<EdgeId> edges_;
  std::string statistics_;
  bool disagrees_ = false;
};

Expected<ExitStatus> draw(const LinesOptions& options) {
  const auto form = lines_form(options);
  if (!form) return tl::unexpected(form.error());
  const ThreadLimit threads(options.scene.jobs);
  const auto loaded = load_scene(options.scene, false);
  if (!loaded) return tl::unexpected(loaded.error());
  const auto lights = lights_with_counts(options, *loaded);
  if (!lights) return tl::unexpected(lights.error());
  const auto camera = camera_of(options.camera, *loaded);
  if (!camera) return tl::unexpected(camera.error());
  const auto prepared = prepared_with_eye(loaded->scene, camera->eye);
  if (!prepared) return tl::unexpected(prepared.error());
  LinesRun run(options, *loaded, *prepared);
  if (auto done = run.find(*camera, *lights); !done) return tl::unexpected(done.error());
  if (options.stats) {
    const std::string text =
        "camera: " + camera_text(*camera, loaded->scene) + '\n' + run.statistics();
    std::fwrite(text.data(), 1, text.size(), stderr);
  }
  if (auto done = run.write(*form); !done) return tl::unexpected(done.error());
  return run.disagrees() ? kDisagree : kDone;
}

}  // namespace

void add_lines_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<LinesOptions>();
  options->camera.width = 960;
  options->camera.height = 720;
  CLI::App& command = *app.add_subcommand(
      "lines", "Hidden lines: by how many polygons each part of an edge is hidden");
  command.footer(
      "A drawing has what the eye sees solid, and dashed where it is in shadow of a point or\n"
      "directional light. The file gnomon-lines has every edge of the polygons that face the eye\n"
      "in parts with exact ends.\n\n"
      "Examples:\n"
      "  gnomon lines room.json --eye 9,-7,6 -o room.svg\n"
      "  gnomon lines room.json --eye 9,-7,6 --check -o room.lines.json");
  add_scene_options(command, options->scene);
  const std::vector<CLI::Option*> raster = add_camera_options(command, options->camera);
  raster[raster.size() - 2]->description("Width of the drawing in pixels");
  raster.back()->description("Height of the drawing in pixels");
  command.add_flag("--hidden", options->hidden, "Draw hidden parts, too, as thin lines");
  command.add_flag("--check", options->check,
                   "Hold all parts against the oracle, and say the verdict on standard error");
  command.add_flag("--stats", options->stats, "Print counts and times to standard error");
  command
      .add_option("-o,--output", options->output,
                  "A drawing (.svg) or the lines (.json); JSON on standard output if absent")
      ->type_name("FILE");
  command.callback([options, &action] {
    action = [options]() -> int {
      const auto done = draw(*options);
      return done ? *done : report_error(done.error());
    };
  });
}

}  // namespace gnomon::cli
