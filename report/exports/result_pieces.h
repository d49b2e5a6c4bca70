// SPDX-License-Identifier: GPL-3.0-or-later
// A shadow result as a list of flat convex pieces, one class each: what files for other programs
// are made of.
#ifndef GNOMON_REPORT_EXPORTS_RESULT_PIECES_H
#define GNOMON_REPORT_EXPORTS_RESULT_PIECES_H

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"

namespace gnomon::report {

struct ResultPiece {
  std::vector<std::array<double, 3>> loop;  // nearest doubles, scene units, counter-clockwise seen
                                            // from the side
  std::uint32_t light = 0;                  // index into ShadowResult::lights
  std::uint32_t polygon = 0;                // index into Scene::polygons
  Side side = Side::kFront;
  LightState state = LightState::kLit;
  std::optional<std::uint32_t> caster;  // a polygon: one that shadows all of the piece
  Interval lit;                         // share of the whole side of the polygon
};

/// Every fragment of every side that faces a light, and the parts of all others whole. Requires:
/// LightResult::points. Errors: kUsage (fragments that lie over each other, or leave a class out).
Expected<std::vector<ResultPiece>> result_pieces(const PreparedScene& prepared,
                                                 const ShadowResult& result);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_EXPORTS_RESULT_PIECES_H
