// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon advise: which kernel, method and thickness a scene requires (comparison/advice.h).
#include <memory>
#include <string>

#include "cli/common/check_options.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "comparison/advice.h"

namespace gnomon::cli {

namespace {

struct AdviseOptions {
  comparison::AdvicePlan plan;
  std::string budget;
};

int run_advise(AdviseOptions options) {
  if (!options.budget.empty()) options.plan.budget = duration_seconds(options.budget);
  const auto program = own_program();
  if (!program) return report_error(program.error());
  ProgressLine line;
  comparison::CompareControl control;
  control.interrupted = &interrupted();
  control.progress = [&](const comparison::RunRequest& request, std::size_t done, std::size_t all) {
    line.show("advise " + std::to_string(done) + " of " + std::to_string(all) + ": " +
              request.kernel + '/' + request.system);
  };
  const auto advice = comparison::advise(options.plan, {*program, {"measure"}}, control);
  line.clear();
  if (!advice) return report_error(advice.error());
  bool contradicted = false;
  for (const comparison::Advice& each : *advice) {
    std::string text;
    if (advice->size() > 1) {
      text = each.lights == comparison::LightsAsked::kArea ? "Area lights\n"
                                                           : "Point and directional lights\n";
    }
    text += comparison::advice_text(options.plan, each);
    if (auto done = write_output({}, text); !done) return report_error(done.error());
    for (const std::string& contradiction : each.runs.contradictions) {
      warn("a bug of ours: " + contradiction);
      contradicted = true;
    }
  }
  return contradicted ? kDisagree : kDone;
}

}  // namespace

void add_advise_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<AdviseOptions>();
  CLI::App& command = *app.add_subcommand(
      "advise", "The cheapest kernel, method and thickness that are right for a scene");
  command.footer(
      "Measures plane, double, float and longdouble on the scene and judges each: whole regions "
      "up\n"
      "to --certify-up-to polygons, exact points above, and says which. Classes and shares are\n"
      "asked for, not fragments.\n\n"
      "Examples:\n"
      "  gnomon advise house.json\n"
      "  gnomon advise city.json --tolerance 1e-6 --budget 5m");
  command.add_option("SCENE", options->plan.scene, "Scene file, or a scene as of 'gnomon compare'")
      ->required()
      ->type_name("SCENE");
  command
      .add_option("--tolerance", options->plan.tolerance, "Wrong share of a polygon that is right")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("F")
      ->capture_default_str();
  command.add_option("--budget", options->budget, "Of the clock, for all of it; 60s")
      ->check(duration())
      ->type_name("T");
  command
      .add_option("--certify-up-to", options->plan.certify_up_to,
                  "Scenes of at most so many polygons are compared whole")
      ->type_name("N")
      ->capture_default_str();
  command.callback([options, &action] { action = [options] { return run_advise(*options); }; });
}

}  // namespace gnomon::cli
