// SPDX-License-Identifier: GPL-3.0-or-later
// Hidden lines as an SVG picture: what is seen solid, dashed where it is in shadow; what is hidden
// thin, if asked for. Which part is what is exact, its place in the picture good to a pixel.
#ifndef GNOMON_REPORT_LINES_LINES_PICTURE_H
#define GNOMON_REPORT_LINES_LINES_PICTURE_H

#include <string>

#include "gnomon/scene/prepare.h"
#include "report/lines/drawn_lines.h"
#include "report/pictures/svg.h"

namespace gnomon::report {

SvgPicture lines_picture(const PreparedScene& prepared, const DrawnLines& drawn, bool hidden,
                         const std::string& title);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_LINES_LINES_PICTURE_H
