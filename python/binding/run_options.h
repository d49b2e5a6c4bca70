// SPDX-License-Identifier: GPL-3.0-or-later
// Which kernel and method a call asks for, by the names of the command line.
#ifndef GNOMON_PYTHON_BINDING_RUN_OPTIONS_H
#define GNOMON_PYTHON_BINDING_RUN_OPTIONS_H

#include <atomic>
#include <string>

#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/kernel/error.h"

namespace gnomon::python {

struct RunNames {
  std::string kernel{"plane"}, algorithm{"auto"};
  unsigned jobs = 0;
};

/// At most one thread for each processor: TBB has no more, and says so on standard error.
unsigned usable_jobs(unsigned jobs);

/// Errors: kUsage, with the names that there are.
Expected<ShadowOptions> shadow_options(const RunNames& names, const std::atomic<bool>& stop);

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_RUN_OPTIONS_H
