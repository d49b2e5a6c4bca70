// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::cli {

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const std::string& text) {
  if (!terminal_) return;
  constexpr std::size_t kMostShown = 110;
  std::fprintf(stderr, "\r%s\033[K", text.substr(0, kMostShown).c_str());
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::say(const std::string& text) {
  clear();
  std::fprintf(stderr, "%s\n", text.c_str());
}

void ProgressLine::clear() {
  if (!shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

ProgressBar::ProgressBar(std::string what) : what_(std::move(what)), next_(Clock::now() + kDelay) {}

void ProgressBar::show(double done) {
  if (!line_.on_terminal()) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  constexpr int kCells = 30;
  const double share = std::isfinite(done) ? std::clamp(done, 0.0, 1.0) : 0;
  const int filled = static_cast<int>(share * kCells);
  const std::string number = std::to_string(static_cast<int>(share * 100));
  line_.show(what_.substr(0, 36) + " [" + std::string(filled, '#') +
             std::string(kCells - filled, '.') + "] " + std::string(3 - number.size(), ' ') +
             number + " %");
}

void ProgressBar::set_label(std::string what) {
  const std::lock_guard lock(mutex_);
  what_ = std::move(what);
}

void ProgressBar::clear() {
  const std::lock_guard lock(mutex_);
  line_.clear();
}

std::function<void(double)> ProgressBar::callback() {
  if (!line_.on_terminal()) return {};
  return [this](double done) { show(done); };
}

}  // namespace gnomon::cli
