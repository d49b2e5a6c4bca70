// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon render: a picture of the classified scene, painted back to front by the scene BSP.
#include <array>
#include <charconv>
#include <cmath>
#include <memory>

#include "algorithm_choice.h"
#include "certify_report.h"
#include "commands.h"
#include "gnomon/algorithms/painters_order.h"
#include "gnomon/oracle/read_candidate.h"
#include "gnomon/report/picture.h"
#include "jobs.h"
#include "messages.h"
#include "output.h"
#include "scene_options.h"

namespace gnomon::cli {

namespace {

struct RenderOptions {
  SceneOptions scene;
  std::string result;
  std::string candidate;
  std::string algorithm{kAutomaticName};
  std::string eye, look_at, up;
  double field_of_view = 0;
  unsigned width = 960, height = 720;
  bool backs = false, no_legend = false;
  std::string output;
};

Expected<report::Point> parse_point(const std::string& option, const std::string& text) {
  report::Point point{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (int k = 0; k < 3; ++k) {
    const auto [stop, failure] = std::from_chars(at, end, point[k]);
    const bool comma = k < 2 ? stop != end && *stop == ',' : stop == end;
    if (failure != std::errc() || !comma || !std::isfinite(point[k])) {
      return fail(ErrorCode::kUsage, option + " '" + text + "' is no point", "x,y,z");
    }
    at = stop + 1;
  }
  return point;
}

Expected<report::Camera> camera_of(const RenderOptions& options, const PreparedScene& prepared) {
  report::Camera camera = report::default_camera(prepared);
  camera.field_of_view = options.field_of_view;
  for (const auto& [option, text, target] :
       {std::tuple("--eye", &options.eye, &camera.eye),
        std::tuple("--look-at", &options.look_at, &camera.look_at),
        std::tuple("--up", &options.up, &camera.up)}) {
    if (text->empty()) continue;
    const auto point = parse_point(option, *text);
    if (!point) return tl::unexpected(point.error());
    *target = *point;
  }
  if (!options.look_at.empty()) camera.centre_scene = false;
  if (camera.eye == camera.look_at) {
    return fail(ErrorCode::kUsage, "--eye and --look-at are the same point",
                "two different points");
  }
  return camera;
}

const oracle::CandidateLight* find_light(const oracle::Candidate& candidate,
                                         const std::string& id) {
  for (const oracle::CandidateLight& light : candidate.lights) {
    if (light.id == id) return &light;
  }
  return nullptr;
}

tl::unexpected<Error> missing_light(const std::string& file, const std::string& id) {
  ErrorPlace where;
  where.file = file;
  return fail(ErrorCode::kUsage, "holds nothing for light " + id,
              "a result of this light; --light chooses another", where);
}

Expected<void> render(const RenderOptions& options) {
  const auto algorithm = parse_algorithm_choice(options.algorithm);
  if (!algorithm) return tl::unexpected(algorithm.error());
  const ThreadLimit threads(options.scene.jobs);
  auto loaded = load_scene(options.scene, true);
  if (!loaded) return tl::unexpected(loaded.error());
  const auto camera = camera_of(options, loaded->prepared);
  if (!camera) return tl::unexpected(camera.error());
  const std::uint32_t light = loaded->lights.front();
  const std::string& id = loaded->scene.lights[light].id;
  loaded->lights = {light};

  report::PictureOptions picture;
  picture.camera = *camera;
  picture.width = options.width;
  picture.height = options.height;
  picture.backs = options.backs;
  picture.legend = !options.no_legend;
  picture.title = loaded->scene.name + ", light " + id;

  // What is shown: a result if one is named, else the exact answer; marked is what a candidate has
  // otherwise.
  std::optional<oracle::Candidate> exact, result, candidate;
  report::Panel panel;
  if (!options.result.empty()) {
    auto read = oracle::read_candidate(options.result, loaded->scene);
    if (!read) return tl::unexpected(read.error());
    result = std::move(*read);
    panel.shown = find_light(*result, id);
    if (panel.shown == nullptr) return missing_light(options.result, id);
  } else {
    auto computed = exact_fragments(*loaded, *algorithm);
    if (!computed) return tl::unexpected(computed.error());
    exact = std::move(*computed);
    panel.shown = find_light(*exact, id);
  }
  if (!options.candidate.empty()) {
    auto read = oracle::read_candidate(options.candidate, loaded->scene);
    if (!read) return tl::unexpected(read.error());
    candidate = std::move(*read);
    panel.truth = panel.shown;
    panel.shown = find_light(*candidate, id);
    if (panel.shown == nullptr) return missing_light(options.candidate, id);
  }
  const std::vector<OrderedPiece> pieces = back_to_front(loaded->prepared, camera->eye);
  auto output = Output::open(options.output);
  if (!output) return tl::unexpected(output.error());
  report::paint_scene(loaded->scene, loaded->prepared, light, pieces, {panel}, picture)
      .write(*output);
  return output->finish();
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command = *app.add_subcommand("render", "Paint the classified scene as an SVG picture");
  command.footer(
      "Without RESULT the exact answer is shown. With --candidate the candidate is shown, and "
      "where it\n"
      "differs is marked.\n\n"
      "Example:\n"
      "  gnomon render room.json --eye 9,-7,6 --look-at 2,2,1 --light bulb -o room.svg");
  add_scene_options(command, options->scene);
  command.add_option("RESULT", options->result, "A result to show, with fragments")
      ->type_name("FILE");
  add_algorithm_option(command, options->algorithm);
  command.add_option("--eye", options->eye, "Where the eye is [above a corner of the scene]")
      ->type_name("x,y,z");
  command.add_option("--look-at", options->look_at, "What it looks at [the middle of the scene]")
      ->type_name("x,y,z");
  command.add_option("--up", options->up, "What is up [0,0,1]")->type_name("x,y,z");
  command
      .add_option("--fov", options->field_of_view,
                  "Field of view across the larger side, degrees [shows all of the scene]")
      ->check(CLI::Range(1.0, 170.0))
      ->type_name("F");
  command.add_option("--width", options->width, "Width of the picture in pixels")
      ->check(CLI::Range(16u, 20000u))
      ->capture_default_str()
      ->type_name("N");
  command.add_option("--height", options->height, "Height of the picture in pixels")
      ->check(CLI::Range(16u, 20000u))
      ->capture_default_str()
      ->type_name("N");
  command.add_option("--candidate", options->candidate, "A result whose differences are marked")
      ->type_name("FILE");
  command.add_flag("--backs", options->backs, "Paint the backs of one-sided polygons too");
  command.add_flag("--no-legend", options->no_legend, "Leave out the legend");
  command.add_option("-o,--output", options->output, "SVG file; standard output if absent")
      ->type_name("FILE");
  command.callback([options, &action] {
    action = [options] {
      const auto done = render(*options);
      return done ? kDone : report_error(done.error());
    };
  });
}

}  // namespace gnomon::cli
