// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/check_options.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <utility>

#include "cli/common/commands.h"

namespace gnomon::cli {

namespace {

/// Nothing for a text that is no duration.
std::optional<double> parsed_duration(std::string_view text) {
  double factor = 1;
  if (!text.empty()) {
    switch (text.back()) {
      case 'h':
        factor = 3600;
        break;
      case 'm':
        factor = 60;
        break;
      case 's':
        break;
      default:
        factor = 0;
    }
    if (factor > 0) {
      text.remove_suffix(1);
    } else {
      factor = 1;
    }
  }
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (!std::isfinite(value) || value <= 0) return std::nullopt;
  return value * factor;
}

}  // namespace

CLI::Validator duration() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        if (parsed_duration(text)) return {};
        return "'" + text + "' is no time, such as 90, 90s, 5m or 2h";
      },
      "TIME");
}

double duration_seconds(const std::string& text) { return parsed_duration(text).value_or(0); }

void add_check_options(CLI::App& command, CheckCommandOptions& options) {
  repeatable(command.add_option(
                 "--kernel", options.kernels,
                 "What is under test (repeatable): KERNEL[+identity][+thin][/ALGORITHM[/AREA]]\n"
                 "[~MUTATION], such as double+identity or plane/svbsp/merged"))
      ->type_name("K");
  repeatable(command.add_option("--candidate-command", options.commands,
                                "A foreign program under test (repeatable): run with a scene's "
                                "file as its last\nargument; its standard output is the result"))
      ->type_name("CMD");
  repeatable(command.add_option("--property", options.properties,
                                "Only this property (repeatable); absent: all of them"))
      ->type_name("ID");
  command
      .add_option("--tolerance", options.tolerance,
                  "Of rounded and foreign results: fraction of each polygon that may be wrong; of\n"
                  "shares told alone, half a unit of the last digit unless this is given")
      ->check(not_negative())
      ->type_name("F")
      ->default_str("1e-9");
  command
      .add_option("--width", options.width,
                  "Width of a region of error that may be, scene units; default 1e-9 of the "
                  "diagonal")
      ->check(not_negative())
      ->type_name("W");
  command.add_flag("--strict", options.strict, "Tolerance and width 0");
  command
      .add_option("--fragments", options.fragments, "Fragments that a scene may have; more: budget")
      ->check(CLI::PositiveNumber)
      ->type_name("N")
      ->capture_default_str();
  command.add_option("--seconds", options.seconds, "Time that one scene may take; more: budget")
      ->check(CLI::PositiveNumber)
      ->type_name("S")
      ->capture_default_str();
  command
      .add_option("--megabytes", options.megabytes,
                  "Memory that one process may take; more: budget; 0: no limit")
      ->type_name("M")
      ->capture_default_str();
}

Expected<fuzz::WorkerOptions> worker_options(const CheckCommandOptions& options,
                                             std::vector<fuzz::Subject> standard) {
  fuzz::WorkerOptions worker;
  for (const std::string& name : options.kernels) {
    auto subject = fuzz::parse_subject(name);
    if (!subject) return tl::unexpected(subject.error());
    worker.check.subjects.push_back(std::move(*subject));
  }
  for (const std::string& command : options.commands) {
    auto subject = fuzz::parse_subject("command:" + command);
    if (!subject) return tl::unexpected(subject.error());
    worker.check.subjects.push_back(std::move(*subject));
  }
  if (worker.check.subjects.empty()) worker.check.subjects = std::move(standard);
  for (const std::string& id : options.properties) {
    const auto property = fuzz::property_by_id(id);
    if (!property) {
      std::string ids;
      for (const fuzz::PropertyInfo& info : fuzz::properties()) {
        ids += (ids.empty() ? "" : ", ") + std::string(info.id);
      }
      return fail(ErrorCode::kUsage, "--property " + id + ": no such property", "one of: " + ids);
    }
    worker.check.properties.push_back(*property);
  }
  worker.check.tolerance = options.tolerance.value_or(worker.check.tolerance);
  worker.check.share_tolerance = options.tolerance;
  worker.check.width = options.width;
  worker.check.strict = options.strict;
  worker.check.max_fragments = options.fragments;
  // A foreign program ends before the process that waits for it is ended.
  worker.check.command_seconds = options.seconds * 0.9;
  worker.check.command_megabytes = options.megabytes;
  worker.in_turn = options.in_turn;
  worker.limits = {options.seconds, options.megabytes};
  return worker;
}

Expected<std::string> own_program() {
  std::error_code failure;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", failure);
  if (failure) return fail(ErrorCode::kFile, "this program's own file: " + failure.message());
  return path.string();
}

}  // namespace gnomon::cli
