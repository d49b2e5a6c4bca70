// SPDX-License-Identifier: GPL-3.0-or-later
// A shading mesh as a file that other programs show: binary PLY, and glTF 2.0 as text (.gltf, its
// buffer inside) or as one binary file (.glb). Triangles with a colour a vertex, which viewers
// interpolate as the 1992 paper's hardware did; vertices are shared where the shade is continuous.
//
// PLY holds the nearest doubles of the positions, sRGB colours as bytes, the illumination itself as
// `quality`, and for each triangle its polygon, its side and its class (0 lit, 1 penumbra of some
// light, 2 umbra of all). glTF has no doubles: positions are relative to the middle of the scene,
// which its node holds with the turn from our z axis up to glTF's y axis; colours are linear, and
// the material is unlit (KHR_materials_unlit), since they are already light. The same mesh always
// gives the same bytes.
#ifndef GNOMON_REPORT_MESHES_SHADED_MESH_FILES_H
#define GNOMON_REPORT_MESHES_SHADED_MESH_FILES_H

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "gnomon/algorithms/shading_mesh.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon::report {

enum class MeshFileFormat : std::uint8_t { kPly, kGltf, kGlb };

/// By the extension: .ply, .gltf, .glb, in any case. Errors: kUsage.
Expected<MeshFileFormat> mesh_file_format(const std::filesystem::path& path);

struct ShadedMeshOptions {
  double exposure = 0;  // colour 1 (white) is this times the illumination; 0: white is the largest
  bool tint = false;    // lit yellow, penumbra grey, umbra blue, as the paper's colour plates of
                        // classified scenes
  bool plain_ply = false;  // PLY of single precision whose triangles have no numbers of their own,
                           // for programs that read no other (meshio, PCL)
};

/// 1 / the largest illumination of the mesh; 1 if that is 0.
double automatic_exposure(const ShadingMesh& mesh);

/// Linear colours, 0 to 1, of an illumination in a face of these classes.
std::array<double, 3> shade_colour(double illumination, const MeshFace& face,
                                   const ShadedMeshOptions& options);
/// A linear intensity, 0 to 1, as sRGB shows it, 0 to 255.
std::uint8_t srgb_byte(double linear);

/// The whole file. Errors: kLimit (4 GB of glTF; PLY has none).
Expected<std::string> shaded_mesh_text(const Scene& scene, const PreparedScene& prepared,
                                       const ShadingMesh& mesh, MeshFileFormat format,
                                       const ShadedMeshOptions& options);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_MESHES_SHADED_MESH_FILES_H
