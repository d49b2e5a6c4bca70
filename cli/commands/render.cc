// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon render: a picture of the classified scene, painted back to front by the scene BSP.
#include <array>
#include <charconv>
#include <cmath>
#include <deque>
#include <memory>

#include "cli/commands/certify_report.h"
#include "cli/commands/illuminate.h"
#include "cli/commands/render_lights.h"
#include "cli/common/algorithm_choice.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/scene_options.h"
#include "gnomon/algorithms/painters_order.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/result/read_claims.h"
#include "report/pictures/combined_picture.h"
#include "report/pictures/picture.h"
#include "report/pictures/shaded_picture.h"
#include "report/text/number_text.h"

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
  bool fragments = false, backs = false, no_legend = false, visible = false;
  bool combined = false, walls = false;
  IlluminateOptions illuminate;
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

const ClaimedLight* find_light(const Claims& candidate, const std::string& id) {
  for (const ClaimedLight& light : candidate.lights) {
    if (light.id == id) return &light;
  }
  return nullptr;
}

/// What is in shadow as a whole for a reason is none.
std::size_t fragment_count(const ClaimedLight& light) {
  std::size_t count = 0;
  for (const ClaimedPolygon& polygon : light.polygons) {
    for (const ClaimedFragment& fragment : polygon.fragments) {
      if (fragment.reason.empty()) ++count;
    }
  }
  return count;
}

tl::unexpected<Error> missing_light(const std::string& file, const std::string& id) {
  ErrorPlace where;
  where.file = file;
  return fail(ErrorCode::kUsage, "holds nothing for light " + id,
              "a result of this light; --light chooses another", where);
}

/// Pictures show fragments.
constexpr NeedyOption kRender{"render", true, &Method::makes_fragments};

Expected<std::vector<AlgorithmChoice>> chosen_algorithms(const RenderOptions& options) {
  if (auto several = several_algorithms(options.algorithm, {kRender}); !several.empty()) {
    if (!options.result.empty() || !options.candidate.empty()) {
      return fail(ErrorCode::kUsage, "--algorithm " + options.algorithm + " shows exact answers",
                  "no RESULT and no --candidate");
    }
    return several;
  }
  const NeedyOption combined{"--combined", options.combined, &Method::combines_lights};
  const auto algorithm =
      parse_algorithm_choice(options.algorithm, {kRender, combined}, "both, all");
  if (!algorithm) return tl::unexpected(algorithm.error());
  return std::vector{*algorithm};
}

/// The scene by all lights asked for, as their illumination has it.
Expected<void> render_illuminated(const RenderOptions& options, const LoadedScene& loaded,
                                  const report::Camera& camera) {
  if (!options.result.empty() || !options.candidate.empty() ||
      !several_algorithms(options.algorithm).empty()) {
    return fail(ErrorCode::kUsage, "--illuminate shows the exact answer",
                "no RESULT, no --candidate, one algorithm");
  }
  const auto mesh =
      classified_and_shaded(options.illuminate, loaded, options.algorithm, options.scene.jobs);
  if (!mesh) return tl::unexpected(mesh.error());
  report::ShadedPictureOptions picture;
  picture.picture.camera = camera;
  picture.picture.width = options.width;
  picture.picture.height = options.height;
  picture.picture.backs = options.backs;
  picture.picture.fragments = options.fragments;
  picture.picture.legend = !options.no_legend;
  picture.picture.title = loaded.scene.name + ", illuminated";
  picture.shade.exposure = options.illuminate.exposure;
  picture.shade.tint = options.illuminate.tint;
  auto output = Output::open(options.output);
  if (!output) return tl::unexpected(output.error());
  report::paint_shaded_scene(loaded.scene, loaded.prepared,
                             back_to_front(loaded.prepared, camera.eye), *mesh, picture)
      .write(*output);
  return output->finish();
}

/// What --combined and --walls do not go with.
Expected<void> check_lights(const RenderOptions& options) {
  const auto refuse = [&](const char* chosen,
                          std::initializer_list<std::pair<const char*, bool>> others) {
    for (const auto& [option, given] : others) {
      if (given) return std::string(option) + " is not of " + chosen;
    }
    return std::string();
  };
  const bool several = !several_algorithms(options.algorithm).empty();
  std::string problem;
  if (options.combined) {
    problem = refuse("--combined", {{"--candidate", !options.candidate.empty()},
                                    {"--illuminate", options.illuminate.illuminate},
                                    {"--walls", options.walls},
                                    {"--algorithm of several methods", several}});
  } else if (options.walls) {
    problem = refuse("--walls", {{"--illuminate", options.illuminate.illuminate}});
  }
  if (problem.empty()) return {};
  return fail(ErrorCode::kUsage, problem);
}

