// SPDX-License-Identifier: LGPL-3.0-or-later
// The writers of the table of formats (formats.h), and what they share.
#ifndef GNOMON_SCENE_FILES_WRITERS_H
#define GNOMON_SCENE_FILES_WRITERS_H

#include <string>
#include <string_view>
#include <vector>

#include "gnomon/scene/write.h"

namespace gnomon {

Expected<std::string> write_json(const Scene& scene);
Expected<std::string> write_obj(const Scene& scene);
/// The group of an OBJ file that each polygon is in (empty: none), so that it is called there as it
/// is; nothing at all if some id is none of an OBJ file.
std::vector<std::string_view> obj_groups(const Scene& scene);
Expected<std::string> write_off(const Scene& scene);
Expected<std::string> write_ply_ascii(const Scene& scene);
Expected<std::string> write_ply_binary(const Scene& scene);
Expected<std::string> write_cityjson(const Scene& scene);
/// Lit shares of all polygons of a scene under several lights, and areas to weigh them by.
struct CitySunlit {
  struct UnderLight {
    std::string name;
    std::vector<double> shares;  // finite, one for each polygon
  };
  std::vector<UnderLight> lights;
  std::vector<double> areas;  // one for each polygon
};
/// The same with attributes of each object: `sunlit`, the lit share of its area by the name of the
/// light, and `sunlit_surfaces`, those of its surfaces in their order.
Expected<std::string> write_sunlit_cityjson(const Scene& scene, const CitySunlit& sunlit);
/// What a city model cannot hold of a scene: one line for each.
std::vector<std::string> left_out_of_cityjson(const Scene& scene);

/// Appends three numbers with `separator` between them. Errors: kNumber, kLimit, at `pointer`.
Expected<void> append_position(std::string& text, const Position& position, NumberMeaning meaning,
                               const char* separator, const std::string& pointer);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_WRITERS_H
