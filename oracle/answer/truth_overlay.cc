// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/answer/truth_overlay.h"

#include <vector>

namespace gnomon::oracle {

GroupOverlay::Truth truth_of(const ExactAnswer& answer, std::uint32_t light,
                             const ReceiverGroup& group) {
  const bool area = answer.is_area(light);
  return [&answer, &group, light, area](Overlay& overlay, std::uint32_t part,
                                        const std::vector<ChartPoint>& loop) {
    if (!group.faces) {
      overlay.add_loop(loop, area ? kTrueUmbra : kTruth);
      return;
    }
    if (!area) {
      for (const ShadowPiece& piece : answer.shadows(light, part)) {
        overlay.add_loop(piece.loop, kTruth);
      }
      return;
    }
    const AreaShade& shade = answer.area_shade(light, part, group.side);
    overlay.add_loop(shade.behind, kTrueUmbra);
    for (const ShadowPiece& piece : shade.penumbra) overlay.add_loop(piece.loop, kTruth);
    for (const ShadowPiece& piece : shade.umbra) overlay.add_loop(piece.loop, kTrueUmbra);
  };
}

}  // namespace gnomon::oracle
