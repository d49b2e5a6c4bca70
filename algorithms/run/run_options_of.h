// SPDX-License-Identifier: LGPL-3.0-or-later
// The part of the public options that the algorithms below this room are told.
#ifndef GNOMON_ALGORITHMS_RUN_RUN_OPTIONS_OF_H
#define GNOMON_ALGORITHMS_RUN_RUN_OPTIONS_OF_H

#include "algorithms/partition/run_options.h"
#include "gnomon/algorithms/shadows.h"

namespace gnomon {

inline RunOptions run_options_of(const ShadowOptions& options) {
  RunOptions result;
  result.keep_points = options.keep_points;
  result.keep_exact_points = options.keep_exact_points;
  result.exact_fractions = options.exact_fractions;
  result.merge = options.merge;
  result.prefix = options.prefix;
  result.leaf_size = options.leaf_size;
  result.task_size = options.task_size;
  result.jobs = options.jobs;
  result.max_fragments = options.max_fragments;
  result.interrupted = options.interrupted;
  return result;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_RUN_RUN_OPTIONS_OF_H
