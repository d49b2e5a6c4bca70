// SPDX-License-Identifier: LGPL-3.0-or-later
// explain() on one rounded kernel.
#ifndef GNOMON_ALGORITHMS_RUN_EXPLAIN_ON_H
#define GNOMON_ALGORITHMS_RUN_EXPLAIN_ON_H

#include <optional>

#include "algorithms/partition/run_task.h"
#include "gnomon/algorithms/explain.h"

namespace gnomon {

using Explanation = Expected<std::optional<FirstDifference>>;

template <class Kernel>
struct ExplainOn {
  static Explanation run(const RunTask& task);
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_EXPLAIN_ON_H
