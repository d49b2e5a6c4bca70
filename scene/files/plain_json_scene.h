// SPDX-License-Identifier: LGPL-3.0-or-later
// Scenes in the plain JSON that programs write, in one pass over the bytes: several times as fast
// as the parser, and without keeping the text. It only ever says what the parser says too; a file
// with an error, a warning or anything unusual is left to the parser, which knows all places.
#ifndef GNOMON_SCENE_FILES_PLAIN_JSON_SCENE_H
#define GNOMON_SCENE_FILES_PLAIN_JSON_SCENE_H

#include <optional>
#include <string>

#include "gnomon/scene/read.h"
#include "scene/base/text_window.h"

namespace gnomon {

/// The scene, valid (validate.h), or nothing: then the text must be parsed. Unusual are escapes and
/// broken UTF-8 in strings, keys that are unknown or stand twice, "numbers" after numbers, numbers
/// that underflow, "extra" in more than 64 levels, and files of lights.
std::optional<ReadResult> read_plain_json(TextWindow& window, const std::string& file,
                                          const ReadOptions& options);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_PLAIN_JSON_SCENE_H
