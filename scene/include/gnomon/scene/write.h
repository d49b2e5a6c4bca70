// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes as files. What is written reads back to the same values: numbers have as many digits as
// that takes, decimals all of theirs. The same scene always gives the same bytes.
#ifndef GNOMON_SCENE_WRITE_H
#define GNOMON_SCENE_WRITE_H

#include <filesystem>
#include <string>
#include <vector>

#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"
#include "gnomon/scene/scene_format.h"

namespace gnomon {

struct WrittenScene {
  std::string text;
  std::vector<std::string> warnings;  // what the format cannot hold: holes, ids, lights, flags
};

/// JSON: one vertex and one polygon a line, defaults left out, "extra" kept. Meshes: vertices and
/// loops alone. Errors: kNumber, with a JSON pointer, for a value that the format cannot hold
/// exactly: a decimal that is no double in binary PLY or in a scene of doubles.
Expected<WrittenScene> scene_to_text(const Scene& scene, SceneFormat format);

struct WriteResult {
  std::vector<std::string> warnings;
};

/// scene_to_text into a file (output_file.h), `-` being standard output. Errors: also kFile.
Expected<WriteResult> write_scene(const Scene& scene, const std::filesystem::path& path,
                                  SceneFormat format);

}  // namespace gnomon

#endif  // GNOMON_SCENE_WRITE_H
