// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon info: what a scene holds, what preparation did to it, and which precision it needs.
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/scene_options.h"
#include "report/facts/scene_facts.h"

namespace gnomon::cli {

namespace {

struct InfoOptions {
  SceneOptions scene;
  bool all = false;
  double near = 0;
  std::string json;
};

int run_info(const InfoOptions& options) {
  const ThreadLimit threads(options.scene.jobs);
  const auto loaded = load_scene(options.scene, false);
  if (!loaded) return report_error(loaded.error());
  report::SceneFacts facts = report::scene_facts(loaded->scene, loaded->prepared, options.near);
  facts.left_out = loaded->left_out;
  if (options.json != "-") {
    const auto done =
        write_output({}, report::facts_text(loaded->scene, loaded->prepared, facts, options.all));
    if (!done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    report::write_facts_json(*output, loaded->scene, loaded->prepared, facts);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  return kDone;
}

}  // namespace

void add_info_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App& command =
      *app.add_subcommand("info", "What a scene holds and which precision it needs");
  command.footer("Example:\n  gnomon info house.obj --sun=1,2,3");
  add_scene_options(command, options->scene);
  command.remove_option(command.get_option("--light"));
  command.add_flag("--all", options->all, "List everything that was done to every polygon");
  command
      .add_option("--near", options->near,
                  "What is closer than this, scene units, is listed as meant to coincide\n"
                  "[1e-5 of the median size of polygons]")
      ->check(not_negative())
      ->type_name("D");
  command.add_option("--json", options->json, "Write the facts as JSON; - is standard output")
      ->type_name("FILE");
  command.callback([options, &action] { action = [options] { return run_info(*options); }; });
}

}  // namespace gnomon::cli
