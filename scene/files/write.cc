// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/scene/write.h"

#include <algorithm>

#include "scene/base/output_file.h"
#include "scene/files/formats.h"
#include "scene/files/writers.h"

namespace gnomon {

namespace {

std::string counted(std::size_t count, const char* singular, const char* plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

/// What a mesh format has no place for.
std::vector<std::string> left_out_of_mesh(const Scene& scene, const FileFormat& format) {
  const bool keeps_ids = format.format == SceneFormat::kObj && !obj_groups(scene).empty();
  std::size_t holes = 0, ids = 0, flags = 0;
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    holes += polygon.holes.size();
    if (!keeps_ids && polygon.id != std::to_string(i)) ++ids;
    if (!polygon.casts || scene.is_two_sided(polygon)) ++flags;
  }
  std::vector<std::string> warnings;
  const std::string end = " left out: the format holds vertices and loops only";
  if (holes != 0) warnings.push_back(counted(holes, "hole", "holes") + end);
  if (ids != 0) warnings.push_back("the " + counted(ids, "id", "ids") + " of polygons" + end);
  if (flags != 0) {
    warnings.push_back("two_sided or casts of " + counted(flags, "polygon", "polygons") + end);
  }
  if (!scene.lights.empty()) {
    warnings.push_back(counted(scene.lights.size(), "light", "lights") + end);
  }
  if (!scene.extra.empty()) warnings.push_back("\"extra\"" + end);
  if (scene.numbers == NumberMeaning::kDecimal && format.holds == Holds::kMesh) {
    warnings.emplace_back("the numbers are decimals: read the file with --numbers decimal");
  }
  return warnings;
}

}  // namespace

Expected<void> append_position(std::string& text, const Position& position, NumberMeaning meaning,
                               const char* separator, const std::string& pointer) {
  for (std::size_t axis = 0; axis < position.size(); ++axis) {
    auto number = position[axis].to_text(meaning);
    if (!number) {
      number.error().where.pointer = pointer + "/" + std::to_string(axis);
      return tl::unexpected(std::move(number.error()));
    }
    if (axis != 0) text += separator;
    text += *number;
  }
  return {};
}

Expected<WrittenScene> scene_to_text(const Scene& scene, SceneFormat format) {
  WrittenScene result;
  const FileFormat& file = file_format(format);
  if (file.write == nullptr) {
    return fail(ErrorCode::kUsage, std::string(file.title) + " is read and not written",
                shown_written_extensions());
  }
  if (file.holds == Holds::kSurfaces) {
    result.warnings = left_out_of_cityjson(scene);
  } else if (file.holds != Holds::kScene) {
    result.warnings = left_out_of_mesh(scene, file);
  }
  Expected<std::string> text = file.write(scene);
  if (!text) {
    text.error().where.file = scene.file;
    return tl::unexpected(std::move(text.error()));
  }
  result.text = *std::move(text);
  return result;
}

Expected<WriteResult> write_scene(const Scene& scene, const std::filesystem::path& path,
                                  SceneFormat format) {
  auto text = scene_to_text(scene, format);
  if (!text) return tl::unexpected(std::move(text.error()));
  if (auto written = write_file(path, text->text); !written) {
    return tl::unexpected(std::move(written.error()));
  }
  return WriteResult{std::move(text->warnings)};
}

}  // namespace gnomon
