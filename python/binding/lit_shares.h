// SPDX-License-Identifier: GPL-3.0-or-later
// Lit shares of all sides under many lights: doubles as in the tables of the command, or rationals.
#ifndef GNOMON_PYTHON_BINDING_LIT_SHARES_H
#define GNOMON_PYTHON_BINDING_LIT_SHARES_H

#include <atomic>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "python/binding/loaded_scene.h"
#include "python/binding/run_options.h"

namespace gnomon::python {

/// Row by row: `columns` of each light. With `fronts` a column a polygon, of its front, not a
/// number where the polygon has no area; else those of report::ShareColumns.
struct LitShares {
  std::size_t lights = 0, columns = 0;
  std::vector<double> values;
};
/// Errors: those of lights, of preparing, of the kernel; kInterrupted.
Expected<LitShares> lit_shares(const LoadedScene& loaded, std::vector<Light> lights, bool fronts,
                               const RunNames& names, const std::atomic<bool>& stop);

/// The same as texts: "p/q", the shortest text of the double where the polygon's parts lie in
/// several planes and the share is no rational number, or "" where it has no area. Errors: kUsage
/// for a kernel that rounds besides.
struct ExactShares {
  std::size_t lights = 0, columns = 0;
  std::vector<std::string> values;
};
Expected<ExactShares> exact_shares(const LoadedScene& loaded, std::vector<Light> lights,
                                   bool fronts, const RunNames& names,
                                   const std::atomic<bool>& stop);

}  // namespace gnomon::python

#endif  // GNOMON_PYTHON_BINDING_LIT_SHARES_H