/// The scene by how many of the lights reach it.
Expected<void> render_combined(const RenderOptions& options, const LoadedScene& loaded,
                               const AlgorithmChoice& algorithm,
                               const std::vector<OrderedPiece>& pieces,
                               report::PictureOptions picture) {
  const auto claims = lights_together(loaded, options.result, algorithm);
  if (!claims) return tl::unexpected(claims.error());
  picture.title = loaded.scene.name + ", lights together";
  auto output = Output::open(options.output);
  if (!output) return tl::unexpected(output.error());
  report::paint_combined_scene(loaded.scene, loaded.prepared, pieces, *claims, loaded.lights,
                               picture)
      .write(*output);
  return output->finish();
}

/// What --visible needs, and what it does not go with.
Expected<void> check_visible(const RenderOptions& options) {
  if (!options.visible) return {};
  if (options.eye.empty()) {
    return fail(ErrorCode::kUsage, "--visible without an eye that sees", "--eye x,y,z");
  }
  for (const auto& [option, given] : {std::pair("--backs", options.backs),
                                      std::pair("--illuminate", options.illuminate.illuminate)}) {
    if (given) return fail(ErrorCode::kUsage, std::string(option) + " is not of --visible");
  }
  return {};
}

/// What the eye sees, in no order: nothing of it hides anything else. The eye is the last light,
/// and is none any more.
Expected<std::vector<OrderedPiece>> visible_pieces(LoadedScene& loaded,
                                                   const AlgorithmChoice& algorithm) {
  ShadowOptions options;
  algorithm.apply(options.method);
  options.lights = {loaded.lights.back()};
  options.output.points = true;
  options.control.interrupted = &interrupted();
  const auto result = compute_shadows(loaded.prepared, options);
  if (!result) return tl::unexpected(result.error());
  loaded.lights.pop_back();
  const LightResult& eye = result->lights.front();
  std::vector<OrderedPiece> pieces;
  for (const PartResult& part : eye.parts) {
    for (std::uint32_t f = 0; f < part.fragment_count; ++f) {
      const Fragment& fragment = eye.fragments[part.first_fragment + f];
      if (fragment.state != LightState::kLit) continue;
      const auto first = eye.points.begin() + fragment.first;
      pieces.push_back({part.part, {first, first + fragment.count}});
    }
  }
  return pieces;
}

