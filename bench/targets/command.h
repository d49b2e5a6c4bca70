// SPDX-License-Identifier: GPL-3.0-or-later
// A build's gnomon command, run and measured: what --stats tells of its phases, and what the system
// tells of the whole process. Both are CPU time of one thread.
#ifndef GNOMON_BENCH_TARGETS_COMMAND_H
#define GNOMON_BENCH_TARGETS_COMMAND_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::bench {

/// CPU seconds by phase.
struct CommandPhases {
  double reading = 0, preparation = 0, shadows = 0, output = 0;
};
/// From what --stats prints; none where a phase is missing.
std::optional<CommandPhases> parse_phases(std::string_view text);

using Words = std::vector<std::string>;
Words operator+(Words left, const Words& right);

class Command {
 public:
  struct Run {
    CommandPhases phases;
    double cpu = 0;  // seconds, of the whole process
    std::uint64_t peak_bytes = 0;
  };

  explicit Command(std::string path) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  /// As --version prints it.
  std::string version() const;
  /// Whether the help of `shadows` names the option.
  bool knows(const std::string& option) const;

  /// These end the program with a message if the command fails.
  void generate(const Words& words) const;
  /// `shadows` on one thread; what it prints goes nowhere. `phases`: asked for by --stats, which
  /// counts decisions too.
  Run shadows(const Words& words, bool phases) const;

 private:
  std::string output_of(const Words& words) const;

  std::string path_;
};

}  // namespace gnomon::bench

#endif  // GNOMON_BENCH_TARGETS_COMMAND_H
