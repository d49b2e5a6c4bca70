// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon certify --pixels FILE, and with --eye: pictures judged sample by sample, of a file or of
// our own methods.
#ifndef GNOMON_CLI_COMMANDS_CERTIFY_PIXELS_H
#define GNOMON_CLI_COMMANDS_CERTIFY_PIXELS_H

#include <string>
#include <vector>

#include "cli/common/camera_options.h"
#include "cli/common/scene_options.h"
#include "gnomon/algorithms/method_options.h"
#include "gnomon/kernel/kernel_choice.h"

namespace gnomon::cli {

struct PictureCommandOptions {
  CameraOptions camera;
  std::vector<std::string> files;        // gnomon-pixels
  std::vector<MethodSelection> methods;  // none: no runs of our own
  std::vector<KernelChoice> kernels;
  bool float_counts = true;  // for the status
  double thickness = 0, clearance = 0;
  bool strict = false;  // identical or failed
  unsigned jobs = 0;
  std::string json;
  bool times = false;
};

/// The exit status.
int run_certify_pixels(const PictureCommandOptions& options, const LoadedScene& loaded);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CERTIFY_PIXELS_H
