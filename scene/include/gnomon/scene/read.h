// SPDX-License-Identifier: LGPL-3.0-or-later
// First step of the pipeline: a scene from a JSON, OBJ, OFF or PLY file (docs: formats). Structure
// is checked here (validate.h), geometry by prepare.h.
//
// Guarantees: numbers go from their text straight to Number, never through another type (a float of
// a binary PLY is exactly that float); every error names one place; memory stays within a small
// multiple of the file, whatever counts the file announces; no input ends in a crash. A UTF-8 byte
// order mark is accepted. Polygons of OBJ, OFF and PLY are taken as they are, with their index as
// id.
#ifndef GNOMON_SCENE_READ_H
#define GNOMON_SCENE_READ_H

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"
#include "gnomon/scene/scene_format.h"

namespace gnomon {

struct ReadOptions {
  std::optional<NumberMeaning> numbers;  // overrides the file; meshes are doubles otherwise
  std::optional<SceneFormat> format;     // instead of extension and content
  bool lights_only = false;              // a JSON file that holds lights and no geometry
};

struct ReadResult {
  Scene scene;
  std::vector<std::string>
      warnings;  // underflow, ignored elements: one line each, without file name
};

/// Reads a file, `-` being standard input (JSON unless told otherwise). The format is
/// `options.format`, else the extension's, else what the content looks like. Errors: kFile,
/// kSyntax, kFormat, kNumber, kIndex, kId, kGeometry (degenerate light), kLimit.
Expected<ReadResult> read_scene(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for a file that is already in memory; `file` is its name for messages, and its stem the
/// name of a scene that has none.
Expected<ReadResult> parse_scene(std::string text, const std::string& file,
                                 const ReadOptions& options = {});

}  // namespace gnomon

#endif  // GNOMON_SCENE_READ_H
