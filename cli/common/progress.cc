// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gnomon::cli {

ProgressBar::ProgressBar(std::string what)
    : terminal_(::isatty(STDERR_FILENO) != 0),
      what_(std::move(what)),
      next_(Clock::now() + kDelay) {}

void ProgressBar::show(double done) {
  if (!terminal_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kInterval;
  constexpr int kCells = 30;
  const double share = std::isfinite(done) ? std::clamp(done, 0.0, 1.0) : 0;
  const int filled = static_cast<int>(share * kCells);
  const std::string number = std::to_string(static_cast<int>(share * 100));
  std::string line = what_.substr(0, 36) + " [" + std::string(filled, '#') +
                     std::string(kCells - filled, '.') + "] " +
                     std::string(3 - number.size(), ' ') + number + " %";
  const std::size_t width = line.size();
  if (width < shown_width_) line.append(shown_width_ - width, ' ');
  shown_width_ = std::max(width, shown_width_);
  std::fprintf(stderr, "\r%s", line.c_str());
  std::fflush(stderr);
}

void ProgressBar::set_label(std::string what) {
  const std::lock_guard lock(mutex_);
  what_ = std::move(what);
}

void ProgressBar::clear() {
  const std::lock_guard lock(mutex_);
  if (shown_width_ == 0) return;
  std::fprintf(stderr, "\r%s\r", std::string(shown_width_, ' ').c_str());
  std::fflush(stderr);
  shown_width_ = 0;
}

std::function<void(double)> ProgressBar::callback() {
  if (!terminal_) return {};
  return [this](double done) { show(done); };
}

}  // namespace gnomon::cli