Expected<void> render(const RenderOptions& options) {
  auto algorithms = chosen_algorithms(options);
  if (!algorithms) return tl::unexpected(algorithms.error());
  if (auto checked = check_visible(options); !checked) return checked;
  if (auto checked = check_lights(options); !checked) return checked;
  const ThreadLimit threads(options.scene.jobs);
  SceneOptions scene = options.scene;
  if (options.visible) scene.eye = options.eye;
  auto loaded = load_scene(scene, true);
  if (!loaded) return tl::unexpected(loaded.error());
  std::vector<OrderedPiece> visible;
  if (options.visible) {
    auto pieces = visible_pieces(*loaded, algorithms->front());
    if (!pieces) return tl::unexpected(pieces.error());
    visible = *std::move(pieces);
    if (loaded->lights.empty()) {
      return fail(ErrorCode::kUsage, loaded->scene.file + ": there is no light to show",
                  "one in the scene, or --point=x,y,z, --sun=x,y,z or --area=x,y,z:x,y,z:...");
    }
  }
  drop_repeats(*algorithms, *loaded);
  const auto camera = camera_of(options, loaded->prepared);
  if (!camera) return tl::unexpected(camera.error());
  if (options.illuminate.illuminate) return render_illuminated(options, *loaded, *camera);
  // One light, or those that were asked for side by side.
  if (options.scene.lights.empty() && !options.combined) loaded->lights.resize(1);

  report::PictureOptions picture;
  picture.camera = *camera;
  picture.width = options.width;
  picture.height = options.height;
  picture.backs = options.backs;
  picture.fragments = options.fragments;
  picture.legend = !options.no_legend;
  picture.title = loaded->scene.name + (loaded->lights.size() == 1 ? ", light" : ", lights");
  for (const std::uint32_t light : loaded->lights) {
    picture.title += " " + loaded->scene.lights[light].id;
  }

  const std::vector<OrderedPiece> pieces =
      options.visible ? std::move(visible) : back_to_front(loaded->prepared, camera->eye);
  if (options.combined) {
    return render_combined(options, *loaded, algorithms->front(), pieces, picture);
  }

  // What is shown: a result if one is named, else the exact answer; marked is what a candidate has
  // otherwise.
  std::deque<Claims> kept;  // panels point into them
  for (const std::string& file : {options.result, options.candidate}) {
    if (file.empty()) continue;
    auto result = read_claims(file, loaded->scene);
    if (!result) return tl::unexpected(result.error());
    kept.push_back(std::move(*result));
  }
  const Claims* candidate = options.candidate.empty() ? nullptr : &kept.back();
  std::vector<const Claims*> shown;
  if (options.result.empty()) {
    for (const AlgorithmChoice& algorithm : *algorithms) {
      auto exact = exact_fragments(*loaded, algorithm);
      if (!exact) return tl::unexpected(exact.error());
      shown.push_back(&kept.emplace_back(std::move(*exact)));
    }
  } else {
    shown.push_back(&kept.front());
  }
  std::vector<report::Panel> panels;
  for (const std::uint32_t light : loaded->lights) {
    const std::string& id = loaded->scene.lights[light].id;
    for (std::size_t i = 0; i < shown.size(); ++i) {
      report::Panel& panel = panels.emplace_back();
      panel.light = light;
      panel.shown = find_light(*shown[i], id);
      if (options.walls && !loaded->prepared.lights[light].has_area()) {
        panel.walls = shadow_polygons(loaded->prepared, light);
      }
      if (panel.shown == nullptr) return missing_light(options.result, id);
      const std::string fragments = report::grouped(fragment_count(*panel.shown)) + " fragments";
      if (shown.size() > 1) panel.caption = (*algorithms)[i].name(*loaded) + ": " + fragments;
      if (loaded->lights.size() > 1) {
        panel.caption = "light " + id + ", " + (shown.size() > 1 ? panel.caption : fragments);
      }
      if (candidate == nullptr) continue;
      panel.truth = panel.shown;
      panel.shown = find_light(*candidate, id);
      if (panel.shown == nullptr) return missing_light(options.candidate, id);
    }
  }
  auto output = Output::open(options.output);
  if (!output) return tl::unexpected(output.error());
  report::paint_scene(loaded->scene, loaded->prepared, pieces, panels, picture).write(*output);
  return output->finish();
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App& command = *app.add_subcommand("render", "Paint the classified scene as an SVG picture");
  command.footer(
      "Without RESULT the exact answer is shown. With --candidate the candidate is shown, and "
      "where it\n"
      "differs is marked. Of several lights the first is shown, or, side by side, those named with "
      "--light.\n\n"
      "Examples:\n"
      "  gnomon render room.json --eye 9,-7,6 --look-at 2,2,1 --light bulb -o room.svg\n"
      "  gnomon render room.json --algorithm both --fragments -o room.svg\n"
      "  gnomon render room.json --combined --fragments -o together.svg");
  add_scene_options(command, options->scene);
  command.add_option("RESULT", options->result, "A result to show, with fragments")
      ->type_name("FILE");
  add_algorithm_option(command, options->algorithm, "How the exact answer is found.",
                       "auto: sectors and receiver; both, all: several methods side by side");
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
  command.add_flag("--fragments", options->fragments, "Draw the borders of fragments");
  command.add_flag("--visible", options->visible,
                   "Paint what the eye sees, found exactly (gnomon visible), in no order, instead "
                   "of all\npolygons back to front");
  command.add_flag("--combined", options->combined,
                   "Paint by how many of the lights reach it: by all in colour, else in greys; "
                   "shadows painted\non shadows where the algorithm has cover=overlay");
  command.add_flag("--walls", options->walls,
                   "Paint besides the shadow polygons of point and directional lights: what lies "
                   "behind\neach edge of the contour, within the box of the scene");
  command.add_flag("--backs", options->backs, "Paint the backs of one-sided polygons too");
  add_illuminate_options(command, options->illuminate,
                         "Paint what the surfaces receive from all lights chosen");
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
