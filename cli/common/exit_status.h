// SPDX-License-Identifier: GPL-3.0-or-later
// The exit statuses of the command, as other programs read them (docs/formats.md).
#ifndef GNOMON_CLI_COMMON_EXIT_STATUS_H
#define GNOMON_CLI_COMMON_EXIT_STATUS_H

#include "gnomon/kernel/error.h"

namespace gnomon::cli {

enum ExitStatus : int {
  kDone = 0,          // every verdict asked for identical or within tolerance
  kFailed = 1,        // a candidate or a rounded kernel failed
  kBadInput = 2,      // usage, input, a file that cannot be read or written
  kLimitReached = 3,  // time, memory, fragments, digits
  kDisagree = 4,      // exact kernels or oracle disagree
  kInterruptedStatus = 130,
};

constexpr ExitStatus status_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kLimit:
      return kLimitReached;
    case ErrorCode::kInterrupted:
      return kInterruptedStatus;
    default:
      return kBadInput;
  }
}

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_EXIT_STATUS_H
