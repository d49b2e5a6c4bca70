// SPDX-License-Identifier: GPL-3.0-or-later
#include "targets/command.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "process.h"

namespace gnomon::bench {
namespace {

[[noreturn]] void stop(const std::string& path, const Words& words, const std::string& why) {
  fmt::print(stderr, "gnomon_bench: {}", path);
  for (const std::string& word : words) fmt::print(stderr, " {}", word);
  fmt::print(stderr, ": {}\n", why);
  std::exit(2);
}

ProcessRun run_or_stop(const std::string& path, const Words& words, Keep keep) {
  std::optional<ProcessRun> run = run_process(path, words, keep);
  if (!run) stop(path, words, "cannot be started");
  if (run->status != 0)
    stop(path, words, fmt::format("exit status {}\n{}", run->status, run->text));
  return std::move(*run);
}

}  // namespace

std::optional<CommandPhases> parse_phases(std::string_view text) {
  const std::size_t line = text.find("CPU seconds (elapsed): ");
  if (line == std::string_view::npos) return std::nullopt;
  text = text.substr(line, text.find('\n', line) - line);
  CommandPhases phases;
  const std::array<std::pair<std::string_view, double*>, 4> named{
      {{" reading ", &phases.reading},
       {" preparation ", &phases.preparation},
       {" shadows ", &phases.shadows},
       {" output ", &phases.output}}};
  for (const auto& [name, value] : named) {
    const std::size_t at = text.find(name);
    if (at == std::string_view::npos) return std::nullopt;
    const std::string_view number = text.substr(at + name.size());
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), *value);
    if (error != std::errc{}) return std::nullopt;
  }
  return phases;
}

Words operator+(Words left, const Words& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

std::string Command::output_of(const Words& words) const {
  return run_or_stop(path_, words, Keep::kOutput).text;
}

std::string Command::version() const {
  std::string text = output_of({"--version"});
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

bool Command::knows(const std::string& option) const {
  return output_of({"shadows", "--help"}).find(option + " ") != std::string::npos;
}

void Command::generate(const Words& words) const { output_of(Words{"generate"} + words); }

Command::Run Command::shadows(const Words& words, bool phases) const {
  Words all = Words{"shadows", "--jobs", "1"} + words;
  if (phases) all.emplace_back("--stats");
  const ProcessRun run = run_or_stop(path_, all, Keep::kErrors);
  Run result{{}, run.cpu, run.peak_bytes};
  if (!phases) return result;
  const std::optional<CommandPhases> read = parse_phases(run.text);
  if (!read) stop(path_, all, "its --stats name no times:\n" + run.text);
  result.phases = *read;
  return result;
}

}  // namespace gnomon::bench
