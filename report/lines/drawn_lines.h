// SPDX-License-Identifier: GPL-3.0-or-later
// What a drawing of hidden lines is made of: the edges of the polygons that face the eye, their
// parts as the eye has them, and as each light has them.
#ifndef GNOMON_REPORT_LINES_DRAWN_LINES_H
#define GNOMON_REPORT_LINES_DRAWN_LINES_H

#include <cstdint>
#include <string>
#include <vector>

#include "gnomon/algorithms/hidden_lines.h"
#include "gnomon/scene/camera.h"

namespace gnomon::report {

struct ShadowedLines {
  std::uint32_t light = 0;  // index into Scene::lights
  HiddenLines lines;
};

struct DrawnLines {
  ExactCamera camera;
  std::string geometry;  // digest of the scene
  std::vector<OutlineEdge> edges;
  HiddenLines seen;                     // a line for each edge, in the same order
  std::vector<ShadowedLines> shadowed;  // the same for each light
};

/// How a part of an edge is drawn.
enum class LineStyle : std::uint8_t {
  kSeen,      // nothing hides it from the eye
  kShadowed,  // nothing hides it from the eye, and something from a light
  kHidden,    // something hides it from the eye
};

struct StyledPart {
  double from = 0, to = 1;  // nearest doubles of the parameters
  LineStyle style = LineStyle::kSeen;
};

/// The parts of edge `i`, neighbours with different styles. Exact but for the doubles.
std::vector<StyledPart> styled_parts(const DrawnLines& drawn, std::size_t i);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_LINES_DRAWN_LINES_H
