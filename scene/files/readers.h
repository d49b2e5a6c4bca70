// SPDX-License-Identifier: LGPL-3.0-or-later
// The reader of each format, behind parse_scene. Each gets a whole file and its name for messages.
#ifndef GNOMON_SCENE_FILES_READERS_H
#define GNOMON_SCENE_FILES_READERS_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/scene/read.h"

namespace gnomon {

Expected<ReadResult> read_json(std::string text, const std::string& file,
                               const ReadOptions& options);
Expected<ReadResult> read_obj(std::string_view text, const std::string& file,
                              const ReadOptions& options);
Expected<ReadResult> read_off(std::string_view text, const std::string& file,
                              const ReadOptions& options);
Expected<ReadResult> read_ply(std::string_view text, const std::string& file,
                              const ReadOptions& options);

/// The name of a scene whose file gives none.
std::string name_from_file(const std::string& file);

/// Numbers that became 0 or lost digits on reading: one warning for all of them.
struct UnderflowCount {
  std::size_t count = 0;
  std::size_t first_offset = 0;

  void add(std::size_t offset) {
    if (count++ == 0) first_offset = offset;
  }
  void report(std::string_view text, std::vector<std::string>& warnings) const;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_READERS_H
