// SPDX-License-Identifier: LGPL-3.0-or-later
// Convex shells that cast their penumbra under an area light as wholes (shell_volume.h).
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHELL_CASTERS_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHELL_CASTERS_H

#include <cstdint>
#include <vector>

#include "gnomon/algorithms/components.h"

namespace gnomon {

struct ShellCasters {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::vector<ConvexShell> shells;     // all of whose parts cast
  std::vector<std::uint32_t> of_part;  // its shell, or kNone
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_SHELL_CASTERS_H
