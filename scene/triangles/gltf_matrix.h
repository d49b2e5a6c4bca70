// SPDX-License-Identifier: LGPL-3.0-or-later
// Where nodes of glTF stand: affine maps of float32 numbers, whose products are computed exactly.
#ifndef GNOMON_SCENE_TRIANGLES_GLTF_MATRIX_H
#define GNOMON_SCENE_TRIANGLES_GLTF_MATRIX_H

#include <array>
#include <optional>

#include "gnomon/scene/scene.h"
#include "scene/json/json_tape.h"

namespace gnomon {

/// rows[i] maps x, y, z and 1 to one coordinate. All numbers are dyadic.
struct GltfMatrix {
  std::array<std::array<Number, 4>, 3> rows;

  static GltfMatrix identity();
  /// Is every number a 0 but those of the identity?
  bool is_identity() const;
  Position apply(const Position& position) const;
  /// The map that applies `inner` first. Exactness: exact.
  GltfMatrix after(const GltfMatrix& inner) const;
  /// Does it turn left hands into right ones? Exactness: exact.
  bool mirrors() const;
};

/// A node's own map, by `matrix`, or by translation, rotation and scale.
struct GltfPlacement {
  GltfMatrix matrix;
  /// Is the rotation by a quaternion that no rotation is, since its numbers are rounded? Quarter
  /// turns, and what is made of them, are exact.
  bool is_rounded = false;
  /// By how much its columns are off from the length 1, at most.
  double stretch = 0;
};
/// Errors: kFormat, kNumber.
Expected<GltfPlacement> gltf_placement(const JsonNode& node);

}  // namespace gnomon

#endif  // GNOMON_SCENE_TRIANGLES_GLTF_MATRIX_H
