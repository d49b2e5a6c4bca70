// SPDX-License-Identifier: GPL-3.0-or-later
// Hidden lines as a file gnomon-lines (docs/formats.md).
#ifndef GNOMON_REPORT_LINES_LINES_JSON_H
#define GNOMON_REPORT_LINES_LINES_JSON_H

#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/lines/drawn_lines.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

/// Errors: those of writing a number of the scene as text.
Expected<void> write_lines_json(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                                const DrawnLines& drawn);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_LINES_LINES_JSON_H
