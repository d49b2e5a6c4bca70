// SPDX-License-Identifier: GPL-3.0-or-later
// The targets of speed under point lights and suns: how many times faster than another build of the
// command, run in turn with this one, and than Clipper. All times are CPU seconds of one thread,
// all ratios medians over the rounds of one run. Where another build is named its shares must be
// equal to this one's, as rationals on small scenes and within certified bounds on those measured.
#include <fmt/format.h>
#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>
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

void print_json(const TargetRun& run, const std::string& before) {
  rapidjson::StringBuffer buffer;
  rapidjson::PrettyWriter<rapidjson::StringBuffer> writer(buffer);
  writer.SetIndent(' ', 1);
  writer.StartObject();
  const auto text = [&writer](const char* key, const std::string& value) {
    writer.Key(key);
    writer.String(value.c_str());
  };
  text("machine", machine_text());
  text("against", before);
  writer.Key("short");
  writer.Bool(run.small());
  writer.Key("answers_agree");
  writer.Bool(run.good);
  writer.Key("targets");
  const std::string rows = run.verdicts.json();
  writer.RawValue(rows.data(), rows.size(), rapidjson::kArrayType);
  writer.EndObject();
  fmt::print("{}\n", buffer.GetString());
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
                             measure_rays, measure_clipper, measure_plane_and_double}) {
    measure(run);
  }
  if (json) {
    print_json(run, before);
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
