// SPDX-License-Identifier: LGPL-3.0-or-later
// What becomes of polygons that cannot be used when a scene is read: left out and listed, where
// that was asked for.
#ifndef GNOMON_SCENE_FILES_LEFT_OUT_H
#define GNOMON_SCENE_FILES_LEFT_OUT_H

#include <string_view>
#include <vector>

#include "gnomon/scene/read.h"
#include "gnomon/scene/unusable.h"

namespace gnomon {

/// Moves these polygons from the scene to the list of those that were left out. Of several problems
/// of one polygon the first in the list counts.
void leave_out(ReadResult& result, std::vector<PolygonProblem> problems);

/// Leaves out what prepare() would refuse; polygon_offsets tell the lines. Errors: those of
/// unusable_polygons().
Expected<void> leave_out_unusable(ReadResult& result, std::string_view text);

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_LEFT_OUT_H
