// SPDX-License-Identifier: GPL-3.0-or-later
// A picture of an illuminated scene: the faces of a shading mesh, painted back to front with their
// illumination interpolated between vertices, as colour plates 2, 4, 5 and 6 of the 1992 paper show
// it. Interpolation is linear on the screen and of what the screen shows (sRGB), as that of the
// paper's hardware; a face on which the shade hardly changes is flat. Lights are not painted.
//
// As picture.h: the order is exact, what is painted is good to a pixel and decides nothing.
#ifndef GNOMON_REPORT_PICTURES_SHADED_PICTURE_H
#define GNOMON_REPORT_PICTURES_SHADED_PICTURE_H

#include <vector>

#include "gnomon/algorithms/painters_order.h"
#include "gnomon/algorithms/shading_mesh.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/meshes/shaded_mesh_files.h"
#include "report/pictures/picture.h"
#include "report/pictures/svg.h"

namespace gnomon::report {

struct ShadedPictureOptions {
  PictureOptions picture;   // `fragments`: the borders of faces
  ShadedMeshOptions shade;  // exposure and tints
};

/// `pieces` back to front as seen from the camera's eye; the mesh is of the same scene.
SvgPicture paint_shaded_scene(const Scene& scene, const PreparedScene& prepared,
                              const std::vector<OrderedPiece>& pieces, const ShadingMesh& mesh,
                              const ShadedPictureOptions& options);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PICTURES_SHADED_PICTURE_H
