// SPDX-License-Identifier: LGPL-3.0-or-later
// Which of the formats that are JSON a text is, by the words that only one of them has. Their keys
// may stand in any order, so that the beginning of a file says nothing.
#ifndef GNOMON_SCENE_FILES_JSON_DIALECT_H
#define GNOMON_SCENE_FILES_JSON_DIALECT_H

#include <optional>
#include <string_view>

#include "gnomon/scene/scene_format.h"

namespace gnomon {

/// Nothing if the text begins like no JSON object; kJson if it is like no other format. Cost: one
/// or two searches through the text.
std::optional<SceneFormat> json_dialect(std::string_view text);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_JSON_DIALECT_H
