// SPDX-License-Identifier: GPL-3.0-or-later
// How long a phase of a command took.
#ifndef GNOMON_CLI_COMMON_STOPWATCH_H
#define GNOMON_CLI_COMMON_STOPWATCH_H

#include <chrono>
#include <ctime>
#include <utility>

namespace gnomon::cli {

/// CPU seconds of all threads, and seconds on the clock.
struct Seconds {
  double cpu = 0, elapsed = 0;

  Seconds& operator+=(const Seconds& other) {
    cpu += other.cpu;
    elapsed += other.elapsed;
    return *this;
  }
};

class Stopwatch {
 public:
  /// Since the last lap, or since it was made.
  Seconds lap() {
    const std::clock_t cpu = std::clock();
    const auto clock = Clock::now();
    const auto ticks = static_cast<double>(cpu - std::exchange(cpu_, cpu));
    const std::chrono::duration<double> elapsed = clock - std::exchange(clock_, clock);
    return {ticks / static_cast<double>(CLOCKS_PER_SEC), elapsed.count()};
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::clock_t cpu_ = std::clock();
  Clock::time_point clock_ = Clock::now();
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_STOPWATCH_H
