// SPDX-License-Identifier: GPL-3.0-or-later
// Signals by which people and schedulers of jobs end a process. A program does not end itself by
// them when it fails: who is ended so has been told to stop, and nothing follows about its work.
#ifndef GNOMON_FUZZ_PROCESS_ORDER_TO_END_H
#define GNOMON_FUZZ_PROCESS_ORDER_TO_END_H

#include <csignal>

namespace gnomon::fuzz {

inline bool is_order_to_end(int signal) {
  return signal == SIGTERM || signal == SIGHUP || signal == SIGINT;
}

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_PROCESS_ORDER_TO_END_H
