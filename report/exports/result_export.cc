// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/exports/result_export.h"

#include "report/exports/class_mesh.h"
#include "report/exports/ground_shadows.h"
#include "report/exports/sunlit_city.h"
#include "report/exports/vtp.h"
#include "scene/base/ascii_case.h"

namespace gnomon::report {

Expected<ExportFormat> export_format(const std::filesystem::path& path) {
  const std::string name = lower_case(path.filename().string());
  if (name.ends_with(".vtp")) return ExportFormat::kVtp;
  if (name.ends_with(".geojson")) return ExportFormat::kGeoJson;
  if (name.ends_with(".glb")) return ExportFormat::kGlb;
  if (name.ends_with(".city.json")) return ExportFormat::kCityJson;
  ErrorPlace where;
  where.file = path.string();
  return fail(ErrorCode::kUsage, "results are not exported to files of this extension",
              ".vtp, .geojson, .glb or .city.json", where);
}

Expected<void> write_export(TextSink& sink, ExportFormat format, const Scene& scene,
                            const PreparedScene& prepared, const ShadowResult& result) {
  if (format == ExportFormat::kCityJson) {
    const auto text = sunlit_city(scene, prepared, result);
    if (!text) return tl::unexpected(text.error());
    sink.write(*text);
    return {};
  }
  const auto pieces = result_pieces(prepared, result);
  if (!pieces) return tl::unexpected(pieces.error());
  switch (format) {
    case ExportFormat::kVtp:
      write_vtp(sink, scene, prepared, result, *pieces);
      break;
    case ExportFormat::kGeoJson:
      write_ground_shadows(sink, scene, prepared, result, *pieces);
      break;
    case ExportFormat::kGlb: {
      const auto text = class_mesh(scene, prepared, result, *pieces);
      if (!text) return tl::unexpected(text.error());
      sink.write(*text);
      break;
    }
    case ExportFormat::kCityJson:
      break;
  }
  return {};
}

}  // namespace gnomon::report
