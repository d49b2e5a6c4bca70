// SPDX-License-Identifier: GPL-3.0-or-later
// What was done to a scene while it was read and prepared, as the lines that commands and the
// Python module warn with.
#ifndef GNOMON_REPORT_FACTS_SCENE_WARNINGS_H
#define GNOMON_REPORT_FACTS_SCENE_WARNINGS_H

#include <string>
#include <vector>

#include "gnomon/scene/prepare.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/scene.h"

namespace gnomon::report {

/// "FILE: 2 of 9 polygons left out: 4 in line 17 (why); ...", with three examples. Requires: some
/// were.
std::string left_out_warning(const ReadResult& read);
/// "FILE: polygon 4 is dropped: why", a line for each reason.
std::vector<std::string> dropped_warnings(const Scene& scene, const PreparedScene& prepared);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_FACTS_SCENE_WARNINGS_H
