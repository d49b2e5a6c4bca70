// SPDX-License-Identifier: GPL-3.0-or-later
// What moves on standard error while a command works: one line, rewritten in place, and only on a
// terminal; in a pipe or a log there is nothing.
#ifndef GNOMON_CLI_COMMON_PROGRESS_H
#define GNOMON_CLI_COMMON_PROGRESS_H

#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace gnomon::cli {

class ProgressLine {
 public:
  ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { clear(); }

  bool on_terminal() const { return terminal_; }
  /// Replaces the line.
  void show(const std::string& text);
  /// Prints a line that stays, above the one that moves; in pipes and logs too.
  void say(const std::string& text);
  /// Takes the line off the screen.
  void clear();

 private:
  const bool terminal_;
  bool shown_ = false;
};

/// How far some work is, once it has taken longer than a second. May be told from several threads.
class ProgressBar {
 public:
  explicit ProgressBar(std::string what);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// The fraction of the work that is done, 0..1.
  void show(double done);
  /// Names what is being done from here on. The delay does not begin again.
  void set_label(std::string what);
  /// Takes the bar off the screen.
  void clear();

  /// For options that take a function; empty where nothing would be shown.
  std::function<void(double)> callback();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kDelay{1000};
  static constexpr std::chrono::milliseconds kInterval{100};

  std::mutex mutex_;
  ProgressLine line_;
  std::string what_;
  Clock::time_point next_;
};

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_PROGRESS_H
