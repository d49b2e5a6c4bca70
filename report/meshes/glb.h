// SPDX-License-Identifier: GPL-3.0-or-later
// What every glTF 2.0 file of ours has: how it begins, colours without illumination, z up, and the
// container of its binary form.
#ifndef GNOMON_REPORT_MESHES_GLB_H
#define GNOMON_REPORT_MESHES_GLB_H

#include <array>
#include <string>
#include <string_view>

#include "report/json/json_writer.h"

namespace gnomon::report {

/// A member: all numbers or texts on one line.
template <class Values>
void inline_array(JsonWriter& json, std::string_view key, const Values& values) {
  json.key(key);
  json.begin_array(JsonLayout::kInline);
  for (const auto& value : values) json.value(value);
  json.end_array();
}

/// The first members of the file: asset, scene, scenes, extensionsUsed. A file without nodes has
/// the scene alone, since glTF forbids lists of nothing. `name`: of the scene, if it has one.
void begin_gltf(JsonWriter& json, std::string_view name, bool has_nodes);
/// Members of a node that takes (x, y, z) to (x, z, -y) about the centre: z up to y up.
void write_turn_to_y_up(JsonWriter& json, const std::array<double, 3>& centre);
/// An element of "materials": its colour as it is, whatever the light.
void write_unlit_material(JsonWriter& json, std::string_view name,
                          const std::array<double, 3>& colour);

/// Header, JSON chunk padded with spaces, binary chunk unless it is empty. Requires: the size of
/// `bytes` is a multiple of 4, and all of it is below 4 GB.
std::string glb_file(std::string json, const std::string& bytes);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_MESHES_GLB_H
