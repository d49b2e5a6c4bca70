// SPDX-License-Identifier: GPL-3.0-or-later
// What all pictures of a scene have in common besides what they paint on its polygons: colours of
// the frame, outlines of polygons, lamps.
#ifndef GNOMON_REPORT_PICTURES_SCENE_LINES_H
#define GNOMON_REPORT_PICTURES_SCENE_LINES_H

#include <vector>

#include "gnomon/algorithms/painters_order.h"
#include "gnomon/scene/prepare.h"
#include "report/pictures/flat_geometry.h"
#include "report/pictures/picture.h"
#include "report/pictures/svg.h"
#include "report/pictures/view.h"

namespace gnomon::report {

inline constexpr Colour kPictureBackground{243, 245, 248}, kPictureInk{33, 37, 48},
    kPictureLamp{255, 196, 0};
/// Hides the seams that antialiasing leaves between neighbours.
inline constexpr double kSeamWidth = 1.0;

inline constexpr double kLegendHeight = 46;

/// The frame of a picture that is one panel, its corner at (0, 0): what is painted between the two
/// calls is cut to it.
void begin_frame(SvgPicture& svg, const PictureOptions& options);
void end_frame(SvgPicture& svg, const PictureOptions& options);
/// The camera's view in such a frame.
View view_of(const PreparedScene& prepared, const PictureOptions& options);

/// The part's corners, scene units.
std::vector<Vector> whole_loop(const PreparedScene& prepared, const Part& part);

/// The piece's edges that are the polygon's own; cuts of the tree are not shown, nor those that
/// preparation made. `size`: the diagonal of the scene's box.
void paint_outline(const PreparedScene& prepared, const OrderedPiece& piece, double size,
                   const View& view, SvgPicture& svg);

/// Nothing of a directional light, nor of a lamp that is not in view.
void paint_point_lamp(const LightPoint& light, const View& view, SvgPicture& svg);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PICTURES_SCENE_LINES_H
