// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon loops: ridge edges of solids as the light sees them, in loops of one depth.
#include <limits>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/scene_options.h"
#include "gnomon/algorithms/ridge_loops.h"
#include "report/loops/ridge_loops_report.h"

namespace gnomon::cli {

namespace {

struct LoopsOptions {
  SceneOptions scene;
  std::string output;
  bool open = false, all = false;
};

constexpr std::size_t kShownComponents = 20;

Expected<void> write(const LoopsOptions& options, const report::RidgeLoopsOf& loops) {
  if (options.output.empty()) return {};
  auto output = Output::open(options.output);
  if (!output) return tl::unexpected(std::move(output.error()));
  if (options.output.ends_with(".svg")) {
    auto done = report::write_ridge_loops_svg(*output, loops);
    if (!done) return done;
  } else {
    report::write_ridge_loops_json(*output, loops);
  }
  return output->finish();
}

Expected<void> find_loops(const LoopsOptions& options) {
  if (!options.output.empty() && options.output != "-" && !options.output.ends_with(".svg") &&
      !options.output.ends_with(".json")) {
    return fail(ErrorCode::kUsage, "-o " + options.output + ": no name of a format",
                "a file .json or .svg, or - for JSON");
  }
  const ThreadLimit threads(options.scene.jobs);
  const auto loaded = load_scene(options.scene, true);
  if (!loaded) return tl::unexpected(loaded.error());
  if (loaded->lights.size() != 1) {
    return fail(ErrorCode::kUsage, std::to_string(loaded->lights.size()) + " lights",
                "one; --light chooses it");
  }
  const auto found = ridge_loops(loaded->scene, loaded->prepared, loaded->lights.front(),
                                 options.open ? OpenComponents::kAllowed : OpenComponents::kRefused,
                                 &interrupted());
  if (!found) return tl::unexpected(found.error());
  const report::RidgeLoopsOf loops{loaded->scene, loaded->prepared, loaded->lights.front(), *found};
  if (options.output != "-") {
    const std::size_t most =
        options.all ? std::numeric_limits<std::size_t>::max() : kShownComponents;
    if (auto done = write_output({}, report::ridge_loops_text(loops, most)); !done) return done;
  }
  return write(options, loops);
}

}  // namespace

void add_loops_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<LoopsOptions>();
  CLI::App& command =
      *app.add_subcommand("loops", "Ridge edges of solids in loops, as a light sees them");
  command.footer(
      "Thakur, Cheng & Miura, section 2: ridge edges (VRE: the hidden neighbour is behind; HRE: "
      "in\n"
      "front), cut where they cross as seen from the light (VREPIPs: two VREs; others), and "
      "strung\n"
      "into external loops and holes, which bound the shadow, and internal loops, which bound the\n"
      "shadow of a solid on itself.\n\n"
      "Examples:\n"
      "  gnomon loops solids.json --light sun\n"
      "  gnomon loops solids.json --sun=1,2,3 -o loops.svg\n"
      "  gnomon loops room.json --light lamp --open -o loops.json");
  add_scene_options(command, options->scene);
  command.add_flag("--open", options->open,
                   "Take components that are not closed, their borders as ridge edges");
  command.add_flag(
      "--all", options->all,
      "A row for each component, not for the first " + std::to_string(kShownComponents) + " alone");
  command
      .add_option("-o,--output", options->output,
                  "Edges, crossings and loops as JSON (.json, -), or a picture from the light "
                  "(.svg)")
      ->type_name("FILE");
  command.callback([options, &action] {
    action = [options]() -> int {
      const auto done = find_loops(*options);
      return done ? kDone : report_error(done.error());
    };
  });
}

}  // namespace gnomon::cli
