// SPDX-License-Identifier: GPL-3.0-or-later
// A shadow result as binary glTF 2.0: a node for each light and class, in that class' colour, so
// that viewers show and hide them one by one. No illumination is computed; a shaded mesh
// (report/meshes/) has one. Positions are floats relative to the middle of the scene.
#ifndef GNOMON_REPORT_EXPORTS_CLASS_MESH_H
#define GNOMON_REPORT_EXPORTS_CLASS_MESH_H

#include <span>
#include <string>

#include "report/exports/result_pieces.h"

namespace gnomon::report {

/// The whole file. Errors: kLimit (more than 4 GB), kNumber (a position that is no number, of a
/// kernel that rounds).
Expected<std::string> class_mesh(const Scene& scene, const PreparedScene& prepared,
                                 const ShadowResult& result, std::span<const ResultPiece> pieces);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_EXPORTS_CLASS_MESH_H
