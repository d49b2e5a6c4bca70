// SPDX-License-Identifier: GPL-3.0-or-later
// Loops of ridge edges for people, for programs, and as a picture from the light.
#ifndef GNOMON_REPORT_LOOPS_RIDGE_LOOPS_REPORT_H
#define GNOMON_REPORT_LOOPS_RIDGE_LOOPS_REPORT_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "gnomon/algorithms/ridge_loops.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

/// What loops are of. Keeps references.
struct RidgeLoopsOf {
  const Scene& scene;
  const PreparedScene& prepared;
  std::uint32_t light;
  std::span<const RidgeLoops> components;
};

/// A row a component, `most` at most, and their sums.
std::string ridge_loops_text(const RidgeLoopsOf& loops, std::size_t most);

/// "gnomon-loops": edges, crossings and loops of every component (docs: ridge-loops).
void write_ridge_loops_json(TextSink& sink, const RidgeLoopsOf& loops);

/// What the light sees: facing polygons, external loops, holes and internal loops. A sun sees along
/// its rays, a lamp in perspective. Errors: kUsage, for loops too far around the lamp to be in one
/// picture.
Expected<void> write_ridge_loops_svg(TextSink& sink, const RidgeLoopsOf& loops);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_LOOPS_RIDGE_LOOPS_REPORT_H
