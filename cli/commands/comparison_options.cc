// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/comparison_options.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "cli/common/algorithm_choice.h"
#include "cli/common/check_options.h"
#include "cli/common/commands.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/kernel_choice.h"

namespace gnomon::cli {

namespace {

template <class Text>
void add_once(std::vector<std::string>& texts, Text text) {
  if (std::ranges::find(texts, text) == texts.end()) texts.push_back(std::move(text));
}

/// The scene files of a folder and of those in it, in order of their names.
std::vector<std::string> scenes_below(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (auto entry = std::filesystem::recursive_directory_iterator(folder, error);
       !error && entry != std::filesystem::recursive_directory_iterator(); entry.increment(error)) {
    const std::string ending = entry->path().extension().string();
    if (entry->is_regular_file(error) &&
        (ending == ".json" || ending == ".obj" || ending == ".off" || ending == ".ply")) {
      files.push_back(entry->path().string());
    }
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

std::vector<std::string> all_kernels() {
  std::vector<std::string> names;
  for (const KernelInfo& info : kernel_list()) {
    if (has_kernel(info.id)) names.emplace_back(info.name);
  }
  return names;
}

Expected<std::vector<comparison::SceneSource>> ComparisonOptions::sources() const {
  std::vector<comparison::SceneSource> sources;
  for (const std::string& text : scenes) {
    std::error_code error;
    std::vector<std::string> names = {text};
    if (std::filesystem::is_directory(text, error)) {
      names = scenes_below(text);
      if (names.empty()) {
        return fail(ErrorCode::kUsage, text + ": no scene is below this folder",
                    "files .json, .obj, .off or .ply");
      }
    }
    std::string left_out;
    std::size_t count = 0;
    for (const std::string& name : names) {
      auto source = comparison::SceneSource::parse(name);
      if (!source) return tl::unexpected(source.error());
      if (names.size() > 1) {  // of a folder, where other files may lie, too
        const auto scene = source->make({}, seed);
        if (!scene || scene->lights.empty()) {
          if (++count == 1)
            left_out = scene ? name + ": there is no light" : to_string(scene.error());
          continue;
        }
      }
      sources.push_back(std::move(*source));
    }
    if (count > 0) {
      warn(text + ": " + std::to_string(count) + " of " + std::to_string(names.size()) +
           " files are left out, such as " + left_out);
    }
  }
  return sources;
}

Expected<std::vector<std::string>> ComparisonOptions::systems() const {
  std::vector<std::string> systems;
  for (const std::string& text : algorithms) {
    if (text == kAllName) return std::vector<std::string>{};
    const auto method = parse_method(text);
    if (!method) {
      Error error = method.error();
      error.what = "--algorithm " + error.what;
      return tl::unexpected(std::move(error));
    }
    add_once(systems, method_text(method->id, method->values));
  }
  return systems;
}

Expected<std::vector<std::string>> ComparisonOptions::kernel_names(
    const std::vector<std::string>& usual) const {
  std::vector<std::string> names;
  for (const std::string& name : kernels.empty() ? usual : kernels) {
    if (name == kAllName) {
      for (const std::string& kernel : all_kernels()) add_once(names, kernel);
      continue;
    }
    const auto kernel = parse_kernel_choice(name);
    if (!kernel) return tl::unexpected(kernel.error());
    add_once(names, kernel->name());
  }
  return names;
}

comparison::RunLimits ComparisonOptions::limits() const {
  comparison::RunLimits limits;
  if (!time.empty()) limits.seconds = duration_seconds(time);
  limits.megabytes = megabytes;
  return limits;
}

Expected<void> ComparisonOptions::write(const std::string& text,
                                        const std::function<void(report::TextSink&)>& write_json,
                                        const std::function<std::string()>& csv_text) const {
  if (json != "-" && csv != "-") {
    if (auto done = write_output({}, text); !done) return done;
  }
  if (!json.empty()) {
    auto output = Output::open(json);
    if (!output) return tl::unexpected(output.error());
    write_json(*output);
    if (auto done = output->finish(); !done) return done;
  }
  return csv.empty() ? Expected<void>() : write_output(csv, csv_text());
}

ExitStatus status_of(bool interrupted, const std::vector<std::string>& contradictions) {
  if (interrupted) return kInterruptedStatus;
  return contradictions.empty() ? kDone : kDisagree;
}

Expected<comparison::RunLog> open_log(const std::string& file) {
  if (file.empty()) return comparison::RunLog();
  return comparison::RunLog::open(file);
}

void add_log_option(CLI::App& command, std::string& file) {
  command
      .add_option("--log", file,
                  "Write each run to this file as soon as it is done, and run nothing again that "
                  "is there")
      ->type_name("FILE");
}

void add_plot_option(CLI::App& command, std::string& file, const std::string& what) {
  command.add_option("--plot", file, what)->type_name("FILE.svg");
}

Expected<void> write_plot(const std::string& file,
                          const std::function<void(report::TextSink&)>& draw) {
  if (file.empty()) return {};
  auto output = Output::open(file);
  if (!output) return tl::unexpected(output.error());
  draw(*output);
  return output->finish();
}

void add_thickness_option(CLI::App& command, std::vector<double>& thicknesses,
                          const std::string& absent) {
  repeatable(command.add_option("--try", thicknesses,
                                "A thickness of planes, relative to the scene's diagonal "
                                "(repeatable); absent: " +
                                    absent))
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("T");
}

void add_run_options(CLI::App& command, ComparisonOptions& options,
                     const std::string& usual_kernels, const std::string& usual_systems) {
  repeatable(command.add_option("--algorithm", options.algorithms,
                                "A system with its options (repeatable; gnomon systems lists "
                                "them), or all; absent:\n" +
                                    usual_systems))
      ->type_name("A");
  repeatable(command.add_option("--kernel", options.kernels,
                                "A kernel (repeatable), or all; " + usual_kernels + " if absent"))
      ->type_name("K");
  command
      .add_option("--certify-up-to", options.certify_up_to,
                  "Scenes of at most so many polygons are judged by the oracle")
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--repeat", options.repeat,
                  "Times that each run is measured, of which the median counts; 0: 3 to 25 times, "
                  "once\nwhat is long")
      ->type_name("R")
      ->capture_default_str();
  command.add_option("--time", options.time, "Of the clock, for one run with its judging; 60s")
      ->check(duration())
      ->type_name("T");
  command.add_option("--memory", options.megabytes, "Megabytes for one run; 0: no limit")
      ->type_name("M")
      ->capture_default_str();
  command.add_option("--json", options.json, "Write the rows as JSON; - for standard output alone")
      ->type_name("FILE");
  command.add_option("--csv", options.csv, "Write the rows as CSV; - for standard output alone")
      ->type_name("FILE");
  add_report_options(command, options.report);
}

void add_comparison_options(CLI::App& command, ComparisonOptions& options,
                            const std::string& usual_kernels) {
  command
      .add_option(
          "SCENE", options.scenes,
          "Scenes of 'gnomon generate' as NAME[:parameter=value,...], files, folders of them, "
          "or\ngenerators of campaigns")
      ->required()
      ->type_name("FAMILY|SCENE...");
  repeatable(command.add_option("--size", options.sizes,
                                "Polygons of a family's scene, at most (repeatable); absent: the "
                                "family's default"))
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  command.add_option("--seed", options.seed, "Seed of what is random")
      ->type_name("N")
      ->capture_default_str();
  add_run_options(command, options, usual_kernels, "every one that takes the scene's lights");
  command.add_flag("--commands", options.commands, "Print the command that repeats each row");
}

}  // namespace gnomon::cli
