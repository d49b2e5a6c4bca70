// SPDX-License-Identifier: GPL-3.0-or-later
// shadows --illuminate: the classified scene subdivided, its vertices illuminated, and written as a
// mesh that other programs show.
#ifndef GNOMON_CLI_COMMANDS_ILLUMINATE_H
#define GNOMON_CLI_COMMANDS_ILLUMINATE_H

#include <CLI/CLI.hpp>
#include <string>

#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shading_mesh.h"
#include "gnomon/algorithms/shadows.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

struct IlluminateOptions {
  bool illuminate = false;
  std::string grid;  // LIT[,PENUMBRA]
  double adaptive = 0;
  double ambient = 0;
  double exposure = 0;
  bool tint = false;
  std::string mesh;
  bool plain_ply = false;
  bool stats = false;  // --stats, which is another's option
};

/// --illuminate with that description, and the options of how; returns --illuminate.
CLI::Option* add_illuminate_options(CLI::App& command, IlluminateOptions& options,
                                    const std::string& description);
/// --mesh, which needs --illuminate.
void add_mesh_option(CLI::App& command, IlluminateOptions& options, CLI::Option* illuminate);

/// Errors: kUsage, for options that do not go together or that the scene's lights do not allow;
/// before anything is computed. `algorithm`: as it was typed. Makes the classification keep what
/// illumination needs.
Expected<void> ask_for_illumination(const IlluminateOptions& options, const LoadedScene& loaded,
                                    const std::string& algorithm, ShadowOptions& shadows);

/// Classifies by all lights chosen, and illuminates. Errors: as ask_for_illumination() and
/// shaded().
Expected<ShadingMesh> classified_and_shaded(const IlluminateOptions& options,
                                            const LoadedScene& loaded, const std::string& algorithm,
                                            unsigned jobs);

/// Illuminates a result of those options. Errors: kUsage, kLimit, kInterrupted.
Expected<ShadingMesh> shaded(const IlluminateOptions& options, const LoadedScene& loaded,
                             const ShadowResult& result);

/// The same if --illuminate was given, --mesh written and, with --stats, the line of the 1992
/// paper's Figure 8 printed to standard error. Errors: also kFile.
Expected<void> illuminate(const IlluminateOptions& options, const LoadedScene& loaded,
                          const ShadowResult& result);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_ILLUMINATE_H
