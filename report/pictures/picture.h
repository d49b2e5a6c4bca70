// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of a classified scene from any eye, painted back to front as in the papers: lit faces
// shaded by their orientation to the light, shadows darker and cooler, and, where a second result
// is given, what it has otherwise in a signal colour.
//
// The order is the scene BSP's and exact; what is painted is clipped and projected in doubles,
// which is enough for pixels and decides nothing.
#ifndef GNOMON_REPORT_PICTURES_PICTURE_H
#define GNOMON_REPORT_PICTURES_PICTURE_H

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/algorithms/painters_order.h"
#include "gnomon/result/claims.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/pictures/svg.h"

namespace gnomon::report {

using Point = std::array<double, 3>;

struct Camera {
  Point eye{}, look_at{};
  Point up{0, 0, 1};
  double field_of_view = 0;   // degrees, across the larger side of the picture; 0: fits the scene
  bool centre_scene = false;  // move the frame, not the eye, so that the scene is in its middle
};

/// A camera that has the whole scene in view, from a corner above it.
Camera default_camera(const PreparedScene& prepared);

/// A place to point at, with a number beside it.
struct Mark {
  Point at{};
  std::string label;
};

struct PictureOptions {
  Camera camera;
  double width = 960, height = 720;  // pixels, of one panel
  bool backs = false;                // paint the backs of one-sided polygons too
  bool fragments = false;            // draw the borders of fragments
  bool legend = true;
  std::string title;
};

/// One panel: the scene under one light as `shown` has it.
struct Panel {
  std::uint32_t light = 0;  // index into PreparedScene::lights
  std::string caption;
  const ClaimedLight* shown = nullptr;
  const ClaimedLight* truth = nullptr;  // what differs from it is marked; may be null
  std::vector<Mark> marks;
  /// Shadow polygons (Crow 1977, Figure 4), convex: what is in the scene's box, seen through, over
  /// all else that is painted.
  std::vector<std::vector<Point>> walls{};
};

/// Panels side by side, one legend below them. `pieces` back to front as seen from the camera's
/// eye.
SvgPicture paint_scene(const Scene& scene, const PreparedScene& prepared,
                       const std::vector<OrderedPiece>& pieces, const std::vector<Panel>& panels,
                       const PictureOptions& options);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PICTURES_PICTURE_H
