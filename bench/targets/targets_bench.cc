// SPDX-License-Identifier: GPL-3.0-or-later
// The targets of speed under point lights and suns: how many times faster than another build of the
// command, run in turn with this one, and than Clipper. All times are CPU seconds of one thread,
// all ratios medians over the rounds of one run. Where another build is named its shares must be
// equal to this one's, as rationals on small scenes and within certified bounds on those measured.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "machine.h"
#include "parts.h"
#include "targets/target_run.h"

namespace gnomon::bench {
namespace {

/// `gnomon` beside this program.
std::string own_command() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path command = program.parent_path() / "gnomon";
  if (error || access(command.c_str(), X_OK) != 0) {
    fmt::print(stderr, "gnomon_bench: there is no gnomon command beside it: {}\n",
               command.string());
    std::exit(2);
  }
  return command.string();
}

}  // namespace

bool run_targets(Extent extent, const std::string& against, bool json) {
  // A message that ends the program leaves no files behind, either.
  static const WorkFiles kFiles;
  TargetRun run(extent, Command(own_command()),
                against.empty() ? std::nullopt : std::optional<Command>(against), kFiles);
  const std::string before = run.before ? fmt::format("{} ({})", against, run.before->version())
                                        : "none: ratios to another build are not measured";
  if (!json) fmt::print("\nTargets of speed\nagainst:  {}\n", before);
  for (const auto measure : {measure_suns, measure_year, measure_lamps, measure_whole_process,
                             measure_clipper, measure_plane_and_double}) {
    measure(run);
  }
  if (json) {
    fmt::print(
        "{{\n\"short\": {},\n\"against\": \"{}\",\n\"answers_agree\": {},\n\"targets\": {}\n}}\n",
        run.small(), before, run.good, run.verdicts.json());
    return run.good;
  }
  fmt::print("\n");
  run.answers.print();
  run.verdicts.print();
  if (run.small())
    fmt::print("Small scenes: what they miss or meet says nothing of the targets.\n");
  return run.good;
}

}  // namespace gnomon::bench
