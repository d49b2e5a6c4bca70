// SPDX-License-Identifier: GPL-3.0-or-later
// The options that say from where a picture is sampled, under the names of `render`.
#ifndef GNOMON_CLI_COMMON_CAMERA_OPTIONS_H
#define GNOMON_CLI_COMMON_CAMERA_OPTIONS_H

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "cli/common/scene_options.h"
#include "gnomon/scene/camera.h"

namespace gnomon::cli {

struct CameraOptions {
  std::string eye, look_at, up;  // x,y,z; empty: by the scene
  double field_of_view = 0;      // degrees; 0: shows all of the scene
  std::uint32_t width = 512, height = 512;

  bool given() const { return !eye.empty(); }
};

/// `across` and `down`: the names of the options that give the size. The options of the raster,
/// which are all but the eye, are returned.
std::vector<CLI::Option*> add_camera_options(CLI::App& command, CameraOptions& options,
                                             const std::string& across = "--width",
                                             const std::string& down = "--height");

/// The eye is read as the scene's numbers are; what is left out is chosen so that the scene is in
/// view. Errors: kUsage, and those of make_camera().
Expected<ExactCamera> camera_of(const CameraOptions& options, const LoadedScene& loaded);

/// The same camera, its eye moved by up to a sixteenth of the distance to the middle of the scene,
/// along each axis, by a seed.
ExactCamera moved_camera(const ExactCamera& camera, const LoadedScene& loaded, std::uint64_t seed);

/// "eye 1,2,3, right 32767,0,0, up ..., forward ...": what the camera is exactly.
std::string camera_text(const ExactCamera& camera, const Scene& scene);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMON_CAMERA_OPTIONS_H
