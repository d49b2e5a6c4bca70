// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon convert: a scene in another format, with the same values, or put right first where it does
// not say what was meant.
#include <memory>

#include "cli/commands/repair_options.h"
#include "cli/common/commands.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/receiver_argument.h"
#include "cli/common/scene_options.h"
#include "gnomon/scene/light_arguments.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/visible_light_scene.h"
#include "gnomon/scene/write.h"

namespace gnomon::cli {

namespace {

struct ConvertOptions {
  SceneOptions scene;
  RepairOptions repair;
  std::string from, area_light, on;  // a point's sight of an area light; empty: the scene itself
  std::string target;
  std::string format;
};

/// Replaces the scene by what a point sees of an area light, if that was asked for.
Expected<void> take_sight(const ConvertOptions& options, Scene& scene) {
  if (options.from.empty()) return {};
  auto point = parse_position(options.from, scene.numbers, "--from");
  if (!point) return tl::unexpected(std::move(point.error()));
  const ReceiverArgument on = parse_receiver(options.on, scene);
  auto seen =
      visible_light_scene(scene, {options.area_light, *std::move(point), on.polygon, on.side});
  if (!seen) return tl::unexpected(std::move(seen.error()));
  scene = std::move(*seen);
  return {};
}

int run_convert(const ConvertOptions& options) {
  std::optional<SceneFormat> format;
  if (!options.format.empty()) {
    format = format_by_name(options.format);
  } else {
    format = options.target == "-" ? SceneFormat::kJson : format_by_extension(options.target);
  }
  if (!format) {
    return report_usage("the name does not say which format to write",
                        "an extension " + shown_written_extensions() + ", or --format",
                        options.target);
  }
  auto scene = read_scene_with_lights(options.scene);
  if (!scene) return report_error(scene.error());
  if (auto done = repair(*scene, options.scene, options.repair, options.target); !done) {
    return report_error(done.error());
  }
  if (auto done = take_sight(options, scene->scene); !done) return report_error(done.error());
  const auto written = scene_to_text(scene->scene, *format);
  if (!written) return report_error(written.error());
  for (const std::string& warning : written->warnings) warn(options.target + ": " + warning);
  if (auto done = write_output(options.target, written->text); !done) {
    return report_error(done.error());
  }
  return kDone;
}

}  // namespace

void add_convert_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App& command =
      *app.add_subcommand("convert", "Write a scene in another format, or repaired");
  command.footer(
      "The format of OUT is that of its extension. What it cannot hold (holes, ids, lights, flags) "
      "is\n"
      "named in warnings. Repairs are exact; what was changed is said, and written into "
      "\"extra\".\n"
      "\n"
      "Examples:\n"
      "  gnomon convert house.obj house.json --sun=1,2,3\n"
      "  gnomon convert house.json house.ply --format ply-binary\n"
      "  gnomon convert house.idf house.city.json\n"
      "  gnomon convert model.json meant.json --snap 1e-6 --parent --orient\n"
      "  gnomon convert room.json seen.json --from 1,2,0 --area-light panel");
  add_scene_options(command, options->scene);
  command.remove_option(command.get_option("--light"));
  command.add_option("OUT", options->target, "File to write; - is standard output")
      ->required()
      ->type_name("FILE");
  command.add_option("--format", options->format, "Format of OUT, whatever its name")
      ->check(CLI::IsMember(written_format_names()))
      ->type_name(CLI::detail::join(written_format_names(), "|"));
  add_repair_options(command, options->repair);
  CLI::Option* from =
      command
          .add_option("--from", options->from,
                      "What a point sees of an area light: a scene whose lamp is the point and "
                      "whose first polygon is the light; lit is what is seen")
          ->type_name("X,Y,Z")
          ->group("Sight");
  command.add_option("--area-light", options->area_light, "Its id [the only one]")
      ->type_name("ID")
      ->needs(from)
      ->group("Sight");
  command
      .add_option("--on", options->on,
                  "The polygon that the point lies on: it sees what is before its front, or, with "
                  ":back, behind it [all around]")
      ->type_name("ID[:back]")
      ->needs(from)
      ->group("Sight");
  command.callback([options, &action] { action = [options] { return run_convert(*options); }; });
}

}  // namespace gnomon::cli
