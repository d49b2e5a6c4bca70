// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/interrupt.h"

#include <unistd.h>

#include <csignal>

#include "cli/common/exit_status.h"

namespace gnomon::cli {

namespace {

std::atomic<bool> stop_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free);

void on_signal(int) {
  if (stop_asked.exchange(true)) ::_exit(kInterruptedStatus);
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // Whoever starts a program with nohup wants it to outlive the terminal.
  struct sigaction before {};
  ::sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

const std::atomic<bool>& interrupted() { return stop_asked; }

}  // namespace gnomon::cli
