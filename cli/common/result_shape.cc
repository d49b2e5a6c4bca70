// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/result_shape.h"

#include <utility>

#include "cli/common/interrupt.h"
#include "gnomon/scene/digest.h"

namespace gnomon::cli {

void add_shape_options(CLI::App& command, ResultShape& shape) {
  command.add_flag("--fragments", shape.fragments, "Write the fragments, as nearest doubles");
  command.add_flag("--exact-fractions", shape.exact_fractions,
                   "Write fractions as exact rationals \"p/q\" (exact kernels)");
  command.add_flag("--exact-loops", shape.exact_loops,
                   "Write fragments with exact rational coordinates (exact kernels)");
}

tl::unexpected<Error> needs_exact_kernel(const std::string& option, const std::string& kernel) {
  return fail(ErrorCode::kUsage, option + ": kernel " + kernel + " rounds",
              "an exact kernel: plane, rational or epeck");
}

Expected<void> check_exactness(const ResultShape& shape, const KernelChoice& kernel) {
  if (kernel.exact()) return {};
  if (shape.exact_fractions) return needs_exact_kernel("--exact-fractions", kernel.name());
  if (shape.exact_loops) return needs_exact_kernel("--exact-loops", kernel.name());
  return {};
}

void keep_for(const ResultShape& shape, ShadowOutput& output) {
  output.points = shape.fragments || (shape.combined && !shape.exact_loops);
  output.exact_points = shape.exact_loops;
  output.exact_fractions = shape.exact_fractions;
  output.combined = shape.combined;
}

report::ResultJsonOptions result_json_options(const ResultShape& shape, const LoadedScene& loaded,
                                              const AlgorithmChoice& algorithm) {
  report::ResultJsonOptions json;
  json.geometry_digest = geometry_digest(loaded.scene);
  json.fragments = shape.fragments;
  json.exact_fractions = shape.exact_fractions;
  json.exact_loops = shape.exact_loops;
  json.combined = shape.combined && !algorithm.paints();
  json.overlay = shape.combined && algorithm.paints();
  json.interrupted = &interrupted();
  return json;
}

}  // namespace gnomon::cli
