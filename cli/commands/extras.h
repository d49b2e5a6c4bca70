// SPDX-License-Identifier: GPL-3.0-or-later
// Options of `gnomon shadows` for what a result says besides classes and shares: areas by number of
// casters, centroids, sums of groups, form factors to the sky and between polygons.
#ifndef GNOMON_CLI_COMMANDS_EXTRAS_H
#define GNOMON_CLI_COMMANDS_EXTRAS_H

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shadow_options.h"
#include "gnomon/kernel/error.h"
#include "report/json/extras_json.h"

namespace gnomon::cli {

struct ExtrasOptions {
  bool counts = false, centroids = false, groups = false, sky = false;
  std::string up;
  std::vector<std::pair<std::string, std::string>> view_factors;
  double tolerance = 5e-2;
  std::uint64_t most_cells = 2000;

  /// What is asked for has a meaning without lights.
  bool works_without_light() const { return sky || !view_factors.empty(); }
  /// The options that were given, by name.
  std::vector<std::pair<const char*, bool>> given() const {
    return {{"--counts", counts},
            {"--centroids", centroids},
            {"--groups", groups},
            {"--sky", sky},
            {"--view-factor", !view_factors.empty()}};
  }
};

void add_extras_options(CLI::App& command, ExtrasOptions& options);

/// What the run of shadows has to keep for them. Errors: kUsage, where they do not go together with
/// the lights or the method.
Expected<void> ask_for_extras(const ExtrasOptions& options, const LoadedScene& loaded,
                              ShadowOptions& shadows);

/// Everything that was asked for. Errors: kUsage (a polygon that does not exist, a scene without
/// groups), kLimit, kInterrupted.
Expected<report::ResultExtras> find_extras(const ExtrasOptions& options, const LoadedScene& loaded,
                                           const ShadowOptions& shadows);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_EXTRAS_H
