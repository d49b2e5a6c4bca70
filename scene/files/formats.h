// SPDX-License-Identifier: LGPL-3.0-or-later
// The table of file formats: reading, writing, the command line and its help texts all go by it. A
// new format is a value of SceneFormat, a reader and a writer (readers.h, writers.h), and a row in
// formats.cc.
#ifndef GNOMON_SCENE_FILES_FORMATS_H
#define GNOMON_SCENE_FILES_FORMATS_H

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "gnomon/scene/read.h"
#include "gnomon/scene/scene_format.h"

namespace gnomon {

class TextWindow;

/// How well the first bytes of a file fit a format.
enum class Likeness : std::uint8_t {
  kNone,
  kPossible,  // the file is of this format if it is of no other
  kCertain,   // the file is of no other format
};

/// What a file of a format can hold of a scene. A writer's warnings name what is lost.
enum class Holds : std::uint8_t {
  kScene,          // everything
  kMesh,           // vertices and loops, the numbers as text
  kMeshOfDoubles,  // vertices and loops, the numbers as doubles
  kSurfaces,       // vertices, loops, holes, ids and groups, the numbers as decimals
};

struct FileFormat {
  SceneFormat format;
  std::string_view name;       // on the command line
  std::string_view title;      // in messages
  std::string_view extension;  // of files, in lower case and without its first dot
  Holds holds;
  /// Null for a second way of writing the format of another row, which that row recognizes.
  Likeness (*looks_like)(std::string_view text);
  /// `file`: the name of the file, for messages.
  Expected<ReadResult> (*read)(const std::string& text, const std::string& file,
                               const ReadOptions& options);
  /// Null for a format that is only read.
  Expected<std::string> (*write)(const Scene& scene);
  /// Reads a file of which only a part at a time is in memory; null if that cannot be.
  Expected<ReadResult> (*stream)(TextWindow& window, const std::string& file,
                                 const ReadOptions& options) = nullptr;
  UpAxis up = UpAxis::kZ;  // unless ReadOptions say otherwise
};

/// All formats, in the order in which messages list them.
std::span<const FileFormat> file_formats();
const FileFormat& file_format(SceneFormat format);

/// Titles of the formats that files can be recognized as: "JSON, OBJ, OFF or PLY".
std::string shown_format_titles();

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_FORMATS_H
