// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon worker: the process in which a campaign's scenes are checked (fuzz/worker.h). Not for
// people: it is not listed.
#include "fuzz/workers/worker.h"

#include <csignal>
#include <memory>

#include "cli/common/check_options.h"
#include "cli/common/commands.h"
#include "cli/common/jobs.h"
#include "cli/common/messages.h"

namespace gnomon::cli {

namespace {

struct WorkerCommandOptions {
  CheckCommandOptions check;
  std::vector<std::string> generators;
  std::optional<double> share_tolerance;  // its parent always says --tolerance
};

int run_worker_command(const WorkerCommandOptions& options) {
  // Its parent decides when it ends, and ends it. What is sent to all processes of a job reaches
  // the parent too.
  for (const int order : {SIGINT, SIGTERM, SIGHUP}) std::signal(order, SIG_IGN);
  // One core for each process: there are as many processes as were asked for.
  const ThreadLimit one_thread(1);
  auto worker = worker_options(options.check, {});
  if (!worker) return report_error(worker.error());
  worker->generators = options.generators;
  worker->check.share_tolerance = options.share_tolerance;
  const auto done = fuzz::run_worker(*worker);
  return done ? kDone : report_error(done.error());
}

}  // namespace

void add_worker_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<WorkerCommandOptions>();
  CLI::App& command = *app.add_subcommand("worker", "Serves a campaign; not for people");
  command.group("");
  add_check_options(command, options->check);
  repeatable(command.add_option("--generator", options->generators, "Scenes, in order"));
  command.add_option("--share-tolerance", options->share_tolerance, "Of shares told alone");
  command.add_flag("--in-turn", options->check.in_turn,
                   "One more exact kernel a scene, in turn; every eighth scene at length");
  command.callback(
      [options, &action] { action = [options] { return run_worker_command(*options); }; });
}

}  // namespace gnomon::cli
