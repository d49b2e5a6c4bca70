// SPDX-License-Identifier: LGPL-3.0-or-later
// First step of the pipeline: a scene from a file of one of the formats of scene_format.h (docs:
// formats). Structure is checked here (validate.h), geometry by prepare.h.
//
// Guarantees: numbers go from their text straight to Number, never through another type (a float of
// a binary PLY is exactly that float); every error names one place; memory stays within a small
// multiple of the file, whatever counts the file announces; no input ends in a crash. A UTF-8 byte
// order mark is accepted. Polygons of OBJ, OFF and PLY are taken as they are, with their index as
// id, in OBJ behind the name of their object or group.
#ifndef GNOMON_SCENE_READ_H
#define GNOMON_SCENE_READ_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"
#include "gnomon/scene/scene_format.h"

namespace gnomon {

/// Which axis of a file points upwards. Scenes have z up.
enum class UpAxis : std::uint8_t { kZ, kY };

struct ReadOptions {
  std::optional<NumberMeaning> numbers;  // overrides the file; meshes are doubles otherwise
  std::optional<SceneFormat> format;     // instead of extension and content
  bool lights_only = false;              // a JSON file that holds lights and no geometry
  /// Polygons that cannot be used are left out and listed: those with fewer than three vertices,
  /// with an index of no vertex, with a coordinate that is no finite number, and those that
  /// prepare() refuses. What remains keeps its ids.
  bool skip_bad = false;
  bool polygon_offsets = false;  // ReadResult::polygon_offsets are wanted
  std::string lod;  // of CityJSON: this level of detail instead of each object's highest
  /// Of EnergyPlus' formats: the building stays in its own axes where that is exact, and the sun
  /// has to be turned by what "extra" says of its north.
  bool keep_axes = false;
  /// The axis of the file that points upwards, where it is another than its format has (glTF: y,
  /// all others: z). From y up (x, y, z) becomes (x, -z, y), exactly, lights and all.
  std::optional<UpAxis> up;
};

struct LeftOutPolygon {
  std::string id;
  Error why;  // with line and column, where the file has lines
};

struct ReadResult {
  Scene scene;
  std::vector<std::string>
      warnings;  // underflow, ignored elements: one line each, without file name
  std::vector<LeftOutPolygon> left_out;        // in order of the file
  std::vector<std::uint64_t> polygon_offsets;  // the byte at which each polygon begins
};

/// Reads a file, `-` being standard input (JSON unless told otherwise). The format is
/// `options.format`, else the extension's, else what the content looks like. Errors: kFile,
/// kSyntax, kFormat, kNumber, kIndex, kId, kGeometry (degenerate light), kLimit.
Expected<ReadResult> read_scene(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for a file that is already in memory; `file` is its name for messages, and its stem the
/// name of a scene that has none.
Expected<ReadResult> parse_scene(std::string text, const std::string& file,
                                 const ReadOptions& options = {});

/// Adds line and column to an error that names a polygon by its JSON pointer, such as one of
/// prepare(): reads the scene's file once more. The error stays as it is where that is no use:
/// standard input, binary PLY, a file that has changed, a place that is known already.
Error with_line_of_polygon(Error error, const std::filesystem::path& path,
                           const ReadOptions& options);

}  // namespace gnomon

#endif  // GNOMON_SCENE_READ_H
