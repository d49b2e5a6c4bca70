// SPDX-License-Identifier: GPL-3.0-or-later
// A shadow result as a file of another program, by the name of the file.
#ifndef GNOMON_REPORT_EXPORTS_RESULT_EXPORT_H
#define GNOMON_REPORT_EXPORTS_RESULT_EXPORT_H

#include <filesystem>
#include <string>

#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/prepare.h"
#include "gnomon/scene/scene.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

enum class ExportFormat : std::uint8_t { kVtp, kGeoJson, kGlb, kCityJson };

/// By the extension: .vtp, .geojson, .glb, .city.json, in any case. Errors: kUsage.
Expected<ExportFormat> export_format(const std::filesystem::path& path);

/// Requires: LightResult::points. Errors: kUsage (fragments that lie over each other), kLimit,
/// kNumber.
Expected<void> write_export(TextSink& sink, ExportFormat format, const Scene& scene,
                            const PreparedScene& prepared, const ShadowResult& result);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_EXPORTS_RESULT_EXPORT_H
