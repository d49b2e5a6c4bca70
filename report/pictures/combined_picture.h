// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a scene under several lights together, as Figure 8 of Chin & Feiner 1989: what all
// of them reach is in colour, what some do not reach in greys, the darker the fewer do. Of shadows
// painted on shadows (Slater 1992, section 6) each is painted where it lies, by ascending level.
//
// As picture.h: the order is exact, what is painted is good to a pixel and decides nothing.
#ifndef GNOMON_REPORT_PICTURES_COMBINED_PICTURE_H
#define GNOMON_REPORT_PICTURES_COMBINED_PICTURE_H

#include <cstdint>
#include <vector>

#include "gnomon/algorithms/painters_order.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/pictures/picture.h"
#include "report/pictures/svg.h"

namespace gnomon::report {

/// `pieces` back to front as seen from the camera's eye; `lights`: indices into
/// PreparedScene::lights, those that the claims tell of. An area light of whose penumbra a fragment
/// is counts half.
/// Requires: the claims have `combined` or `overlay`.
SvgPicture paint_combined_scene(const Scene& scene, const PreparedScene& prepared,
                                const std::vector<OrderedPiece>& pieces, const Claims& claims,
                                const std::vector<std::uint32_t>& lights,
                                const PictureOptions& options);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PICTURES_COMBINED_PICTURE_H
