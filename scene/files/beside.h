// SPDX-License-Identifier: LGPL-3.0-or-later
// Files that a file of a scene names: only such as lie in its folder, or in folders in there.
#ifndef GNOMON_SCENE_FILES_BESIDE_H
#define GNOMON_SCENE_FILES_BESIDE_H

#include <string>
#include <string_view>

#include "gnomon/kernel/error.h"

namespace gnomon {

/// The path of a file that `file` names so, relative to its own folder. Errors, without a place:
/// kFile (a name that leads out of the folder, standard input, no such file, no plain file).
Expected<std::string> path_beside(const std::string& file, std::string_view name);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_BESIDE_H
