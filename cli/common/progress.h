// SPDX-License-Identifier: GPL-3.0-or-later
// A progress bar on standard error: only on a terminal, and only for work that takes longer than a
// second; in a pipe or a log there is nothing. May be told from several threads.
#ifndef GNOMON_CLI_COMMON_PROGRESS_H
#define GNOMON_CLI_COMMON_PROGRESS_H

#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace gnomon::cli {

class ProgressBar {
 public:
  explicit ProgressBar(std::string what);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() { clear(); }

  /// The fraction of the work that is done, 0..1.
  void show(double done);
  /// What is being done from here on; the clock goes on.
  void set_label(std::string what);
  /// Takes the bar off the screen.
  void clear();

  /// For options that take a function; empty where nothing would be shown.
  std::function<void(double)> callback();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kDelay{1000};
  static constexpr std::chrono::milliseconds kInterval{100};

  const bool terminal_;
  std::mutex mutex_;
  std::string what_;
  Clock::time_point next_;
  std::size_t shown_width_ = 0;
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_PROGRESS_H
